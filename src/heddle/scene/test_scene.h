#pragma once

#include <heddle/base/error.h>
#include <heddle/io/file/test_files.h>
#include <heddle/scene/scene.h>

#include <gtest/gtest.h>

#include <string>

namespace heddle::testing {

/// Reads `text` as scene.toml in the folder.
inline Scene read_text(const TempFolder& folder, const std::string& text) {
    return read_scene(folder.write("scene.toml", text));
}

/// The lines of the Error that reading `text` throws, without the name of the folder; empty: none.
inline std::string problems_of(const TempFolder& folder, const std::string& text) {
    const std::optional<Error> e = error_of([&] { static_cast<void>(read_text(folder, text)); });
    if (!e) return {};
    EXPECT_EQ(e->code(), ErrorCode::BadFile) << e->what();
    std::string lines = e->what();
    const std::string prefix = folder.path() + "/";
    for (std::size_t at = 0; (at = lines.find(prefix)) != std::string::npos;) {
        lines.erase(at, prefix.size());
    }
    return lines;
}

} // namespace heddle::testing
