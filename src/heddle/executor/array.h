#pragma once

#include <heddle/executor/budget.h>
#include <heddle/executor/phase_times.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

namespace heddle::executor {

/// Allocates the arrays of an executor: memory of the host or of the device, counted in a budget.
class Allocator {
public:
    explicit Allocator(Budget& budget) : budget_(budget) {}
    virtual ~Allocator() = default;
    Allocator(const Allocator&) = delete;
    Allocator& operator=(const Allocator&) = delete;

    /// @throws Error  OutOfMemory: the budget or the device has too little left; Device
    [[nodiscard]] void* take(std::size_t bytes) {
        if (bytes == 0) return nullptr;
        budget_.take(static_cast<std::int64_t>(bytes), stage_);
        try {
            return allocate(bytes);
        } catch (...) {
            budget_.give(static_cast<std::int64_t>(bytes));
            throw;
        }
    }
    void give(void* data, std::size_t bytes) noexcept {
        if (data == nullptr) return;
        release(data);
        budget_.give(static_cast<std::int64_t>(bytes));
    }

    /// Names the phase that starts now, for errors. @param name  a literal: it is not copied
    void set_phase(std::string_view name) { stage_ = name; }
    [[nodiscard]] std::string_view stage() const { return stage_; }
    [[nodiscard]] Budget& budget() const { return budget_; }
    /// Waits for each launch from now on and adds its time. @param times  null: stops timing
    void time_phases(PhaseTimes* times) { times_ = times; }

protected:
    PhaseTimes* times_ = nullptr;

private:
    virtual void* allocate(std::size_t bytes) = 0;
    virtual void release(void* data) noexcept = 0;

    Budget& budget_;
    std::string_view stage_ = "device";
};

/// Owns n objects of T where an executor works. Move-only: a copy would be a silent transfer.
template <typename T>
class Array {
    static_assert(std::is_trivially_copyable_v<T>, "device memory is filled by byte copies");

public:
    Array() = default;
    Array(Allocator& from, std::size_t n)
        : from_(&from), data_(static_cast<T*>(from.take(n * sizeof(T)))), size_(n) {}
    Array(Array&& other) noexcept
        : from_(other.from_),
          data_(std::exchange(other.data_, nullptr)),
          size_(std::exchange(other.size_, 0)) {}
    Array& operator=(Array&& other) noexcept {
        std::swap(from_, other.from_);
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }
    Array(const Array&) = delete;
    Array& operator=(const Array&) = delete;
    ~Array() {
        if (data_ != nullptr) from_->give(data_, size_ * sizeof(T));
    }

    /// A pointer into the executor's memory: only a HostExecutor's may be read by the host.
    [[nodiscard]] T* data() const noexcept { return data_; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Frees the memory.
    void reset() { *this = Array(); }

private:
    Allocator* from_ = nullptr;
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace heddle::executor
