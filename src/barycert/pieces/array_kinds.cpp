#include "barycert/pieces/array_kinds.hpp"

#include <cstring>
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

// Of numbers their bytes; of texts, and of lists, the count of their items first.
struct Writer {
    void operator()(int number) {
        const auto* const from = reinterpret_cast<const unsigned char*>(&number);
        bytes.insert(bytes.end(), from, from + sizeof number);
    }
    void operator()(const std::string& text) {
        (*this)(static_cast<int>(text.size()));
        bytes.insert(bytes.end(), text.begin(), text.end());
    }
    std::vector<unsigned char> bytes;
};

struct Reader {
    void operator()(int& number) {
        std::memcpy(&number, at, sizeof number);
        at += sizeof number;
    }
    void operator()(std::string& text) {
        int size = 0;
        (*this)(size);
        text.assign(reinterpret_cast<const char*>(at), static_cast<std::size_t>(size));
        at += size;
    }
    const unsigned char* at;
};

std::vector<unsigned char> to_bytes(const std::vector<ArrayKind>& kinds) {
    Writer write;
    write(static_cast<int>(kinds.size()));
    for (const ArrayKind& kind : kinds) {
        for (const std::string* const text : {&kind.name, &kind.type_name}) write(*text);
        for (const int number : {kind.named ? 1 : 0, kind.type, kind.components, kind.role}) write(number);
        write(static_cast<int>(kind.component_names.size()));
        for (const std::string& name : kind.component_names) write(name);
    }
    return std::move(write.bytes);
}

std::vector<ArrayKind> kinds_from(const std::vector<unsigned char>& bytes) {
    Reader read{bytes.data()};
    int count = 0;
    read(count);
    std::vector<ArrayKind> kinds(static_cast<std::size_t>(count));
    for (ArrayKind& kind : kinds) {
        int named = 0, names = 0;
        for (std::string* const text : {&kind.name, &kind.type_name}) read(*text);
        for (int* const number : {&named, &kind.type, &kind.components, &kind.role, &names}) read(*number);
        kind.named = named != 0;
        kind.component_names.resize(static_cast<std::size_t>(names));
        for (std::string& name : kind.component_names) read(name);
    }
    return kinds;
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
    Status read = exchange.everywhere([&]() -> Status {
        if (exchange.rank() == from) bytes = to_bytes(kinds);
        return Done{};
    });
    if (!read) return read;
    if (Status done = exchange.broadcast(bytes, from); !done) return done;
    return exchange.everywhere([&]() -> Status {
        std::vector<ArrayKind> theirs = kinds_from(bytes);
        if (std::string differs = has_cells ? difference(kinds, theirs) : std::string(); !differs.empty())
            return Error{.what =
                             "the source has other arrays than that of rank " + std::to_string(from) + ": " + differs};
        kinds = std::move(theirs);
        return Done{};
    });
}

}  // namespace barycert::pieces
