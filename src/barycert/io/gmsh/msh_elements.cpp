// 2.x text    count, rows: tag type tag-count tag... node...
// 2.x binary  count, groups: type count tag-count, rows: tag tag... node...
// 4.0         blocks count, blocks: entity dimension type count, rows: tag node...
// 4.1         blocks count lowest highest, blocks: dimension entity type count, rows: tag node...
#include <cstring>
#include <string>

#include "barycert/io.hpp"
#include "barycert/io/gmsh/msh_parts.hpp"

namespace barycert::io {
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
        throw Exception(file_error(file.path(), "the file contains no elements", "a section $Elements", "none",
                                   "name a file with a mesh; this one may contain points only"));
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
