#include "barycert/pieces/distribution.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace barycert::pieces {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ArrayKind, name, named, type, type_name, components, role, component_names)

namespace {

const ArrayKind* find(const std::vector<ArrayKind>& kinds, const ArrayKind& like) {
    for (const ArrayKind& kind : kinds)
        if (kind.named == like.named && (kind.named ? kind.name == like.name : kind.role == like.role)) return &kind;
    return nullptr;
}

// What differs; empty if nothing does.
std::string difference(const std::vector<ArrayKind>& mine, const std::vector<ArrayKind>& theirs) {
    for (const ArrayKind& kind : theirs) {
        const ArrayKind* const own = find(mine, kind);
        if (own == nullptr) return kind.text() + " is missing here";
        if (own->type != kind.type || own->components != kind.components)
            return kind.text() + " is here " + own->text();
    }
    for (const ArrayKind& kind : mine)
        if (find(theirs, kind) == nullptr) return kind.text() + " is here only";
    return {};
}

}  // namespace

std::string ArrayKind::text() const {
    return (named ? "the array " + name : std::string("an array without a name")) + " of " +
           std::to_string(components) + (components == 1 ? " " : " times ") + type_name;
}

Status agree_on_arrays(Exchange& exchange, bool has_cells, std::vector<ArrayKind>& kinds) {
    double lowest = has_cells ? exchange.rank() : exchange.size();
    exchange.least({&lowest, 1});
    const int from = lowest < exchange.size() ? static_cast<int>(lowest) : 0;
    std::vector<unsigned char> bytes;
    Status read = exchange.everywhere([&] {
        if (exchange.rank() == from) bytes = nlohmann::json::to_cbor(kinds);
    });
    if (!read) return read;
    if (Status done = exchange.broadcast(bytes, from); !done) return done;
    return exchange.everywhere([&]() -> Status {
        auto theirs = exchange.size() == 1 ? kinds : nlohmann::json::from_cbor(bytes).get<std::vector<ArrayKind>>();
        if (std::string differs = has_cells ? difference(kinds, theirs) : std::string(); !differs.empty())
            return Error{.what =
                             "the source has other arrays than that of rank " + std::to_string(from) + ": " + differs};
        kinds = std::move(theirs);
        return Done{};
    });
}

}  // namespace barycert::pieces
