/// .msh files of tests: made here, number by number, in every version, as text and in both byte orders.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "tests/io/tetgen/mesh_files.hpp"

namespace barycert::testing {

enum class Form { text, little, big };

/// Contents of a file to write.
struct Msh {
    struct Node {
        std::int64_t tag;
        std::array<double, 3> at;
    };
    struct Element {
        std::int64_t tag;
        std::vector<std::int64_t> nodes;
    };
    struct Block {
        int dimension, entity, type;
        int physical = 0;
        std::vector<Element> elements;
    };
    struct View {
        std::string section, name;
        std::int64_t step = 0;
        double time = 0;
        int components = 1;
        std::vector<std::pair<std::int64_t, std::vector<double>>> rows;
    };
    std::vector<Node> nodes;
    std::vector<Block> blocks;
    std::vector<std::string> names;  ///< lines of $PhysicalNames
    std::vector<View> views;
};

/// Writes it. `version`: 22, 40 or 41.
class MshBytes {
public:
    MshBytes(const Msh& msh, int version, Form form) : version_(version), form_(form) {
        text("$MeshFormat\n" +
             std::string(version == 22   ? "2.2"
                         : version == 40 ? "4"
                                         : "4.1") +
             (form == Form::text ? " 0 8\n" : " 1 8\n"));
        if (form != Form::text) integer(1);
        end("MeshFormat");
        if (!msh.names.empty()) {
            text("$PhysicalNames\n" + std::to_string(msh.names.size()) + "\n");
            for (const std::string& line : msh.names) text(line + "\n");
            text("$EndPhysicalNames\n");
        }
        if (version != 22) entities(msh);
        text("$Nodes\n");
        nodes(msh);
        end("Nodes");
        text("$Elements\n");
        elements(msh);
        end("Elements");
        for (const Msh::View& view : msh.views) data(view);
    }
    const std::string& bytes() const { return bytes_; }

private:
    void text(const std::string& more) { bytes_ += more; }
    void end(const std::string& name) { text((form_ == Form::text ? "$End" : "\n$End") + name + "\n"); }
    void raw(std::uint64_t word, int size) {
        for (int i = 0; i < size; ++i) {
            const int byte = form_ == Form::big ? size - 1 - i : i;
            bytes_ += static_cast<char>(word >> (8 * byte));
        }
    }
    void word(const std::string& word) { bytes_ += bytes_.back() == '\n' ? word : ' ' + word; }
    void integer(std::int64_t x) {
        form_ == Form::text ? word(std::to_string(x)) : raw(static_cast<std::uint64_t>(x), 4);
    }
    void size(std::int64_t x) { form_ == Form::text ? word(std::to_string(x)) : raw(static_cast<std::uint64_t>(x), 8); }
    void tag(std::int64_t x) { version_ == 41 ? size(x) : integer(x); }
    void real(double x) { form_ == Form::text ? word(base::shortest(x)) : raw(std::bit_cast<std::uint64_t>(x), 8); }
    void row() {
        if (form_ == Form::text) bytes_ += '\n';
    }

    void entities(const Msh& msh) {
        text("$Entities\n");
        for (int d = 0; d < 4; ++d) {
            std::int64_t count = 0;
            for (const Msh::Block& b : msh.blocks) count += b.dimension == d;
            size(count);
        }
        row();
        for (int d = 0; d < 4; ++d) {
            for (const Msh::Block& b : msh.blocks) {
                if (b.dimension != d) continue;
                integer(b.entity);
                for (int i = 0; i < (d == 0 && version_ == 41 ? 3 : 6); ++i) real(0.5);
                size(b.physical != 0);
                if (b.physical != 0) integer(b.physical);
                if (d > 0) {
                    size(2);
                    integer(-1);
                    integer(2);
                }
                row();
            }
        }
        end("Entities");
    }

    void nodes(const Msh& msh) {
        const auto count = static_cast<std::int64_t>(msh.nodes.size());
        if (version_ == 22) {
            text(std::to_string(count) + "\n");
            node_rows(msh.nodes, 0, msh.nodes.size());
            return;
        }
        // Two blocks: one with parameters, on a surface.
        const std::size_t cut = msh.nodes.size() / 2;
        size(2);
        size(count);
        if (version_ == 41) {
            size(1);
            size(1 << 30);
        }
        row();
        node_block(msh.nodes, 0, cut, 2, true);
        node_block(msh.nodes, cut, msh.nodes.size(), 3, false);
    }
    void node_block(const std::vector<Msh::Node>& all, std::size_t first, std::size_t last, int d, bool parametric) {
        integer(version_ == 40 ? 7 : d);
        integer(version_ == 40 ? d : 7);
        integer(parametric);
        size(static_cast<std::int64_t>(last - first));
        row();
        parameters_ = parametric ? d : 0;
        if (version_ == 40) {
            node_rows(all, first, last);
            return;
        }
        for (std::size_t i = first; i < last; ++i) {
            size(all[i].tag);
            row();
        }
        for (std::size_t i = first; i < last; ++i) point(all[i]);
    }
    void node_rows(const std::vector<Msh::Node>& all, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            integer(all[i].tag);
            point(all[i]);
        }
    }
    void point(const Msh::Node& node) {
        for (const double x : node.at) real(x);
        for (int i = 0; i < parameters_; ++i) real(0.25);
        row();
    }

