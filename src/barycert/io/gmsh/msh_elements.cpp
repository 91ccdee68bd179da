// 2.x text    count, rows: tag type tag-count tag... node...
// 2.x binary  count, groups: type count tag-count, rows: tag tag... node...
// 4.0         blocks count, blocks: entity dimension type count, rows: tag node...
// 4.1         blocks count lowest highest, blocks: dimension entity type count, rows: tag node...
#include "barycert/io/gmsh/msh_elements.hpp"

#include <cstring>
#include <string>

#include "barycert/io/gmsh/walk.hpp"

namespace barycert::io {
namespace {

constexpr std::size_t max_elements = INT32_MAX;

bool known(Walk& walk, std::int64_t number, const ElementType*& type) {
    type = element_type(number);
    return type != nullptr || walk.refuse("an unknown type of elements", "a type of Gmsh's documentation",
                                          std::to_string(number), "write the mesh with elements of order 1 or 2");
}

/// Appends a block, or makes the last one longer if it goes on in text.
void append_block(MshElements& elements, const ElementBlock& block, bool text) {
    elements.counts[static_cast<std::size_t>(block.type->number)] += block.run.count;
    if (text && !elements.blocks.empty() && elements.blocks.back().type == block.type) {
        elements.blocks.back().run.count += block.run.count;
    } else {
        elements.blocks.push_back(block);
        elements.blocks.back().first = elements.count;
    }
    elements.count += block.run.count;
}

/// The types of lines of 2.x.
bool find_line_types(const MshFile& file, const LineIndex::Part& part, Place place, std::vector<ElementBlock>& blocks) {
    const char* const end = file.data().bytes().data() + file.data().bytes().size();
    place = {part.at, place.line + part.first};
    for (std::size_t i = part.first; i < part.last; ++i, ++place.line) {
        TextRow<false> row(place.at, end);
        std::int64_t tag = 0, number = 0;
        if (!row.integer(tag, "") || !row.integer(number, "")) return false;
        if (blocks.empty() || blocks.back().type->number != number) {
            const ElementType* const type = element_type(number);
            if (type == nullptr) return false;
            blocks.push_back({.type = type, .run = {place, 0}});
        }
        ++blocks.back().run.count;
        const void* const feed = std::memchr(row.at(), '\n', static_cast<std::size_t>(end - row.at()));
        if (feed == nullptr) return false;
        place.at = static_cast<const char*>(feed) + 1;
    }
    return true;
}

bool find_lines(const MshFile& file, Walk& walk, std::int64_t count, MshElements& elements) {
    const Place first = walk.place();
    if (!walk.skip_rows(count, 4, 8, "elements")) return false;
    const std::vector<LineIndex::Part> parts = file.lines().cut(first, static_cast<std::size_t>(count));
    std::vector<std::vector<ElementBlock>> found(parts.size());
    if (!base::share_work(file.threads(), parts.size(),
                          [&](std::size_t i) { return find_line_types(file, parts[i], first, found[i]); })) {
        return false;
    }
    for (const auto& blocks : found) {
        for (const ElementBlock& block : blocks) append_block(elements, block, true);
    }
    return walk.at_end();
}

/// Text as it comes.
bool find_words(Walk& walk, std::int64_t count, MshElements& elements) {
    for (std::int64_t i = 0; i < count; ++i) {
        std::int64_t tag = 0, number = 0, tags = 0;
        const Place place = walk.place();
        const ElementType* type = nullptr;
        if (!walk.integer(tag, "the tag of an element") || !walk.integer(number, "the type of an element") ||
            !known(walk, number, type) || !walk.integer(tags, "the number of tags of an element")) {
            return false;
        }
        if (tags < 0) return walk.refuse("bad number", "the number of tags of an element", std::to_string(tags));
        if (!walk.skip_rows(tags, 1, 4, "tags of an element") ||
            !walk.skip_rows(static_cast<std::int64_t>(type->nodes), 1, 4, "nodes of an element")) {
            return false;
        }
        append_block(elements, {.type = type, .run = {place, 1}}, true);
    }
    return walk.at_end();
}

bool find_groups(Walk& walk, std::int64_t count, MshElements& elements) {
    while (elements.count < static_cast<std::uint64_t>(count)) {
        std::int64_t number = 0, size = 0, tags = 0;
        const ElementType* type = nullptr;
        if (!walk.integer(number, "the type of elements") || !known(walk, number, type) ||
            !walk.integer(size, "the number of elements") || !walk.integer(tags, "the number of tags of an element")) {
            return false;
        }
        if (size < 1 || tags < 0 || size > count - static_cast<std::int64_t>(elements.count)) {
            return walk.refuse("bad header of elements", std::to_string(count) + " elements in all",
                               std::to_string(size) + " with " + std::to_string(tags) + " tags");
        }
        const std::size_t bytes = 4 * (1 + static_cast<std::size_t>(tags) + type->nodes);
        const Place place = walk.place();
        if (!walk.skip_rows(size, 0, bytes, "elements")) return false;
        append_block(elements,
                     {.type = type,
                      .tags = static_cast<std::size_t>(tags),
                      .run = {place, static_cast<std::size_t>(size), 0, bytes}},
                     false);
    }
    return walk.at_end();
}

bool find_element_blocks(Walk& walk, int version, MshElements& elements) {
    std::int64_t blocks = 0, total = 0, ignored = 0;
    if (!walk.size(blocks, "the number of blocks") || !walk.size(total, "the number of elements")) return false;
    if (version == 41 && !(walk.size(ignored, "the lowest tag") && walk.size(ignored, "the highest tag"))) return false;
    if (!walk.end_header()) return false;
    for (std::int64_t i = 0; i < blocks; ++i) {
        std::int64_t first = 0, second = 0, number = 0, count = 0;
        const ElementType* type = nullptr;
        if (!walk.integer(first, "the dimension or tag of an entity") ||
            !walk.integer(second, "the dimension or tag of an entity") ||
            !walk.integer(number, "the type of elements") || !known(walk, number, type) ||
            !walk.size(count, "the number of elements in a block") || !walk.end_header()) {
            return false;
        }
        if (static_cast<std::uint64_t>(count) > max_elements - elements.count)
            return walk.refuse("too many elements", "at most 2147483647", "more");
        const Place place = walk.place();
        const std::size_t numbers = 1 + type->nodes, bytes = numbers * (version == 41 ? 8 : 4);
        if (!walk.skip_rows(count, numbers, bytes, "elements")) return false;
        append_block(elements,
                     {.type = type,
                      .entity = version == 41 ? second : first,
                      .run = {place, static_cast<std::size_t>(count), 0, bytes}},
                     false);
    }
    if (static_cast<std::uint64_t>(total) != elements.count) {
        return walk.refuse("the blocks do not add up", std::to_string(total) + " elements",
                           std::to_string(elements.count), "mend the numbers of elements");
    }
    return walk.at_end();
}

bool find_in_section(const MshFile& file, Walk& walk, MshElements& elements) {
    if (file.version() != 22) return find_element_blocks(walk, file.version(), elements);
    std::int64_t count = 0;
    if (!walk.count_line(count, "the number of elements")) return false;
    if (static_cast<std::size_t>(count) > max_elements)
        return walk.refuse("bad number", "the number of elements, at most 2147483647", std::to_string(count));
    switch (file.layout()) {
        case MshLayout::lines:
            return find_lines(file, walk, count, elements);
        case MshLayout::free:
            return find_words(walk, count, elements);
        default:
            return find_groups(walk, count, elements);
    }
}

}  // namespace

Result<MshElements> find_msh_elements(const MshFile& file) {
    const MshSection* const section = file.find("Elements");
    if (section == nullptr) {
        return Error{.what = "the file contains no elements",
                     .file = file.path(),
                     .expected = "a section $Elements",
                     .found = "none",
                     .remedy = "name a file with a mesh; this one may contain points only"};
    }
    Walk walk(file, *section);
    MshElements elements;
    if (!find_in_section(file, walk, elements)) return walk.error();
    return elements;
}

}  // namespace barycert::io
