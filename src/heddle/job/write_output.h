#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace heddle::job {

/// Checks that a file can be written to `path`, so that a long computation is not done in vain.
/// @param suffix  the path must end in it
/// @param option  name of the option that gave the path, for messages
/// @throws OptionError  the path has another suffix
/// @throws Error        CannotWrite: the path is a folder or a device, or permission is missing
void check_output(const std::string& path,
                  const std::string& suffix,
                  const std::string& option = "output");

/// Runs `write`, and turns its exceptions for a bad path or a full disk into Error{CannotWrite}.
void write_output(const std::function<void()>& write);

/// Writes a text file, whole or not at all.
/// @throws Error  CannotWrite
void write_text(const std::string& path, std::string_view text);

/// Returns the size of a file in bytes; 0 if there is no file.
[[nodiscard]] std::int64_t file_bytes(const std::string& path);

} // namespace heddle::job
