/// VTK's files as they are opened, and the files that they name: partitioned data sets, blocks and series.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/series.hpp"
#include "files/input_file.hpp"
#include "io/vtk/xml.hpp"

namespace barycert::io {

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

/// By the first word. Throws an Exception: a file that is not of VTK, or names none where it should.
VtkFile open_vtk(const std::string& path);

/// Consecutive files of one time are one step.
std::vector<SeriesStep> steps_of(std::span<const CollectionFile> files);

}  // namespace barycert::io
