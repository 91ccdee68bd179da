// Where the rows of nodes and elements are, and the nodes themselves.
//
// nodes     2.x          count, rows: tag x y z            ($ParametricNodes: ... dimension entity [u [v]])
//           4.0          blocks count, blocks: entity dimension parametric count, rows: tag x y z [u [v [w]]]
//           4.1          blocks count lowest highest, blocks: dimension entity parametric count, rows: tag,
//                        rows: x y z [u [v [w]]]
// elements  2.x text     count, rows: tag type tag-count tag... node...
//           2.x binary   count, groups: type count tag-count, rows: tag tag... node...
//           4.0          blocks count, blocks: entity dimension type count, rows: tag node...
//           4.1          blocks count lowest highest, blocks: dimension entity type count, rows: tag node...
//
// Parameters u, v, w of a node on its curve, surface or volume are passed over.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/base/large_pages.hpp"
#include "core/base/workers.hpp"
#include "io/errors.hpp"
#include "io/gmsh/msh_file.hpp"
#include "io/gmsh/msh_parts.hpp"
#include "io/other_formats.hpp"
#include "io/tetgen/scanner.hpp"

namespace barycert::io {
namespace {

struct BlockHeader {
    std::int64_t dimension = 0, entity = 0;
    std::int64_t kind = 0;  ///< of nodes: whether they have parameters; of elements: their type
    std::int64_t count = 0;
};

/// Calls add(header) for each block of 4.x, which moves over its rows, `found` so far. `kind`: of BlockHeader.
template <class Add>
void walk_blocks(Walk& walk, int version, const std::string& what, const char* kind, const std::size_t& found,
                 const Add& add) {
    constexpr std::uint64_t most = INT32_MAX;
    constexpr const char* entity = "the tag of an entity";
    const std::string all = "the number of " + what, one = all + " in a block";
    const std::int64_t blocks = walk.size("the number of blocks"), total = walk.size(all.c_str());
    if (version == 41) {
        walk.size("the lowest tag");
        walk.size("the highest tag");
    }
    for (std::int64_t i = 0; i < blocks; ++i) {
        BlockHeader block;
        if (version == 40) block.entity = walk.integer(entity);
        block.dimension = walk.integer("the dimension of an entity");
        if (version == 41) block.entity = walk.integer(entity);
        block.kind = walk.integer(kind);
        block.count = walk.size(one.c_str());
        if (static_cast<std::uint64_t>(block.count) > most - found)
            walk.refuse("mesh.too-large", "too many " + what, "at most 2147483647", "more");
        add(block);
    }
    if (static_cast<std::uint64_t>(total) != found)
        walk.refuse("file.count", "the blocks do not add up", std::to_string(total) + " " + what, std::to_string(found),
                    "mend the numbers of " + what);
    walk.need_end();
}

/// Where the rows of nodes are. `id` of a run: how many numbers that are passed over follow the coordinates.
struct NodeRows {
    std::vector<Run> tags;    ///< 4.1
    std::vector<Run> points;  ///< with the tags in other versions
    std::size_t count = 0;
};

void add_rows(Walk& walk, int version, std::int64_t count, std::size_t passed, NodeRows& rows) {
    const auto add = [&](std::vector<Run>& to, std::size_t numbers, std::size_t bytes, const char* name) {
        to.push_back({walk.at(), static_cast<std::size_t>(count), rows.count, numbers, bytes, passed});
        walk.skip_rows(count, numbers, bytes, name);
    };
    const std::size_t numbers = 3 + passed, bytes = 8 * numbers, tag = version == 41 ? 0 : 1;
    if (version == 41) add(rows.tags, 1, 8, "tags of nodes");
    add(rows.points, numbers + tag, bytes + 4 * tag, "nodes");
    rows.count += static_cast<std::size_t>(count);
}

/// Rows differ in length: behind the coordinates stand dimension, entity and as many parameters, but none of 3.
void find_parametric_rows(const MshFile& file, Walk& walk, std::int64_t count, NodeRows& rows) {
    Walk(walk).skip_rows(count, 6, 1, "nodes");
    while (rows.count < static_cast<std::size_t>(count)) {
        NumberScanner<true> row(file, walk.at());
        double ignored = 0;
        std::int64_t dimension = 0;
        for (int i = 0; i < 4; ++i) row.any_real(ignored, "");
        row.integer(dimension, "");
        const std::size_t passed = 2 + (dimension == 1 || dimension == 2 ? static_cast<std::size_t>(dimension) : 0);
        add_rows(walk, 22, 1, passed, rows);
        if (rows.points.size() == 1 || rows.points.end()[-2].id != passed) continue;
        rows.points.pop_back();
        ++rows.points.back().count;
    }
}

NodeRows find_rows(const MshFile& file, Walk& walk, bool parametric) {
    NodeRows rows;
    if (file.version() != 22) {
        const auto add = [&](const BlockHeader& block) {
            if (block.dimension < 0 || block.dimension > 3)
                walk.refuse("file.syntax", "bad dimension of an entity", "0 to 3", std::to_string(block.dimension));
            if (block.kind != 0 && block.kind != 1)
                walk.refuse("file.syntax", "bad mark of parameters", "0 or 1", std::to_string(block.kind));
            const std::int64_t passed = block.kind * block.dimension;
            add_rows(walk, file.version(), block.count, static_cast<std::size_t>(passed), rows);
        };
        walk_blocks(walk, file.version(), "nodes", "0 or 1, whether nodes have parameters", rows.count, add);
        return rows;
    }
    const std::int64_t count = walk.count_line("the number of nodes");
    if (count > INT32_MAX) walk.refuse("mesh.too-large", "too many nodes", "at most 2147483647", "more");
    if (parametric) {
        find_parametric_rows(file, walk, count, rows);
    } else {
        add_rows(walk, 22, count, 0, rows);
        walk.need_end();
    }
    return rows;
}

bool take_tag(auto& row, std::int64_t& tag) {
    return row.tag(tag, "the tag of a node") &&
           (tag >= 0 || row.refuse({"mesh.numbering", "bad tag of a node", "a number that is not negative", tag}));
}

const ElementType* known(const Walk& walk, std::int64_t number) {
    const ElementType* const type = element_type(number);
    if (type == nullptr)
        walk.refuse("mesh.cell-type", "an unknown type of elements", "a type of Gmsh's documentation",
                    std::to_string(number), "write the mesh with elements of order 1 or 2");
    return type;
}

void append_block(Walk& walk, MshElements& elements, ElementBlock block) {
    Run& run = block.run;
    run.at = walk.at();
    run.first = elements.count;
    run.id = elements.blocks.size();
    if (run.count != 0) elements.counts[block.type] += run.count;
    elements.count += run.count;
    walk.skip_rows(static_cast<std::int64_t>(run.count), run.numbers, run.bytes, "elements");
    elements.blocks.push_back(block);
}

/// Elements of 2.x text that are of one type and have as many tags.
struct LikeElements {
    std::int64_t type, tags;
    std::size_t words;  ///< a row
    /// The blanks behind the tag of an element, its type and the number of its tags, if they are few bytes.
    FewBytes second;

