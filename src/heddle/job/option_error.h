#pragma once

#include <heddle/base/error.h>

#include <string>

namespace heddle::job {

/// Says which options cannot be used together, are out of range, or do not apply to the input. An
/// InvalidArgument without a path. Its text names struct members in backquotes (`voxel_size`).
class OptionError final : public Error {
public:
    explicit OptionError(const std::string& what) : Error(ErrorCode::InvalidArgument, what) {}
};

} // namespace heddle::job
