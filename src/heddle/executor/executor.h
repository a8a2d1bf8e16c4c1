#pragma once

#include <heddle/executor/array.h>

#include <cstddef>
#include <span>

namespace heddle::executor {

/// What all executors share; `Self` has upload(), download(), wait(), for_each() and offsets().
template <typename Self>
class Executor : public Allocator {
public:
    /// An array of n objects, not initialized.
    template <typename T>
    [[nodiscard]] Array<T> make(std::size_t n) {
        return Array<T>(*this, n);
    }
    template <typename T>
    [[nodiscard]] Array<T> make_from(std::span<const T> host) {
        Array<T> out(*this, host.size());
        self().upload(out.data(), host);
        return out;
    }
    /// Reads one object back, after waiting for it.
    template <typename T>
    [[nodiscard]] T read(const T* at) {
        T out;
        self().download(std::span<T>(&out, 1), at);
        return out;
    }

protected:
    explicit Executor(Budget& budget) : Allocator(budget) {}

private:
    Self& self() { return static_cast<Self&>(*this); }
};

} // namespace heddle::executor
