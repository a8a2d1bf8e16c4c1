#pragma once

#include <heddle/io/file/test_files.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

namespace heddle {

/// A test with its own folder.
class FileTest : public ::testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        return temp_.write(name, bytes);
    }
    static std::string bytes_of(const std::filesystem::path& path) {
        return testing::slurp(path.string());
    }

    testing::TempFolder temp_;
    std::filesystem::path folder_ = temp_.path();
};

/// The text of the Error that `call` throws, which must be one line; "no error" if there is none.
inline std::string error_of(const std::function<void()>& call) {
    const std::optional<Error> error = testing::error_of(call);
    if (!error) return "no error";
    EXPECT_EQ(std::string(error->what()).find('\n'), std::string::npos) << error->what();
    return error->what();
}

/// Calls `read` on every prefix of `whole`, including the empty one, and on `whole` with one bit of
/// each byte flipped; the test fails if there is neither a result nor an Error.
/// @return how many prefixes were read without an Error
inline int read_damaged(const std::string& whole,
                        const std::function<void(const std::string&)>& read) {
    int accepted = 0;
    const auto attempt = [&read](const std::string& bytes) {
        return error_of([&] { read(bytes); }) == "no error" ? 1 : 0;
    };
    for (std::size_t n = 0; n < whole.size(); ++n) accepted += attempt(whole.substr(0, n));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string bytes = whole;
        bytes[i] = static_cast<char>(bytes[i] ^ (1 << i % 8));
        attempt(bytes);
    }
    return accepted;
}

} // namespace heddle
