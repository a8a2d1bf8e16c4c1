#pragma once

#include <heddle/executor/array.h>

#include <cstddef>
#include <span>

namespace heddle::upload_detail {

/// Copies n objects to an array of `exec` and sets the pointer to the copy; null stays null.
template <typename Exec, typename T>
void replace(Exec& exec, executor::Array<T>& held, const T*& data, std::size_t n) {
    if (data == nullptr) return;
    held = exec.make_from(std::span<const T>(data, n));
    data = held.data();
}

} // namespace heddle::upload_detail
