#include "barycert/check.hpp"

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

namespace barycert {
namespace {

/// Mixes bytes, eight at a time. Not for adversaries: it is to tell a mesh from one that was changed since.
class Fingerprint {
public:
    template <class T>
    void add(std::span<const T> values) {
        word(values.size());
        const auto* bytes = reinterpret_cast<const char*>(values.data());
        std::size_t left = values.size_bytes();
        for (; left >= 8; left -= 8, bytes += 8) {
            std::uint64_t w;
            std::memcpy(&w, bytes, 8);
            word(w);
        }
        if (left == 0) return;  // an empty array may have no address to copy from
        std::uint64_t rest = 0;
        std::memcpy(&rest, bytes, left);
        word(rest);
    }
    std::uint64_t value() const { return state_; }

private:
    void word(std::uint64_t w) {  // odd multipliers and rotations lose nothing
        state_ = std::rotl((state_ ^ w) * 0x9e3779b97f4a7c15, 29) * 0xbf58476d1ce4e5b9;
    }
    std::uint64_t state_ = 0x94d049bb133111eb;
};

std::uint64_t fingerprint(const Mesh& mesh) {
    Fingerprint f;
    const std::int64_t dimension = mesh.dimension;
    f.add(std::span(&dimension, 1));
    f.add(std::span<const double>(mesh.points));
    f.add(std::span<const Mesh::Index>(mesh.cells));
    f.add(std::span<const Mesh::Index>(mesh.neighbours));
    f.add(std::span<const Mesh::Index>(mesh.faces));
    return f.value();
}

}  // namespace

Certificate::Certificate(Verdict verdict, const Mesh& mesh) : verdict_(verdict), fingerprint_(fingerprint(mesh)) {}

Verdict Certificate::verdict_on(const Mesh& mesh) const {
    if (verdict_ == Verdict::not_checked || fingerprint(mesh) != fingerprint_) return Verdict::not_checked;
    return verdict_;
}

}  // namespace barycert
