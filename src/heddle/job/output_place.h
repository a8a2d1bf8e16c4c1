#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace heddle::job {

/// Throws unless a file can be put at `path`: asked before long work, not after it.
/// @param suffix  that the path must end in
/// @param option  that gave the path
/// @throws OptionError  another suffix
/// @throws Error        CannotWrite: a folder, a device, a place without permission
void check_output(const std::string& path,
                  const std::string& suffix,
                  const std::string& option = "output");

/// Runs `write`, and makes of what it throws for a bad place or a full disk an Error{CannotWrite}.
void write_output(const std::function<void()>& write);

/// Writes a text file, whole or not at all.
/// @throws Error  CannotWrite
void write_text(const std::string& path, std::string_view text);

/// Bytes of a file; 0 where there is none.
[[nodiscard]] std::int64_t file_bytes(const std::string& path);

} // namespace heddle::job
