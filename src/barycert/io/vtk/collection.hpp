/// Files that name files: partitioned data sets, blocks and series.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml.hpp"

namespace barycert::io {

/// A file of a collection.
struct CollectionFile {
    std::string path;      ///< as it can be opened: relative ones are taken from the folder of the collection
    std::string block;     ///< its name, where it has one
    double time = 0;       ///< of a series
    std::size_t line = 0;  ///< where it is named; 0: not known
};

struct Collection {
    bool is_series = false;             ///< of steps in time
    std::vector<CollectionFile> files;  ///< in their order
};

/// What the root of a .pvtu, .pvtp, .vtm, .vtpd, .vtpc or .pvd names; nothing if it is another. Error: an entry without
/// a file, or a time that is none.
Result<std::optional<Collection>> collection_of(const XmlTree& tree);

/// What ParaView's series file (NAME.vtu.series) names: {"files": [{"name": "a.vtu", "time": 0.5}, ...]}. Error: no
/// JSON, a member that is missing or of another kind, a time that is not finite, a file of more than 64 MiB.
Result<Collection> read_series_file(std::string_view bytes, const std::string& path);

/// The steps of a series: consecutive files of one time are one step.
std::vector<SeriesStep> steps_of(std::span<const CollectionFile> files);

/// The number of the step that is chosen. Error: there is none such.
Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path);

/// That a step is chosen of what is no series.
Error no_series(const std::string& path);

/// Nodes that pieces share are merged where the file gives their global numbers; else a note tells how many there are.
void join_pieces(RawGrid& grid, const std::string& path);

}  // namespace barycert::io
