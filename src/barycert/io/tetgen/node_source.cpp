// The points of a .node file. The grammar and the words of its errors are those of the mesh's.
#include <tbb/task_arena.h>

#include <array>
#include <string>
#include <utility>

#include "barycert/io/formats.hpp"
#include "barycert/io/point_columns.hpp"
#include "barycert/io/tetgen/text_table.hpp"

namespace barycert::io {

Source open_node_source(const std::string& path, int dimension, const PointOptions& options) {
    constexpr std::array names{"nodes", "dimensions", "attributes", "markers"};
    const int threads = tbb::this_task_arena::max_concurrency();
    TextTable table = open_table(path, names, threads);
    const std::int64_t found = table.header_field(1, 3);
    // Points in space may lie in the plane of a mesh.
    if ((found < dimension && options.columns.empty()) || found < 2 || found > 3) {
        const std::string d = std::to_string(dimension);
        refuse_header(table, "bad dimension in the header", d + ", for the mesh is " + d + "-dimensional",
                      std::to_string(found), "give points of the dimension of the mesh");
    }
    table.any_real = options.nonfinite_points == NonfinitePoints::nan;
    table.surplus_remedy = "mend the header: nodes, dimension, attributes, markers";
    table.finite_remedy = std::string("remove the point, give it coordinates") + or_nan_for_it;
    PointTable points;
    points.dimension = static_cast<int>(found);
    points.of_nodes = true;
    std::vector<std::int64_t> markers;
    settle_node_columns(table, found, points.points, points.fields, markers);
    parse_tables(std::array{&table}, threads);
    if (table.columns[3].count != 0) points.labels.push_back({"marker", std::move(markers)});
    return points_of_table(std::move(points), table.file, dimension, options);
}

}  // namespace barycert::io
