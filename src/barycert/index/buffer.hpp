/// Large arrays without a first value.
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <new>
#include <span>

#include "barycert/base/large_pages.hpp"

namespace barycert::index {

/// `size` objects of a plain type that hold anything until they are written. Cache lines are not shared with other
/// objects, and large arrays ask for large pages: indexes are read at random.
template <class T>
class Buffer {
public:
    Buffer() = default;
    explicit Buffer(std::size_t size)
        : data_(static_cast<T*>(::operator new(size == 0 ? 1 : size * sizeof(T), alignment(size)))), size_(size) {
        base::ask_for_large_pages(data_.get(), size * sizeof(T));
        data_.get_deleter().alignment = alignment(size);
    }

    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return size_ * sizeof(T); }
    T& operator[](std::integral auto i) { return data_.get()[static_cast<std::size_t>(i)]; }
    const T& operator[](std::integral auto i) const { return data_.get()[static_cast<std::size_t>(i)]; }
    operator std::span<const T>() const { return {data(), size_}; }

private:
    static std::align_val_t alignment(std::size_t size) {
        return std::align_val_t{size * sizeof(T) >= base::large_page ? base::large_page : 64};
    }
    struct Delete {
        std::align_val_t alignment{64};
        void operator()(T* data) const { ::operator delete(data, alignment); }
    };
    std::unique_ptr<T, Delete> data_;
    std::size_t size_ = 0;
};

}  // namespace barycert::index
