#pragma once

#include <heddle/base/error.h>

#include <string>

namespace heddle::job {

/// Options that do not go together, or that the input has no use for: InvalidArgument without a
/// path. Its text has the names of options in backquotes, as the structs have them.
class OptionError final : public Error {
public:
    explicit OptionError(const std::string& what) : Error(ErrorCode::InvalidArgument, what) {}
};

} // namespace heddle::job
