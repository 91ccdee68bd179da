/// A mesh as a figure: what SceneChoice names of it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "barycert/figure.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/render_job.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "draw/viewer/page.hpp"

namespace barycert::jobs {

/// Holds what its figure refers to.
class MeshFigure {
public:
    /// The mesh must stay. `colours`: a field of one number a node or cell, or an empty name.
    MeshFigure(const Mesh& mesh, const SceneChoice& show, std::string colours, int threads, Notes& notes);

    /// All that is chosen of the mesh. Throws what cannot be drawn.
    void add_mesh();
    /// A surface cut out of the mesh, in the colours of its first field; with lines as it is chosen.
    void add(Surface surface);
    /// The same of a section, seen in its plane: the directions to the right and up in the picture.
    void add_section(Surface surface, const std::array<double, 3>& right, const std::array<double, 3>& up);
    void add_outline();

    Figure figure(const FigureOptions& options) const {
        Figure all = figure_;
        all.options = options;
        return all;
    }
    /// As write_figure takes it, or a page that turns, .html; refused what pages have not.
    FigureCounts write(const std::string& path, FigureOptions options) const;

private:
    viewer::PageScene page(const FigureOptions& options) const;
    void choose_cells();
    CutOptions carried();
    void add_cut(Surface surface, const char* what);
    void add_arrows();
    void add_points();
    void add_marked();
    void add_lines(const std::vector<double>& points, std::vector<std::int32_t> segments, double width, Rgba colour);
    void add_edges(const Surface& surface);
    bool is_cell_edge(Mesh::Index cell, Mesh::Index a, Mesh::Index b) const;

    const Mesh* mesh_;  ///< of the cells that are chosen
    const SceneChoice& show_;
    std::string colours_;
    int threads_;
    Notes& notes_;
    Mesh chosen_;
    std::deque<Surface> surfaces_;
    std::vector<viewer::PageSurface> drawn_;  ///< as those of the figure
    std::deque<std::vector<double>> numbers_;
    std::deque<std::vector<std::int32_t>> indices_;
    std::deque<Field> made_;
    FieldChoice shown_;               ///< the field that colours
    std::vector<Mesh::Index> nodes_;  ///< of the cells that are chosen, if not all are
    Figure figure_;
};

}  // namespace barycert::jobs
