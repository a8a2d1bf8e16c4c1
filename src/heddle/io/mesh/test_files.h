#pragma once

#include <heddle/base/error.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace heddle {

/// A test with a folder of its own, emptied before and removed after.
class FileTest : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(testing::TempDir()) /
                  (std::string("heddle_") + info->test_suite_name() + "_" + info->name());
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::filesystem::remove(folder_ /
                                name); // ext4 flushes a file that is cut and written again
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }

    static std::string bytes_of(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    std::filesystem::path folder_;
};

/// The text of the Error that `call` throws, which must be one line; "no error" without one.
inline std::string error_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        return e.what();
    }
    return "no error";
}

/// Calls `read` on every beginning of `whole`, the empty one included, and on `whole` with one
/// bit of each byte turned; anything but a result or an Error ends the test.
/// @return how many beginnings were read without an Error
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
