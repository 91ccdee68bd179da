#include "barycert/pieces/distribution.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

namespace barycert::pieces {

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

// f of each member, of a kind that is read or written.
template <class Kind, class F>
void for_each_member(Kind& kind, F& f) {
    f(kind.name), f(kind.type_name), f(kind.named), f(kind.type), f(kind.components), f(kind.role);
    f(kind.component_names);
}

// Of numbers their bytes; of texts, and of lists, the count of their items first.
struct Writer {
    template <class T>
    void operator()(const T& value) {
        if constexpr (std::is_arithmetic_v<T>) {
            const auto* const from = reinterpret_cast<const unsigned char*>(&value);
            bytes.insert(bytes.end(), from, from + sizeof value);
        } else {
            (*this)(value.size());
            for (const auto& item : value) (*this)(item);
        }
    }
    void operator()(const ArrayKind& kind) { for_each_member(kind, *this); }

    std::vector<unsigned char> bytes;
};

struct Reader {
    template <class T>
    void operator()(T& value) {
        if constexpr (std::is_arithmetic_v<T>) {
            std::memcpy(&value, at, sizeof value);
            at += sizeof value;
        } else {
            auto count = value.size();
            (*this)(count);
            value.resize(count);
            for (auto& item : value) (*this)(item);
        }
    }
    void operator()(ArrayKind& kind) { for_each_member(kind, *this); }

    const unsigned char* at;
};

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
        Writer write;
        if (exchange.rank() == from) write(kinds);
        bytes = std::move(write.bytes);
    });
    if (!read) return read;
    if (Status done = exchange.broadcast(bytes, from); !done) return done;
    return exchange.everywhere([&]() -> Status {
        std::vector<ArrayKind> theirs;
        Reader{bytes.data()}(theirs);
        if (std::string differs = has_cells ? difference(kinds, theirs) : std::string(); !differs.empty())
            return Error{.what =
                             "the source has other arrays than that of rank " + std::to_string(from) + ": " + differs};
        kinds = std::move(theirs);
        return Done{};
    });
}

}  // namespace barycert::pieces
