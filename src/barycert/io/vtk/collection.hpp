/// Files that name files: partitioned data sets, blocks and series.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/base/input_file.hpp"
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
    bool is_series = false;                  ///< of steps in time
    std::vector<CollectionFile> files = {};  ///< in their order
};

struct VtkFile {
    std::shared_ptr<const base::InputFile> input;
    base::MappedFile file = {};
    std::string_view text = {};                 ///< all of it but for a byte order mark
    std::optional<XmlTree> tree = {};           ///< of XML; without one and names it is a legacy file
    std::optional<Collection> collection = {};  ///< the files that it names
};

/// By the first word. Throws an Exception: a file that is not of VTK, as the first block shows; one that names none
/// where it should.
VtkFile open_vtk(const std::string& path);

/// The steps of a series: consecutive files of one time are one step.
std::vector<SeriesStep> steps_of(std::span<const CollectionFile> files);

/// The number of the step that is chosen. Error: there is none such.
Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path);

/// That a step is chosen of what is no series.
Error no_series(const std::string& path);

}  // namespace barycert::io
