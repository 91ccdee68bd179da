/// Files that name files: partitioned data sets, blocks and series.
#pragma once

#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml_tree.hpp"

namespace barycert::io {

/// A file of a collection.
struct CollectionFile {
    std::string path;      ///< as it can be opened: relative ones are taken from the folder of the collection
    std::string block;     ///< its name, where it has one
    double time = 0;       ///< of a series
    std::size_t line = 0;  ///< where it is named; 0: not known
};

/// Whether the root is one of .pvtu, .pvtp, .vtm, .vtpd, .vtpc or .pvd.
bool is_collection(const XmlTree& tree);
/// Whether it is a series of steps in time (.pvd).
bool is_series(const XmlTree& tree);

/// The files that it names, in its order. Error: an entry without a file, or a time that is none.
Result<std::vector<CollectionFile>> collection_files(const XmlTree& tree, std::string_view bytes,
                                                     const std::string& path);

/// The steps of a series: consecutive files of one time are one step.
std::vector<SeriesStep> steps_of(const std::vector<CollectionFile>& files);

/// The number of the step that is chosen. Error: there is none such.
Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path);

/// That a step is chosen of what is no series.
Error no_series(const std::string& path);

/// Nodes that pieces share are merged where the file gives their global numbers; else a note tells how many there are.
void join_pieces(RawGrid& grid, const std::string& path);

}  // namespace barycert::io
