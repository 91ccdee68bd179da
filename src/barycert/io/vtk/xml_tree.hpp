/// The elements of a VTK XML file, through expat.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::io {

struct XmlElement {
    std::string name;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<std::size_t> children;  ///< in order, as places in XmlTree::elements
    std::size_t begin = 0;              ///< where its opening tag begins in the file
    std::size_t end = 0;                ///< where its closing tag begins; `begin` if it has none

    /// The value of the attribute; nothing if there is none.
    std::optional<std::string_view> attribute(std::string_view key) const;
};

struct XmlTree {
    std::vector<XmlElement> elements;  ///< the root first
    /// The appended data, from behind the underscore to the end of the file; empty if there are none.
    std::string_view appended;
    bool appended_raw = false;  ///< as they are; else in base64

    const XmlElement& root() const { return elements.front(); }
    /// The first child of that name; nullptr if there is none.
    const XmlElement* child(const XmlElement& of, std::string_view name) const;
};

/// `bytes` is all of the file. What follows the tag of appended data is not looked at, nor are the numbers in elements.
/// Error: no well-formed XML, a document type (whose entities might expand without bound), another encoding of appended
/// data.
Result<XmlTree> parse_xml(std::string_view bytes, const std::string& path);

/// The text of an element: what stands before its first child or, if that is blank, behind its last one.
std::string_view text_of(std::string_view bytes, const XmlTree& tree, const XmlElement& element);

/// Which line of the file that byte is in, from 1.
std::size_t line_of(std::string_view bytes, std::size_t at);

}  // namespace barycert::io