    void elements(const Msh& msh) {
        std::int64_t count = 0;
        for (const Msh::Block& b : msh.blocks) count += static_cast<std::int64_t>(b.elements.size());
        if (version_ == 22) {
            text(std::to_string(count) + "\n");
        } else {
            size(static_cast<std::int64_t>(msh.blocks.size()));
            size(count);
            if (version_ == 41) {
                size(1);
                size(1 << 30);
            }
            row();
        }
        for (const Msh::Block& b : msh.blocks) {
            const auto own = static_cast<std::int64_t>(b.elements.size());
            if (version_ != 22) {
                integer(version_ == 40 ? b.entity : b.dimension);
                integer(version_ == 40 ? b.dimension : b.entity);
                integer(b.type);
                size(own);
                row();
            } else if (form_ != Form::text) {
                integer(b.type);
                integer(own);
                integer(2);
            }
            for (const Msh::Element& e : b.elements) {
                tag(e.tag);
                if (version_ == 22) {
                    if (form_ == Form::text) {
                        integer(b.type);
                        integer(2);
                    }
                    integer(b.physical);
                    integer(b.entity);
                }
                for (const std::int64_t node : e.nodes) tag(node);
                row();
            }
        }
    }

    void data(const Msh::View& view) {
        text("$" + view.section + "\n1\n\"" + view.name + "\"\n1\n" + base::shortest(view.time) + "\n3\n" +
             std::to_string(view.step) + "\n" + std::to_string(view.components) + "\n" +
             std::to_string(view.rows.size()) + "\n");
        for (const auto& [tag, values] : view.rows) {
            integer(tag);
            for (const double x : values) real(x);
            row();
        }
        end(view.section);
    }

    int version_;
    Form form_;
    int parameters_ = 0;
    std::string bytes_;
};

/// All versions and forms that there are.
struct MshKind {
    int version;
    Form form;
};
inline constexpr std::array<MshKind, 7> msh_kinds{{{22, Form::text},
                                                   {22, Form::little},
                                                   {22, Form::big},
                                                   {40, Form::text},
                                                   {41, Form::text},
                                                   {41, Form::little},
                                                   {41, Form::big}}};

inline std::string name_of(const MshKind& kind) {
    return std::to_string(kind.version) + (kind.form == Form::text     ? " text"
                                           : kind.form == Form::little ? " little-endian"
                                                                       : " big-endian");
}

/// Two tetrahedra with a common face, in groups of their own, a triangle and a point beside them, a node of no cell;
/// tags in no order.
inline Msh two_tetrahedra() {
    Msh msh;
    msh.nodes = {{50, {1, 1, 1}},   {7, {0, 0, 0}},       {9, {0.1, 0, 0}},
                 {8, {0, 1e-3, 0}}, {1000, {0, 0, 1.25}}, {3, {9, 9, 9}}};
    msh.blocks = {{0, 4, 15, 0, {{101, {7}}}},
                  {2, 6, 2, 3, {{30, {9, 8, 1000}}}},
                  {3, 5, 4, 7, {{20, {7, 9, 8, 1000}}}},
                  {3, 2, 4, 0, {{10, {9, 8, 1000, 50}}}}};
    msh.names = {"3 7 \"inner \"part\"\"", "2 3 \"face\""};
    return msh;
}

inline Result<Mesh> read_bytes(const std::string& bytes, const GmshReadOptions& options = {}) {
    const TemporaryFolder folder;
    put(folder / "m.msh", bytes);
    return read_gmsh(folder / "m.msh", options);
}

inline Result<Mesh> read_msh(const Msh& msh, const MshKind& kind, const GmshReadOptions& options = {}) {
    return read_bytes(MshBytes(msh, kind.version, kind.form).bytes(), options);
}

/// Two meshes alike, labels, numbers and notes included.
inline void expect_same_with_labels(const Mesh& a, const Mesh& b, bool notes = true) {
    expect_same(a, b);
    EXPECT_EQ(a.cell_numbers, b.cell_numbers);
    ASSERT_EQ(a.cell_labels.size(), b.cell_labels.size());
    for (std::size_t i = 0; i < a.cell_labels.size(); ++i) {
        EXPECT_EQ(a.cell_labels[i].name, b.cell_labels[i].name);
        EXPECT_EQ(a.cell_labels[i].values, b.cell_labels[i].values);
    }
    if (!notes) return;
    ASSERT_EQ(a.notes.size(), b.notes.size());
    for (std::size_t i = 0; i < a.notes.size(); ++i) EXPECT_EQ(a.notes[i].text, b.notes[i].text);
}

/// The note that holds `part`, or nullptr.
inline const Note* find_note(const Mesh& mesh, const std::string& part) {
    for (const Note& note : mesh.notes) {
        if (note.text.find(part) != std::string::npos) return &note;
    }
    return nullptr;
}

}  // namespace barycert::testing
