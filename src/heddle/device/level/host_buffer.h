#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace heddle {

/// Host memory for data from an executor, reused from batch to batch. It is never cleared, unlike a
/// std::vector, which would write all of it once more.
template <typename T>
class HostBuffer {
public:
    /// Sets its length to `n` and returns it; its contents are lost.
    std::span<T> resize(std::size_t n) {
        if (n > capacity_) {
            data_.reset();
            data_ = std::make_unique_for_overwrite<T[]>(n);
            capacity_ = n;
        }
        size_ = n;
        return {data_.get(), n};
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] const T* data() const { return data_.get(); }
    [[nodiscard]] const T& operator[](std::size_t i) const { return data_[i]; }
    [[nodiscard]] std::span<const T> span() const { return {data_.get(), size_}; }

private:
    std::unique_ptr<T[]> data_;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

} // namespace heddle
