#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/range.hpp"
#include "core/base/text.hpp"
#include "io/errors.hpp"
#include "io/gmsh/msh_parts.hpp"
#include "io/row_output.hpp"
#include "mesh/consistency.hpp"
#include "mesh/mid_edges.hpp"

namespace barycert {
namespace io {
namespace {

struct CellGroups {
    std::vector<std::int64_t> tags;                    ///< of elements
    std::vector<std::int32_t> physical;                ///< a cell; empty: none
    std::vector<std::int32_t> entity;                  ///< a cell; empty: 1
    std::map<std::int32_t, std::int32_t> physical_of;  ///< of each entity, 0 for none; `by_entity` alone
    std::map<std::int32_t, std::string> names;         ///< of physical groups
    std::vector<const Field*> data;                    ///< the cell fields that are written as such

    std::int32_t entity_of(std::size_t cell) const { return entity.empty() ? 1 : entity[cell]; }
    std::int32_t group_of(std::size_t cell) const { return physical.empty() ? 0 : physical[cell]; }
};

/// The values of a field of one component, if each is an integer of 32 bits (and no -0, which would not come back).
std::optional<std::vector<std::int32_t>> integers(const Field& field) {
    std::vector<std::int32_t> values;
    values.reserve(field.data.size());
    for (const double x : field.data) {
        if (!(std::fabs(x) <= INT32_MAX) || x != std::trunc(x) || (x == 0 && std::signbit(x))) return std::nullopt;
        values.push_back(static_cast<std::int32_t>(x));
    }
    return values;
}

template <class T>
const std::vector<T>* find_label(const Mesh& mesh, const char* name) {
    const auto is_it = [&](const Column& c) { return c.name == name && c.size() == mesh.cell_count(); };
    const auto found = std::ranges::find_if(mesh.cell_labels, is_it);
    return found == mesh.cell_labels.end() ? nullptr : std::get_if<std::vector<T>>(&found->values);
}

/// The tags of the file the mesh came from, where they can be tags; else numbers.
std::vector<std::int64_t> element_tags(const Mesh& mesh) {
    if (const auto* const label = find_label<std::int64_t>(mesh, "gmsh:tag"); label != nullptr) {
        std::vector<std::int64_t> sorted = *label;
        std::sort(sorted.begin(), sorted.end());
        const bool differ = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
        if (differ && !sorted.empty() && sorted.front() >= 1 && sorted.back() <= INT32_MAX) return *label;
    }
    std::vector<std::int64_t> tags(mesh.cell_count());
    std::iota(tags.begin(), tags.end(), 1);
    // Parts of one cell have its number.
    const std::vector<Mesh::Index>& numbers = mesh.cell_numbers;
    if (std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end()) {
        for (std::size_t i = 0; i < numbers.size(); ++i) tags[i] = std::int64_t{numbers[i]} + 1;
    }
    return tags;
}

/// Sets `physical_of`. False: an entity had several groups, and its parts are entities of their own now.
bool settle_entities(CellGroups& groups, std::size_t cells) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> parts;  // their entities and groups: their numbers
    std::vector<std::int32_t> part_of(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        const auto next = static_cast<std::int32_t>(parts.size()) + 1;
        part_of[i] = parts.emplace(std::pair(groups.entity_of(i), groups.group_of(i)), next).first->second;
    }
    for (const auto& [part, number] : parts) groups.physical_of.insert(part);
    if (groups.physical_of.size() == parts.size()) return true;
    groups.entity = std::move(part_of);
    groups.physical_of.clear();
    for (const auto& [part, number] : parts) groups.physical_of[number] = part.second;
    return false;
}

/// `by_entity`: an entity can be in one group only (4.1). Error: one group with two names.
CellGroups group_cells(const Mesh& mesh, bool by_entity, const std::string& path) {
    CellGroups groups;
    groups.tags = element_tags(mesh);
    // Where all cells are of no group, or of entity 1 or none, the reader makes no field.
    const auto take = [&](const char* name, std::int32_t nothing, std::vector<std::int32_t>& to) -> const Field* {
        const auto field = std::ranges::find(mesh.cell_fields, name, &Field::name);
        if (field == mesh.cell_fields.end() || field->components != 1) return nullptr;
        auto values = integers(*field);
        const auto all_are = [&](std::int32_t value) {
            return std::ranges::count(*values, value) == std::ssize(*values);
        };
        if (!values || all_are(0) || all_are(nothing)) return nullptr;
        to = std::move(*values);
        return &*field;
    };
    const Field* const physical = take("gmsh:physical", 0, groups.physical);
    const Field* geometrical = take("gmsh:geometrical", 1, groups.entity);
    if (by_entity && !settle_entities(groups, mesh.cell_count())) geometrical = nullptr;
    if (groups.physical_of.empty()) groups.physical_of[1] = 0;
    for (const Field& field : mesh.cell_fields) {
        if (&field != physical && &field != geometrical) groups.data.push_back(&field);
    }
    const auto* const names = find_label<std::string>(mesh, "gmsh:physical_name");
    for (std::size_t i = 0; names != nullptr && !groups.physical.empty() && i < names->size(); ++i) {
        const std::int32_t group = std::abs(groups.physical[i]);
        const std::string& name = (*names)[i];
        if (group == 0 || name.empty()) continue;
        if (groups.names.emplace(group, name).first->second != name || name.find_first_of("\r\n") != std::string::npos)
            refuse_file("field.type", path,
                        "a name of physical group " + std::to_string(group) + " that cannot be written",
                        "one name for all of its cells, on one line", base::quoted(name),
                        "correct the cell labels gmsh:physical_name");
    }
    return groups;
}

void check_names(const Mesh& mesh, const CellGroups& groups, const std::string& path) {
    std::set<std::string> of_nodes, of_cells;
    const auto check = [&](std::set<std::string>& names, const std::string& name) {
        const bool fits = !name.empty() && name.find_first_of("\"\r\n") == std::string::npos;
        if (!fits || !names.insert(name).second)
            refuse_file("field.type", path, "a name of a field that cannot be written",
                        "names that differ, without quotes and line breaks",
                        name.empty() ? "no name" : base::quoted(name) + (fits ? " twice" : ""), "rename the field");
    };
    if (!mesh.point_markers.empty()) of_nodes.insert("marker");
    for (const Field& field : mesh.point_fields) check(of_nodes, field.name);
    for (const Field* field : groups.data) check(of_cells, field->name);
}

class GmshWriter {
public:
    GmshWriter(const Mesh& mesh, const CellGroups& groups, const std::string& path, const GmshWriteOptions& options)
        : mesh_(mesh),
          groups_(groups),
          out_(path, options.binary),
          new_(options.version == GmshWriteOptions::Version::v41) {}

