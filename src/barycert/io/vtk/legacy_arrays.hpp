/// The arrays of VTK's legacy files.
#pragma once

#include <string>
#include <vector>

#include "barycert/io/vtk/legacy_text.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml_reader.hpp"

namespace barycert::io {

/// Reads them at the place of the text into the grid; both must outlive it.
class LegacyArrays {
public:
    LegacyArrays(LegacyText& text, Part part, RawGrid& grid) : text_(text), part_(part), grid_(grid) {}

    /// All arrays behind POINT_DATA or CELL_DATA, up to the next of the two. `expected`: so many points or cells.
    Status read_attributes(const std::string& keyword, std::size_t expected);
    /// Behind FIELD: arrays that belong to neither points nor cells.
    Status read_field_data() { return read_field_arrays(nullptr, 0); }

private:
    Status read_attribute(const std::string& kind, std::size_t rows, std::vector<RawArray>& arrays);
    Status read_field_arrays(std::vector<RawArray>* arrays, std::size_t rows);
    Status read_array(const std::string& name, const std::string& type, std::size_t components, std::size_t rows,
                      std::vector<RawArray>& arrays);
    Status read_numbers(const std::string& what, NumberType type, std::uint64_t numbers,
                        const std::vector<RawArray>& arrays, RawArray& array);
    Status read_colors(const std::string& name, std::size_t components, std::size_t rows,
                       std::vector<RawArray>& arrays);
    bool may_label(const std::vector<RawArray>& arrays) const;
    Status must_be_new(const std::string& name, const std::vector<RawArray>& arrays) const;

    LegacyText& text_;
    Part part_;
    RawGrid& grid_;
};

}  // namespace barycert::io
