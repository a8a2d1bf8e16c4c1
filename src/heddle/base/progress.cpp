#include <heddle/base/progress.h>

namespace heddle {

void Progress::begin(std::string_view, std::string_view, std::int64_t) {}
void Progress::advance(std::int64_t) {}
void Progress::begin_part(std::string_view) {}
void Progress::note(std::string_view) {}

void Progress::check() const {
    if (cancelled()) throw Error(ErrorCode::Cancelled, "cancelled");
}

} // namespace heddle
