/// Parts of an index that are made on first need.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>

#include "mesh/threads/arena.hpp"

namespace barycert::locate {

/// Made on first need, by one thread while others wait.
template <class T>
class Lazy {
public:
    template <class Make>
    const T& get(Make make) const {
        if (const T* const there = made()) return *there;
        std::call_once(once_, [&] {
            // A thread that waits for others while it makes this must not take up work that would ask for it again.
            base::isolated([&] { value_.reset(new T(make())); });
            made_.store(value_.get(), std::memory_order_release);
        });
        return *value_;
    }
    /// nullptr until it is made.
    const T* made() const { return made_.load(std::memory_order_acquire); }

private:
    mutable std::once_flag once_;
    mutable std::unique_ptr<T> value_;
    mutable std::atomic<const T*> made_ = nullptr;
};

/// Memory of those that are made.
template <class... T>
std::size_t bytes_of(const Lazy<T>&... parts) {
    return (std::size_t{0} + ... + (parts.made() != nullptr ? parts.made()->bytes() : 0));
}

}  // namespace barycert::locate
