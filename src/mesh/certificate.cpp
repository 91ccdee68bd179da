#include "barycert/certificate.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "barycert/mesh.hpp"

namespace barycert {
namespace {

std::uint64_t fingerprint_of(const Mesh& mesh) {
    auto state = static_cast<std::uint64_t>(mesh.dimension);
    const auto add = [&](const auto& values) {
        const std::span bytes = std::as_bytes(std::span(values));
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        state = std::rotl(state, 29) * 0x9e3779b97f4a7c15 ^ std::hash<std::string_view>()(text);
    };
    add(mesh.points);
    for (const auto* indices : {&mesh.cells, &mesh.neighbours, &mesh.faces}) add(*indices);
    return state;
}

}  // namespace

Certificate::Certificate(Verdict verdict, const Mesh& mesh) : verdict_(verdict), fingerprint_(fingerprint_of(mesh)) {}

Certificate Certificate::known(const Mesh& mesh, std::span<const std::uint64_t> certified) {
    Certificate certificate(Verdict::certified, mesh);
    return std::ranges::find(certified, certificate.fingerprint_) == certified.end() ? Certificate() : certificate;
}

Verdict Certificate::verdict_on(const Mesh& mesh) const {
    if (verdict_ == Verdict::not_checked || fingerprint_of(mesh) != fingerprint_) return Verdict::not_checked;
    return verdict_;
}

}  // namespace barycert
