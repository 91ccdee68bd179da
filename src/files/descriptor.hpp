/// Owners of what the system lends: open files, mapped memory.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace barycert::base {

struct Descriptor {
    int number = -1;  ///< -1: none

    explicit Descriptor(int n = -1) : number(n) {}
    Descriptor(Descriptor&& other) noexcept : number(std::exchange(other.number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number, other.number);
        return *this;
    }
    ~Descriptor() { close(); }

    explicit operator bool() const { return number >= 0; }
    /// False if the system tells of an error only now, in errno.
    bool close() { return number < 0 || ::close(std::exchange(number, -1)) == 0; }

    /// Writes all bytes at the end, or those from `offset` on. False if that fails, in errno.
    bool write(std::string_view bytes, std::optional<std::size_t> offset = {}) const {
        while (!bytes.empty()) {
            const ssize_t written =
                TEMP_FAILURE_RETRY(offset ? ::pwrite(number, bytes.data(), bytes.size(), static_cast<off_t>(*offset))
                                          : ::write(number, bytes.data(), bytes.size()));
            if (written < 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(written));
            if (offset) *offset += static_cast<std::size_t>(written);
        }
        return true;
    }
};

inline std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// Unmapped at the end.
struct Unmap {
    std::size_t size = 0;
    void operator()(char* memory) const { ::munmap(memory, size); }
};
using Mapping = std::unique_ptr<char, Unmap>;

/// As ::mmap; nothing if that fails, in errno. `descriptor`: -1: of no file, but zeros.
inline Mapping map_memory(std::size_t size, int protection, int flags, int descriptor = -1) {
    void* const memory = ::mmap(nullptr, size, protection, flags, descriptor, 0);
    return {memory == MAP_FAILED ? nullptr : static_cast<char*>(memory), Unmap{size}};
}

}  // namespace barycert::base
