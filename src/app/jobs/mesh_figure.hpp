/// A mesh as a figure: what SceneChoice names of it.
#pragma once

#include <deque>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/defect.hpp"
#include "barycert/figure.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/job.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/render_job.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify_job.hpp"
#include "barycert/vtk_files.hpp"
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