    bool has(NumberScanner<true> row) const {
        std::int64_t tag = 0, own_type = 0, own_tags = 0;
        return row.integer(tag, "") && row.integer(own_type, "") && row.integer(own_tags, "") && own_type == type &&
               own_tags == tags;
    }
};

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

/// How many rows from here on are whole and such elements, `most` at most.
std::size_t count_alike(const MshFile& file, const Walk& walk, const LikeElements& like, std::size_t most) {
    const char* at = walk.at();
    std::size_t alike = 0;
    for (const std::size_t few = std::min<std::size_t>(most, 16); alike < few; ++alike) {
        std::size_t skipped = like.words;
        const char* const next = skip_words(at, walk.end(), skipped);
        if (skipped != like.words || !like.has({file, at})) return alike;
        at = next;
    }
    if (alike == most) return alike;
    const WordIndex& index = file.words();
    const std::size_t base = index.before(at), first = alike;
    most = std::min(most, alike + (index.before(walk.end()) - base) / like.words);
    // Twice as far each time, so that little is looked at for nothing.
    for (std::size_t look = 64; alike < most; look *= 2) {
        const std::size_t count = std::min(look, most - alike);
        const Run run{.at = index.find(base + (alike - first) * like.words), .count = count, .numbers = like.words};
        const std::vector<RunPart> parts = file.cut({&run, 1});
        std::atomic<std::size_t> found{count};
        base::share_work(file.threads(), parts.size(), [&](std::size_t p) {
            const char* next = parts[p].at;
            for (std::size_t i = parts[p].first; i < parts[p].last && i < found; ++i) {
                if (const char* const plain =
                        like.second.mask == 0 ? nullptr : plain_row_end(next, like.words, like.second);
                    plain != nullptr) {
                    next = plain;
                    continue;
                }
                if (!like.has({file, next})) {
                    for (std::size_t other = found; i < other && !found.compare_exchange_weak(other, i);) {
                    }
                }
                std::size_t skipped = like.words;
                next = skip_words(next, walk.end(), skipped);
            }
            return true;
        });
        alike += found;
        if (found != count) break;
    }
    return alike;
}

void find_rows_alike(const MshFile& file, Walk& walk, std::size_t most, MshElements& elements) {
    Walk row = walk;
    row.integer("the tag of an element");
    const ElementType* const type = known(row, row.integer("the type of an element"));
    const std::int64_t tags = row.integer("the number of tags of an element");
    if (tags < 0) row.refuse("file.number", "bad number", "the number of tags of an element", std::to_string(tags));
    row.skip_rows(tags, 1, 4, "tags of an element");
    row.skip_rows(static_cast<std::int64_t>(type->nodes), 1, 4, "nodes of an element");
    const auto tag_count = static_cast<std::size_t>(tags), words = 3 + tag_count + type->nodes;
    const std::size_t count = count_alike(file, walk, {type->number, tags, words, type_and_tags(walk)}, most);
    append_block(walk, elements, {.type = type, .tags = tag_count, .run = {.count = count, .numbers = words}});
}

/// The next group of 2.x binary.
void find_group(Walk& walk, std::size_t most, std::int64_t count, MshElements& elements) {
    const ElementType* const type = known(walk, walk.integer("the type of elements"));
    const std::int64_t size = walk.integer("the number of elements");
    const std::int64_t tags = walk.integer("the number of tags of an element");
    const auto rows = static_cast<std::size_t>(size), tag_count = static_cast<std::size_t>(tags);
    if (size < 1 || tags < 0 || rows > most)
        walk.refuse("file.count", "bad header of elements", std::to_string(count) + " elements in all",
                    std::to_string(size) + " with " + std::to_string(tags) + " tags");
    append_block(walk, elements,
                 {.type = type, .tags = tag_count, .run = {.count = rows, .bytes = 4 * (1 + tag_count + type->nodes)}});
}

}  // namespace

MshNodes read_msh_nodes(const MshFile& file) {
    const MshSection* section = file.find("Nodes");
    const bool parametric = section == nullptr && file.version() == 22;
    if (parametric) section = file.find("ParametricNodes");
    if (section == nullptr)
        refuse_file("mesh.empty", file.path(), "the file contains no nodes", "a section $Nodes", "none",
                    "name a file with a mesh; this one may contain views or a geometry only");
    if (parametric && file.binary())
        file.refuse("file.unsupported", section->name.data(), "binary $ParametricNodes", "$Nodes",
                    "nodes with parameters", "convert it with " + gmsh_command(file.path()));
    Walk walk(file, *section);
    const NodeRows rows = find_rows(file, walk, parametric);

    MshNodes nodes;
    std::vector<std::int64_t> tags;
    base::resize_large(nodes.points, 3 * rows.count);
    base::resize_large(tags, rows.count);
    double* const points = nodes.points.data();
    std::int64_t* const tag_of = tags.data();
    parse_runs(file, section->name, rows.tags,
               [tag_of](auto& row, const Run&, std::size_t i) { return take_tag(row, tag_of[i]); });
    const bool tagged = file.version() != 41;
    parse_runs(file, section->name, rows.points, [=](auto& row, const Run& run, std::size_t i) {
        if (tagged && !take_tag(row, tag_of[i])) return false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!row.real(points[3 * i + axis], "a finite coordinate")) return false;
        }
        std::int64_t integer = 0;
        if (parametric && !(row.integer(integer, "a dimension") && row.integer(integer, "the tag of an entity")))
            return false;
        double ignored = 0;
        for (std::size_t passed = parametric ? 2 : 0; passed < run.id; ++passed) {
            if (!row.any_real(ignored, "a parameter of a node")) return false;
        }
        return true;
    });
    nodes.index = TagIndex(tags);
    if (const auto twice = nodes.index.first_twice; twice)
        file.refuse("mesh.numbering", section->name.data(), "two nodes with the tag " + std::to_string(tags[*twice]),
                    "each tag once", "it again at node " + std::to_string(*twice) + " from 0",
                    "number the nodes anew: Gmsh itself cannot read such a file");
    return nodes;
}

