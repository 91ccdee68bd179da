// 2.x text    count, rows: tag type tag-count tag... node...
// 2.x binary  count, groups: type count tag-count, rows: tag tag... node...
// 4.0         blocks count, blocks: entity dimension type count, rows: tag node...
// 4.1         blocks count lowest highest, blocks: dimension entity type count, rows: tag node...
#include <algorithm>
#include <cstring>
#include <string>

#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/gmsh/msh_parts.hpp"

namespace barycert::io {

namespace {

using F = ElementFamily;

// Numbers, orders and node counts of Gmsh's documentation ("MSH file format") and of GmshDefines.h. The serendipity
// types of higher order have fewer nodes than the complete ones of the same order.
constexpr std::array all{
    ElementType{1, F::line, 1, 2},           ElementType{2, F::triangle, 1, 3},
    ElementType{3, F::quadrangle, 1, 4},     ElementType{4, F::tetrahedron, 1, 4},
    ElementType{5, F::hexahedron, 1, 8},     ElementType{6, F::prism, 1, 6},
    ElementType{7, F::pyramid, 1, 5},        ElementType{8, F::line, 2, 3},
    ElementType{9, F::triangle, 2, 6},       ElementType{10, F::quadrangle, 2, 9},
    ElementType{11, F::tetrahedron, 2, 10},  ElementType{12, F::hexahedron, 2, 27},
    ElementType{13, F::prism, 2, 18},        ElementType{14, F::pyramid, 2, 14},
    ElementType{15, F::point, 1, 1},         ElementType{16, F::quadrangle, 2, 8},
    ElementType{17, F::hexahedron, 2, 20},   ElementType{18, F::prism, 2, 15},
    ElementType{19, F::pyramid, 2, 13},      ElementType{20, F::triangle, 3, 9},
    ElementType{21, F::triangle, 3, 10},     ElementType{22, F::triangle, 4, 12},
    ElementType{23, F::triangle, 4, 15},     ElementType{24, F::triangle, 5, 15},
    ElementType{25, F::triangle, 5, 21},     ElementType{26, F::line, 3, 4},
    ElementType{27, F::line, 4, 5},          ElementType{28, F::line, 5, 6},
    ElementType{29, F::tetrahedron, 3, 20},  ElementType{30, F::tetrahedron, 4, 35},
    ElementType{31, F::tetrahedron, 5, 56},  ElementType{36, F::quadrangle, 3, 16},
    ElementType{37, F::quadrangle, 4, 25},   ElementType{38, F::quadrangle, 5, 36},
    ElementType{42, F::triangle, 6, 28},     ElementType{43, F::triangle, 7, 36},
    ElementType{44, F::triangle, 8, 45},     ElementType{45, F::triangle, 9, 55},
    ElementType{46, F::triangle, 10, 66},    ElementType{47, F::quadrangle, 6, 49},
    ElementType{48, F::quadrangle, 7, 64},   ElementType{49, F::quadrangle, 8, 81},
    ElementType{50, F::quadrangle, 9, 100},  ElementType{51, F::quadrangle, 10, 121},
    ElementType{62, F::line, 6, 7},          ElementType{63, F::line, 7, 8},
    ElementType{64, F::line, 8, 9},          ElementType{65, F::line, 9, 10},
    ElementType{66, F::line, 10, 11},        ElementType{71, F::tetrahedron, 6, 84},
    ElementType{72, F::tetrahedron, 7, 120}, ElementType{73, F::tetrahedron, 8, 165},
    ElementType{74, F::tetrahedron, 9, 220}, ElementType{75, F::tetrahedron, 10, 286},
    ElementType{90, F::prism, 3, 40},        ElementType{91, F::prism, 4, 75},
    ElementType{92, F::hexahedron, 3, 64},   ElementType{93, F::hexahedron, 4, 125},
    ElementType{94, F::hexahedron, 5, 216},  ElementType{118, F::pyramid, 3, 30},
    ElementType{119, F::pyramid, 4, 55},
};

constexpr std::array<std::array<const char*, 2>, 8> names{{{"point", "points"},
                                                           {"line", "lines"},
                                                           {"triangle", "triangles"},
                                                           {"quadrangle", "quadrangles"},
                                                           {"tetrahedron", "tetrahedra"},
                                                           {"hexahedron", "hexahedra"},
                                                           {"prism", "prisms"},
                                                           {"pyramid", "pyramids"}}};

}  // namespace

int ElementType::dimension() const {
    return family == F::point ? 0 : family == F::line ? 1 : family <= F::quadrangle ? 2 : 3;
}

std::string ElementType::counted(std::size_t count) const {
    std::string text = std::to_string(count) + " " + names[static_cast<std::size_t>(family)][count == 1 ? 0 : 1];
    if (order > 1) text += " of order " + std::to_string(order);
    return text;
}

const ElementType* element_type(std::int64_t number) {
    const auto* const found = std::lower_bound(all.begin(), all.end(), number,
                                               [](const ElementType& type, std::int64_t n) { return type.number < n; });
    return found == all.end() || found->number != number ? nullptr : found;
}

std::span<const ElementType> element_types() {
    return all;
}

std::string counted_types(const TypeCounts& counts, int low, int high) {
    std::string text;
    for (const ElementType& type : all) {
        const std::size_t count = counts[static_cast<std::size_t>(type.number)];
        if (count == 0 || type.dimension() < low || type.dimension() > high) continue;
        text += (text.empty() ? "" : ", ") + type.counted(count);
    }
    return text;
}

namespace {

const ElementType* known(const Walk& walk, std::int64_t number) {
    const ElementType* const type = element_type(number);
    if (type == nullptr)
        walk.refuse("an unknown type of elements", "a type of Gmsh's documentation", std::to_string(number),
                    "write the mesh with elements of order 1 or 2");
    return type;
}

/// Appends a block and moves over it.
void append_block(Walk& walk, MshElements& elements, ElementBlock block) {
    elements.counts[static_cast<std::size_t>(block.type->number)] += block.run.count;
    block.run.at = walk.at();
    block.first = elements.count;
    elements.count += block.run.count;
    elements.blocks.push_back(block);
    walk.skip_rows(static_cast<std::int64_t>(block.run.count), block.run.numbers, block.run.bytes, "elements");
}

/// The blanks behind the tag of an element of 2.x, its type and the number of its tags, if they are few bytes.
FewBytes type_and_tags(const Walk& walk) {
    std::size_t one = 1, three = 3;
    const char* const from = skip_words(walk.at(), walk.end(), one);
    const auto size = static_cast<std::size_t>(skip_words(walk.at(), walk.end(), three) - from) + 1;  // a blank, too
    FewBytes out;
    if (size >= 8) return out;
    std::memcpy(&out.bytes, from, size);
    std::memset(&out.mask, 0xFF, size);
    return out;
}

/// The next elements of 2.x text that are of one type and have as many tags.
void find_rows_alike(const MshFile& file, Walk& walk, std::int64_t most, MshElements& elements) {
    Walk row = walk;
    row.integer("the tag of an element");
    const std::int64_t number = row.integer("the type of an element");
    const ElementType* const type = known(row, number);
    const std::int64_t tags = row.integer("the number of tags of an element");
    if (tags < 0) row.refuse("bad number", "the number of tags of an element", std::to_string(tags));
    row.skip_rows(tags, 1, 4, "tags of an element");
    row.skip_rows(static_cast<std::int64_t>(type->nodes), 1, 4, "nodes of an element");
    const std::size_t words = 3 + static_cast<std::size_t>(tags) + type->nodes;
    const auto like = [&](TextRow next) {
        std::array<std::int64_t, 3> values{};
        return next.integer(values[0], "") && next.integer(values[1], "") && next.integer(values[2], "") &&
               values[1] == number && values[2] == tags;
    };
    const std::size_t count =
        rows_alike(file, walk.at(), walk.end(), words, static_cast<std::size_t>(most), like, type_and_tags(walk));
    append_block(walk, elements,
                 {.type = type, .tags = static_cast<std::size_t>(tags), .run = {.count = count, .numbers = words}});
}

void find_group(Walk& walk, std::int64_t most, std::int64_t count, MshElements& elements) {
    const ElementType* const type = known(walk, walk.integer("the type of elements"));
    const std::int64_t size = walk.integer("the number of elements");
    const std::int64_t tags = walk.integer("the number of tags of an element");
    if (size < 1 || tags < 0 || size > most)
        walk.refuse("bad header of elements", std::to_string(count) + " elements in all",
                    std::to_string(size) + " with " + std::to_string(tags) + " tags");
    const auto tag_count = static_cast<std::size_t>(tags);
    append_block(walk, elements,
                 {.type = type,
                  .tags = tag_count,
                  .run = {.count = static_cast<std::size_t>(size), .bytes = 4 * (1 + tag_count + type->nodes)}});
}

}  // namespace

MshElements find_msh_elements(const MshFile& file) {
    const MshSection* const section = file.find("Elements");
    if (section == nullptr)
        refuse_file(file.path(), "the file contains no elements", "a section $Elements", "none",
                    "name a file with a mesh; this one may contain points only");
    Walk walk(file, *section);
    MshElements elements;
    if (file.version() != 22) {
        const std::size_t number_bytes = file.version() == 41 ? 8 : 4;
        const auto add = [&](const BlockHeader& b) {
            const ElementType* const type = known(walk, b.kind);
            const auto count = static_cast<std::size_t>(b.count), numbers = 1 + type->nodes;
            append_block(walk, elements,
                         {.type = type,
                          .entity = b.entity,
                          .run = {.count = count, .numbers = numbers, .bytes = numbers * number_bytes}});
        };
        walk_blocks(walk, file.version(), "elements", "the type of elements", elements.count, add);
        return elements;
    }
    const std::int64_t count = walk.count_line("the number of elements");
    if (count > INT32_MAX)
        walk.refuse("bad number", "the number of elements, at most 2147483647", std::to_string(count));
    while (elements.count < static_cast<std::size_t>(count)) {
        const std::int64_t most = count - static_cast<std::int64_t>(elements.count);
        walk.text() ? find_rows_alike(file, walk, most, elements) : find_group(walk, most, count, elements);
    }
    walk.need_end();
    return elements;
}

}  // namespace barycert::io
