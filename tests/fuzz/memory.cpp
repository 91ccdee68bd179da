#include "tests/fuzz/memory.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__)
#define BARYCERT_HOOKS 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define BARYCERT_HOOKS 1
#endif
#endif

namespace barycert::fuzz {
namespace {

std::atomic<std::ptrdiff_t> now{0}, most{0};

void taken(std::size_t size) {
    const std::ptrdiff_t sum =
        now.fetch_add(static_cast<std::ptrdiff_t>(size), std::memory_order_relaxed) + static_cast<std::ptrdiff_t>(size);
    // A peak that another thread raises at the same moment may be missed: targets run on one.
    if (sum > most.load(std::memory_order_relaxed)) most.store(sum, std::memory_order_relaxed);
}

void given_back(std::size_t size) {
    now.fetch_sub(static_cast<std::ptrdiff_t>(size), std::memory_order_relaxed);
}

}  // namespace

void begin_memory() {
    now = 0;
    most = 0;
}

std::size_t peak_memory() {
    return static_cast<std::size_t>(most.load());
}

}  // namespace barycert::fuzz

#if defined(BARYCERT_HOOKS)
// Declared in sanitizer/allocator_interface.h, which GCC 12 does not install.
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* p);

// The runtime calls these, by their names, after each allocation and before each release.
extern "C" void __sanitizer_malloc_hook(const volatile void* p, std::size_t size) {
    if (p != nullptr) barycert::fuzz::taken(size);
}
extern "C" void __sanitizer_free_hook(const volatile void* p) {
    if (p != nullptr) barycert::fuzz::given_back(__sanitizer_get_allocated_size(p));
}
#else
#include <malloc.h>

// Counts what the library takes with new: all but what C libraries take for themselves.
void* operator new(std::size_t size) {
    void* const p = std::malloc(size);
    if (p == nullptr) throw std::bad_alloc();
    barycert::fuzz::taken(::malloc_usable_size(p));
    return p;
}
void operator delete(void* p) noexcept {
    if (p != nullptr) barycert::fuzz::given_back(::malloc_usable_size(p));
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    ::operator delete(p);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto multiple = static_cast<std::size_t>(alignment);
    void* const p = std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple);
    if (p == nullptr) throw std::bad_alloc();
    barycert::fuzz::taken(::malloc_usable_size(p));
    return p;
}
void operator delete(void* p, std::align_val_t) noexcept {
    ::operator delete(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
    ::operator delete(p);
}
#endif