    Status write() {
        write_format();
        write_names();
        if (new_) write_entities();
        write_nodes();
        out_.text("$Elements\n");
        new_ ? write_elements_41() : write_elements_22();
        end_section("Elements");
        for (const Field& field : mesh_.point_fields)
            write_data("NodeData", field.name, field.components, field.data, {});
        if (!mesh_.point_markers.empty()) write_data("NodeData", "marker", 1, mesh_.point_markers, {});
        for (const Field* field : groups_.data)
            write_data("ElementData", field->name, field->components, field->data, groups_.tags);
        return out_.commit();
    }

private:
    void line(std::uint64_t number) { out_.text(std::to_string(number) + "\n"); }
    void integer(std::int64_t value) {  // int
        out_.binary() ? out_.number(static_cast<std::int32_t>(value)) : out_.number(value);
    }
    /// A row of these, of their own types: int or size_t.
    template <class... Numbers>
    void row(Numbers... numbers) {
        (out_.number(numbers), ...);
        out_.end_row();
    }
    /// "$EndName", after binary data on a line of its own.
    void end_section(std::string_view name) {
        out_.text((out_.binary() ? "\n$End" : "$End") + std::string(name) + "\n");
    }

    void write_format() {
        out_.text(std::string("$MeshFormat\n") + (new_ ? "4.1 " : "2.2 ") + (out_.binary() ? "1" : "0") + " 8\n");
        if (out_.binary()) integer(1);
        end_section("MeshFormat");
    }

    void write_names() {
        if (groups_.names.empty()) return;
        out_.text("$PhysicalNames\n");
        line(groups_.names.size());
        for (const auto& [tag, name] : groups_.names)
            out_.text(std::to_string(mesh_.dimension) + " " + std::to_string(tag) + " \"" + name + "\"\n");
        out_.text("$EndPhysicalNames\n");
    }

    /// The entities of the cells, each with the box of its nodes.
    void write_entities() {
        std::map<std::int32_t, std::array<base::Range, 3>> boxes;
        const auto size = static_cast<std::size_t>(mesh_.dimension);
        for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) {
            auto& box = boxes[groups_.entity_of(cell)];
            for (const Mesh::Index node : mesh_.corners_of(cell)) {
                for (std::size_t axis = 0; axis < size; ++axis) box[axis].add(mesh_.point(node)[axis]);
            }
        }
        out_.text("$Entities\n");
        for (int d = 0; d < 4; ++d) out_.number(d == mesh_.dimension ? groups_.physical_of.size() : 0);
        out_.end_row();
        for (const auto& [entity, physical] : groups_.physical_of) {
            integer(entity);
            // Without extent where there is none: z in the plane, and a mesh without cells.
            for (const base::Range& side : boxes[entity]) out_.number(side.empty() ? 0 : side.low);
            for (const base::Range& side : boxes[entity]) out_.number(side.empty() ? 0 : side.high);
            out_.number(std::size_t{physical != 0});
            if (physical != 0) integer(physical);
            out_.number(std::size_t{0});
            out_.end_row();
        }
        end_section("Entities");
    }

