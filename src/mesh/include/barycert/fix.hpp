/// Repairs of a mesh that have one right answer.
///
/// Example:
///
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 2, 1}};
///     FixReport done;
///     const Mesh fixed = fix_mesh(mesh, {}, done).value();  // done.turned is 1
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert {

struct FixOptions {
    bool nodes = true;        ///< merge coincident nodes of cells; also mid-edge nodes that coincide or share an edge
    double merge_within = 0;  ///< merge also nodes at most so far apart, or linked by a chain of such nodes
    bool cells = true;        ///< drop cells that are degenerate or name a node twice, and all but one of duplicates
    bool orientation = true;  ///< turn negative cells
    int threads = 0;          ///< 0: one per core
};

struct MergedNode {
    Mesh::Index node = -1, into = -1;  ///< as the mesh given numbers them
    double moved = 0;                  ///< how far, rounded
};
struct DroppedCell {
    Mesh::Index cell = -1;
    DefectKind why{};  ///< repeated_node, degenerate_cell, duplicate_cell or uncut_cell
};
struct MergedField {
    std::string name;
    std::uint64_t differ = 0;   ///< nodes or cells that went, of another value than what is kept, NaN being one value
    double max_difference = 0;  ///< of finite values
};

struct FixReport {
    std::vector<MergedNode> merged;            ///< by node; those kept are the lowest
    std::vector<DroppedCell> dropped;          ///< by cell
    std::uint64_t collapsed = 0;               ///< of these, cells that merging made so
    std::uint64_t turned = 0;                  ///< cells
    std::uint64_t dropped_faces = 0;           ///< of Mesh::faces: those that no cell has any more, and twins
    std::uint64_t differing_markers = 0;       ///< merged nodes of another marker than the node that is kept
    std::vector<MergedField> fields;           ///< where values differ: those of the node that is kept stay
    std::vector<MergedField> cell_fields;      ///< likewise of duplicate cells: fields, then labels
    std::uint64_t differing_face_markers = 0;  ///< twins of another marker than the face that is kept
    /// Entries of Mesh::neighbours that changed, where no cell was dropped; otherwise all are new.
    std::uint64_t changed_neighbours = 0;

    bool changed() const {
        return !merged.empty() || !dropped.empty() || turned != 0 || dropped_faces != 0 || changed_neighbours != 0;
    }
};

/// Returns a repaired copy of the mesh; `report` says what was done. Merged nodes are taken out and the others numbered
/// anew, and so are cells; all else stays with its node, cell or face. The last two vertices of turned cells are
/// swapped. Neighbours, if any, are computed anew if nodes or cells went. The copy need not be a partition: facets at a
/// dropped degenerate cell may be left unmatched; check_mesh tells. Error: arrays of wrong sizes; indices out of range;
/// a distance that is negative or not finite.
Result<Mesh> fix_mesh(const Mesh& mesh, const FixOptions& options, FixReport& report);

}  // namespace barycert
