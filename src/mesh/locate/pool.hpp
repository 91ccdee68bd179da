/// A store of work space.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace barycert::locate {

/// Things that are dear to make, kept for the next user.
template <class T>
class Pool {
public:
    /// One that nobody uses; give it back by put().
    std::unique_ptr<T> take() const {
        const std::lock_guard lock(mutex_);
        if (kept_.empty()) {
            kept_.reserve(++made_);  // so that put() needs no memory
            return std::make_unique<T>();
        }
        std::unique_ptr<T> one = std::move(kept_.back());
        kept_.pop_back();
        return one;
    }
    void put(std::unique_ptr<T> one) const noexcept {
        const std::lock_guard lock(mutex_);
        kept_.push_back(std::move(one));
    }

private:
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<T>> kept_;
    mutable std::size_t made_ = 0;
};

}  // namespace barycert::locate