    void write_nodes() {
        const auto dimension = static_cast<std::size_t>(mesh_.dimension);
        const std::size_t count = mesh_.point_count();
        out_.text("$Nodes\n");
        if (new_) {
            row(std::size_t{1}, count, std::size_t{1}, count);
            row(mesh_.dimension, groups_.physical_of.begin()->first, 0, count);
            for (std::size_t node = 0; node < count; ++node) row(node + 1);
        } else {
            line(count);
        }
        for (std::size_t node = 0; node < count; ++node) {
            if (!new_) integer(static_cast<std::int64_t>(node) + 1);
            for (std::size_t axis = 0; axis < 3; ++axis)
                out_.number(axis < dimension ? mesh_.points[node * dimension + axis] : 0);
            out_.end_row();
        }
        end_section("Nodes");
    }

    int type() const { return simplex_element(mesh_.dimension, mesh_.mid_nodes.empty() ? 1 : 2).number; }

    /// Calls put with the tag of each node of the cell, in Gmsh's order.
    template <class Put>
    void put_nodes(std::size_t cell, const Put& put) {
        for (const Mesh::Index node : mesh_.corners_of(cell)) put(node + std::int64_t{1});
        if (mesh_.mid_nodes.empty()) return;
        const std::span<const std::size_t> sequence =
            mesh::edge_sequence(mesh_.dimension == 3 ? MidEdgeOrder::gmsh : MidEdgeOrder::vtk, mesh_.dimension);
        for (const std::size_t edge : sequence) put(mesh_.mid_nodes[cell * sequence.size() + edge] + std::int64_t{1});
    }

    void write_elements_41() {
        const std::size_t count = mesh_.cell_count();
        std::vector<std::size_t> starts;
        for (std::size_t cell = 0; cell < count; ++cell) {
            if (cell == 0 || groups_.entity_of(cell) != groups_.entity_of(cell - 1)) starts.push_back(cell);
        }
        const auto [low, high] = std::minmax_element(groups_.tags.begin(), groups_.tags.end());
        row(starts.size(), count, count == 0 ? 0 : static_cast<std::size_t>(*low),
            count == 0 ? 0 : static_cast<std::size_t>(*high));
        for (std::size_t b = 0; b < starts.size(); ++b) {
            const std::size_t last = b + 1 < starts.size() ? starts[b + 1] : count;
            row(mesh_.dimension, groups_.entity_of(starts[b]), type(), last - starts[b]);
            for (std::size_t cell = starts[b]; cell < last; ++cell) {
                out_.number(groups_.tags[cell]);
                put_nodes(cell, [&](std::int64_t tag) { out_.number(tag); });
                out_.end_row();
            }
        }
    }

    void write_elements_22() {
        line(mesh_.cell_count());
        if (out_.binary() && mesh_.cell_count() != 0) row(type(), static_cast<int>(mesh_.cell_count()), 2);
        for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) {
            integer(groups_.tags[cell]);
            if (!out_.binary()) {
                integer(type());
                integer(2);
            }
            integer(groups_.group_of(cell));
            integer(groups_.entity_of(cell));
            put_nodes(cell, [&](std::int64_t tag) { integer(tag); });
            out_.end_row();
        }
    }

    /// `tags` of the entities; empty: 1, 2, 3, ...
    template <class Number>
    void write_data(const char* section, const std::string& name, int components, const std::vector<Number>& values,
                    std::span<const std::int64_t> tags) {
        const auto width = static_cast<std::size_t>(components);
        const std::size_t count = values.size() / width;
        out_.text(std::string("$") + section + "\n1\n\"" + name + "\"\n1\n0\n3\n0\n");
        line(width);
        line(count);
        for (std::size_t row = 0; row < count; ++row) {
            integer(tags.empty() ? static_cast<std::int64_t>(row) + 1 : tags[row]);
            for (std::size_t c = 0; c < width; ++c) out_.number(static_cast<double>(values[row * width + c]));
            out_.end_row();
        }
        end_section(section);
    }

    const Mesh& mesh_;
    const CellGroups& groups_;
    RowOutput out_;
    bool new_;  ///< 4.1
};

}  // namespace
}  // namespace io

Status write_gmsh(const Mesh& mesh, const std::string& path, const GmshWriteOptions& options) {
    const ExactEnvironment environment;
    if (const char* const fault = mesh::inconsistency(mesh, mesh::FieldValues::any); fault != nullptr)
        return file_error("mesh.inconsistent", path, std::string("cannot write the mesh: ") + fault, {}, {},
                          "correct the mesh in memory");
    return io::status_of([&] {
        const io::CellGroups groups = io::group_cells(mesh, options.version == GmshWriteOptions::Version::v41, path);
        io::check_names(mesh, groups, path);
        io::GmshWriter(mesh, groups, path, options).write().value();
    });
}

}  // namespace barycert
