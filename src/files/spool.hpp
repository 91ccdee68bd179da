/// Columns that are gathered before they can be written, because how many rows they have is known at the end only.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/result.hpp"
#include "files/descriptor.hpp"

namespace barycert::base {

/// Bytes, in memory while few, then in a nameless file beside the target or in TMPDIR. They are gone with the object.
class Spool {
public:
    /// `target`: of what is to be written in the end.
    explicit Spool(std::string target) : target_(std::move(target)) {}

    template <class T>
    Status append(std::span<const T> values) {
        return append_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
    }

    /// All of them, until the object is gone. Nothing is appended from then on.
    Status finish();
    template <class T>
    std::span<const T> values() const {
        return {reinterpret_cast<const T*>(mapped_ != nullptr ? mapped_.get() : held_.data()), size_ / sizeof(T)};
    }

private:
    Status append_bytes(std::string_view bytes);
    Status spill();
    Error failure(const char* what, int error_number) const;

    std::string target_, held_;
    Descriptor file_;
    std::size_t size_ = 0;
    Mapping mapped_;
};

}  // namespace barycert::base
