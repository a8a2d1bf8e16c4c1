#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace heddle {

/// Lends working memory to whichever thread asks: as many exist as threads ever worked at once.
template <typename T>
class Lender {
public:
    /// Calls body(T&) with one that no other thread has, made by make() -> unique_ptr<T> if none is idle.
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
    /// The same where a T needs nothing to be made.
    template <typename Body>
    void with(const Body& body) {
        with([] { return std::make_unique<T>(); }, body);
    }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> idle_;
};

} // namespace heddle
