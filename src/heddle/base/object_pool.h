#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace heddle {

/// Lends working memory to threads. It makes one object per thread that works at the same time.
template <typename T>
class ObjectPool {
public:
    /// Calls body(T&) with a T that no other thread uses; make() -> unique_ptr<T> if none is idle.
    template <typename Make, typename Body>
    void with(const Make& make, const Body& body) {
        std::unique_ptr<T> mine;
        {
            const std::scoped_lock lock(mutex_);
            if (!idle_.empty()) {
                mine = std::move(idle_.back());
                idle_.pop_back();
            }
        }
        if (!mine) mine = make();
        body(*mine);
        const std::scoped_lock lock(mutex_);
        idle_.push_back(std::move(mine));
    }
    /// The same for a T with a default constructor.
    template <typename Body>
    void with(const Body& body) {
        with([] { return std::make_unique<T>(); }, body);
    }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> idle_;
};

} // namespace heddle
