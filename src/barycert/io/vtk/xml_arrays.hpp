/// The numbers of DataArray elements.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/vtk/codec.hpp"
#include "barycert/io/vtk/encoded.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml_tree.hpp"

namespace barycert::io {

/// What the attributes of the root say of all arrays.
struct XmlLayout {
    bool swap_bytes = false;
    std::size_t header_bytes = 4;  ///< of the integers before the data: 4 or 8
    Compressor compressor = Compressor::none;
};

/// Error: a byte order, type of header or compressor that VTK does not know.
Result<XmlLayout> layout_of(const XmlTree& tree, std::string_view bytes, const std::string& path);

class XmlArrays {
public:
    /// All of them are kept as references.
    XmlArrays(std::string_view bytes, const XmlTree& tree, const XmlLayout& layout, const std::string& path)
        : bytes_(bytes), tree_(tree), layout_(layout), path_(path) {}

    /// The type of the numbers; nothing if they are none (strings).
    static std::optional<NumberType> type_of(const XmlElement& array);

    /// Appends the numbers of the array, exactly `count`, to `values` (see numbers.hpp for its types). `what` names it
    /// in errors. Where `fault` is given, numbers that are not exact are told there instead of as an error.
    template <class To>
    Status read(const XmlElement& array, const std::string& what, std::uint64_t count, std::vector<To>& values,
                NumberFault* fault = nullptr) const;

    /// The texts of an array of strings, exactly `count`.
    Status read_texts(const XmlElement& array, const std::string& what, std::uint64_t count,
                      std::vector<std::string>& texts) const;

    Error error(const XmlElement& element, std::string what, std::string expected, std::string found,
                std::string remedy = {}) const;

private:
    Result<Encoded> encoded(const XmlElement& array, const std::string& what) const;
    template <class To>
    Status read_encoded(const XmlElement& array, const std::string& what, NumberType type,
                        std::optional<std::uint64_t> count, std::vector<To>& values, NumberFault& fault) const;

    std::string_view bytes_;
    const XmlTree& tree_;
    const XmlLayout& layout_;
    const std::string& path_;
};

}  // namespace barycert::io
