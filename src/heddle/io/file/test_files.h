#pragma once

// Shared by the tests of this room: a temporary folder, files made of bytes, real data, Errors.

#include <heddle/base/error.h>
#include <heddle/geom/geometry.h>

#include <unistd.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>

namespace heddle::testing {

/// A folder that is removed with its contents.
class TempFolder {
public:
    TempFolder() {
        // thousands of damaged files are written: in memory, if there is such a folder
        const std::filesystem::path shm = "/dev/shm";
        const bool memory = ::access(shm.c_str(), W_OK) == 0;
        std::string name =
            ((memory ? shm : std::filesystem::temp_directory_path()) / "heddle-io-test-XXXXXX")
                .string();
        if (::mkdtemp(name.data()) != nullptr) path_ = name;
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string write(const std::string& name, const std::string& bytes) const {
        std::ofstream(file(name), std::ios::binary) << bytes;
        return file(name);
    }
    [[nodiscard]] std::size_t count_entries() const {
        const std::filesystem::directory_iterator begin(path_);
        return static_cast<std::size_t>(std::distance(begin, {}));
    }

private:
    std::string path_;
};

inline std::string slurp(const std::string& path) {
    std::ostringstream out;
    out << std::ifstream(path, std::ios::binary).rdbuf();
    return std::move(out).str();
}

/// The bytes of numbers in a little-endian file.
template <typename T, typename... Rest>
std::string bytes(T first, Rest... rest) {
    static_assert(std::is_arithmetic_v<T>);
    std::string out(reinterpret_cast<const char*>(&first), sizeof(T));
    if constexpr (sizeof...(rest) > 0) out += bytes(rest...);
    return out;
}

/// The Error that `action` throws, if any.
inline std::optional<Error> error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& e) {
        return e;
    }
    return std::nullopt;
}

/// Expects an Error of this code whose one line contains `text`.
inline void
expect_error(ErrorCode code, const std::string& text, const std::function<void()>& action) {
    const std::optional<Error> e = error_of(action);
    ASSERT_TRUE(e.has_value()) << "no Error; expected '" << text << "'";
    const std::string what = e->what();
    EXPECT_EQ(to_string(e->code()), to_string(code)) << what;
    EXPECT_NE(what.find(text), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
}

/// Expects an Error for every proper prefix of `whole`, and a result for the whole.
inline void expect_truncations_fail(const TempFolder& folder,
                                    const std::string& name,
                                    const std::string& whole,
                                    const std::function<void(const std::string&)>& read) {
    for (std::size_t n = 0; n < whole.size(); ++n) {
        const std::string path = folder.write(name, whole.substr(0, n));
        const std::optional<Error> e = error_of([&] { read(path); });
        ASSERT_TRUE(e.has_value()) << n << " of " << whole.size() << " bytes were accepted";
        EXPECT_EQ(e->code(), ErrorCode::BadFile) << e->what();
    }
    EXPECT_NO_THROW(read(folder.write(name, whole)));
}

/// Flips every bit of `whole` in turn: an Error or a result, never a crash (run it under ASan).
inline void flip_every_bit(const TempFolder& folder,
                           const std::string& name,
                           const std::string& whole,
                           const std::function<void(const std::string&)>& read) {
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        std::string bad = whole;
        bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
        const std::string path = folder.write(name, bad);
        static_cast<void>(error_of([&] { read(path); }));
    }
}

inline bool has_note(const Geometry& g, const std::string& text) {
    for (const std::string& note : g.notes) {
        if (note.find(text) != std::string::npos) return true;
    }
    return false;
}

/// The path of a file of real data; empty if the data is not there.
inline std::string find_data(const std::string& name) {
    const char* folder = std::getenv("HEDDLE_TEST_DATA");
    const std::string path =
        std::string(folder != nullptr ? folder : HEDDLE_SOURCE_DIR "/../shared/data") + "/" + name;
    return std::filesystem::exists(path) ? path : std::string();
}

} // namespace heddle::testing
