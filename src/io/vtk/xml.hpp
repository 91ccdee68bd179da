/// VTK's XML files: elements (through expat), numbers in them, the data sets that they are. Errors are Exceptions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/table.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/raw_grid.hpp"

namespace barycert::io {

struct XmlElement {
    std::string name;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<std::size_t> children;  ///< in order, as places in XmlTree::elements
    std::size_t begin = 0;              ///< where its opening tag begins in the file
    std::size_t end = 0;                ///< where its closing tag begins; `begin` if it has none

    std::optional<std::string_view> attribute(std::string_view key) const;
    std::string_view attribute_or(std::string_view key, std::string_view other) const {
        return attribute(key).value_or(other);
    }
    /// The type of a DataArray's numbers; nothing if they are none (strings).
    std::optional<NumberType> number_type() const;
};

struct XmlTree : FileText {
    std::vector<XmlElement> elements;  ///< the root first
    /// The appended data, from behind the underscore to the end of the file; empty if there are none.
    std::string_view appended;
    bool appended_raw = false;  ///< as they are; else in base64
    /// Reads a part of them to that place, if they are not in memory: the part is where it would stand there.
    std::function<void(std::string_view part, char* to)> read_part = {};
    // Layout of all arrays by the attributes of the root, once take_layout() has read them.
    bool swap_bytes = false;
    std::size_t header_bytes = 4;  ///< of the integers before the data: 4 or 8
    VtkData compressor = VtkData::raw;

    const XmlElement& root() const { return elements.front(); }
    /// The first child of that name, or whose attribute `key` is that; nullptr if there is none, or no parent.
    const XmlElement* child(const XmlElement* of, std::string_view name, std::string_view key = {}) const;
    /// The text of an element: what stands before its first child or, if that is blank, behind its last one.
    std::string_view text_of(const XmlElement& element) const;

    /// Takes what the root says of all arrays. Error: a byte order, type of header or compressor unknown to VTK.
    void take_layout();
    /// Appends the `count` numbers of the array; once the layout is taken. `what`, `inexact`: as in FileText::check.
    void take_numbers(const XmlElement& array, const std::string& what, std::uint64_t count, NumbersTo values,
                      NumberFault* inexact = nullptr) const;
    /// The texts of an array of strings, exactly `count`; likewise.
    std::vector<std::string> take_texts(const XmlElement& array, const std::string& what, std::uint64_t count) const;

    [[noreturn]] void refuse_at(ErrorCode code, const XmlElement& at, std::string what, std::string expected,
                                std::string found, std::string remedy = {}) const {
        refuse(code, bytes.data() + at.begin, std::move(what), std::move(expected), std::move(found),
               std::move(remedy));
    }
};

/// Parses the tags. Looks neither at what follows the tag of appended data nor at the numbers in elements. Error: no
/// well-formed XML, a document type (whose entities might expand without bound), another encoding of appended data.
XmlTree parse_xml(std::string_view bytes, const std::string& path);

/// The data set of one file: UnstructuredGrid, PolyData, ImageData, RectilinearGrid or StructuredGrid.
RawGrid read_xml(XmlTree tree, Wanted part);

}  // namespace barycert::io
