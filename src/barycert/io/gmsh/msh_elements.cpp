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

bool known(Walk& walk, std::int64_t number, const ElementType*& type) {
    type = element_type(number);
    return type != nullptr || walk.refuse("an unknown type of elements", "a type of Gmsh's documentation",
                                          std::to_string(number), "write the mesh with elements of order 1 or 2");
}

/// Appends a block and moves over it.
bool append_block(Walk& walk, MshElements& elements, ElementBlock block) {
    elements.counts[static_cast<std::size_t>(block.type->number)] += block.run.count;
    block.run.at = walk.at();
    block.first = elements.count;
    elements.count += block.run.count;
    elements.blocks.push_back(block);
    return walk.skip_rows(static_cast<std::int64_t>(block.run.count), block.run.numbers, block.run.bytes, "elements");
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
bool find_rows_alike(const MshFile& file, Walk& walk, std::int64_t most, MshElements& elements) {
    Walk row = walk;
    std::int64_t tag = 0, number = 0, tags = 0;
    const ElementType* type = nullptr;
    const bool whole =
        row.integer(tag, "the tag of an element") && row.integer(number, "the type of an element") &&
        known(row, number, type) && row.integer(tags, "the number of tags of an element") &&
        (tags >= 0 || row.refuse("bad number", "the number of tags of an element", std::to_string(tags))) &&
        row.skip_rows(tags, 1, 4, "tags of an element") &&
        row.skip_rows(static_cast<std::int64_t>(type->nodes), 1, 4, "nodes of an element");
    if (!whole) {
        walk = row;
        return false;
    }
    const std::size_t words = 3 + static_cast<std::size_t>(tags) + type->nodes;
    const auto like = [&](TextRow next) {
        std::array<std::int64_t, 3> values{};
        return next.integer(values[0], "") && next.integer(values[1], "") && next.integer(values[2], "") &&
               values[1] == number && values[2] == tags;
    };
    const std::size_t count =
        rows_alike(file, walk.at(), walk.end(), words, static_cast<std::size_t>(most), like, type_and_tags(walk));
    return append_block(
        walk, elements,
        {.type = type, .tags = static_cast<std::size_t>(tags), .run = {.count = count, .numbers = words}});
}

bool find_group(Walk& walk, std::int64_t most, std::int64_t count, MshElements& elements) {
    std::int64_t number = 0, size = 0, tags = 0;
    const ElementType* type = nullptr;
    if (!walk.integer(number, "the type of elements") || !known(walk, number, type) ||
        !walk.integer(size, "the number of elements") || !walk.integer(tags, "the number of tags of an element")) {
        return false;
    }
    if (size < 1 || tags < 0 || size > most)
        return walk.refuse("bad header of elements", std::to_string(count) + " elements in all",
                           std::to_string(size) + " with " + std::to_string(tags) + " tags");
    const auto tag_count = static_cast<std::size_t>(tags);
    return append_block(walk, elements,
                        {.type = type,
                         .tags = tag_count,
                         .run = {.count = static_cast<std::size_t>(size), .bytes = 4 * (1 + tag_count + type->nodes)}});
}

bool find_in_section(const MshFile& file, Walk& walk, MshElements& elements) {
    std::int64_t count = 0;
    if (file.version() != 22) {
        return walk_blocks(walk, file.version(), "elements", "the type of elements", elements.count,
                           [&](const BlockHeader& b) {
                               const ElementType* type = nullptr;
                               if (!known(walk, b.kind, type)) return false;
                               const std::size_t numbers = 1 + type->nodes;
                               return append_block(walk, elements,
                                                   {.type = type,
                                                    .entity = b.entity,
                                                    .run = {.count = static_cast<std::size_t>(b.count),
                                                            .numbers = numbers,
                                                            .bytes = numbers * (file.version() == 41 ? 8 : 4)}});
                           });
    }
    if (!walk.count_line(count, "the number of elements")) return false;
    if (count > INT32_MAX)
        return walk.refuse("bad number", "the number of elements, at most 2147483647", std::to_string(count));
    while (elements.count < static_cast<std::size_t>(count)) {
        const std::int64_t most = count - static_cast<std::int64_t>(elements.count);
        if (!(walk.text() ? find_rows_alike(file, walk, most, elements) : find_group(walk, most, count, elements)))
            return false;
    }
    return walk.at_end();
}

}  // namespace

Result<MshElements> find_msh_elements(const MshFile& file) {
    const MshSection* const section = file.find("Elements");
    if (section == nullptr)
        return file_error(file.path(), "the file contains no elements", "a section $Elements", "none",
                          "name a file with a mesh; this one may contain points only");
    Walk walk(file, *section);
    MshElements elements;
    if (!find_in_section(file, walk, elements)) return walk.error();
    return elements;
}

}  // namespace barycert::io