MshElements find_msh_elements(const MshFile& file) {
    const MshSection* const section = file.find("Elements");
    if (section == nullptr)
        refuse_file("mesh.empty", file.path(), "the file contains no elements", "a section $Elements", "none",
                    "name a file with a mesh; this one may contain points only");
    Walk walk(file, *section);
    MshElements elements;
    if (file.version() != 22) {
        const auto add = [&](const BlockHeader& block) {
            const ElementType* const type = known(walk, block.kind);
            const auto count = static_cast<std::size_t>(block.count), numbers = 1 + type->nodes;
            append_block(walk, elements,
                         {.type = type,
                          .entity = block.entity,
                          .run = {.count = count, .numbers = numbers, .bytes = 8 * numbers}});
        };
        walk_blocks(walk, file.version(), "elements", "the type of elements", elements.count, add);
        return elements;
    }
    const std::int64_t count = walk.count_line("the number of elements");
    if (count > INT32_MAX)
        walk.refuse("file.number", "bad number", "the number of elements, at most 2147483647", std::to_string(count));
    while (elements.count < static_cast<std::size_t>(count)) {
        const std::size_t most = static_cast<std::size_t>(count) - elements.count;
        walk.text() ? find_rows_alike(file, walk, most, elements) : find_group(walk, most, count, elements);
    }
    walk.need_end();
    return elements;
}

}  // namespace barycert::io
