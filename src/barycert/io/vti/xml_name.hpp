/// Names as values of XML attributes, which VTK 9.1 writes as they are given.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace barycert::io {

/// `name` such that between double quotes in an XML 1.0 file it reads back as `name`; nothing if no escape can do that:
/// where it is not UTF-8, or has a character that XML excludes.
std::optional<std::string> xml_attribute(std::string_view name);

}  // namespace barycert::io
