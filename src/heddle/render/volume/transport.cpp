#include <heddle/render/volume/transport.h>

#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>

#include <algorithm>

namespace heddle {

const std::vector<std::string>& transport_names() {
    static const std::vector<std::string> names{"auto", "product", "cells", "sheet", "flakes"};
    return names;
}

Transport transport_from(const std::string& name) {
    const std::vector<std::string>& names = transport_names();
    if (name.empty()) return Transport::Automatic;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at != names.end()) return static_cast<Transport>(at - names.begin());
    throw Error(ErrorCode::InvalidArgument, str("unknown transport '", name, "'"),
                str("did you mean '", nearest_name(name, names), "'?"));
}

} // namespace heddle
