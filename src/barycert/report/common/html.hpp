/// Text and bytes in HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace barycert::report {

/// As an XML reader takes it back; control characters, which no XML may hold, become spaces.
std::string xml_escaped(std::string_view text);

/// As xml_escaped, and bytes that are no UTF-8 (a file's name may be anything) become U+FFFD.
std::string html_escaped(std::string_view text);

/// A name of words and dots: escaped, and where lines are short broken behind dots, not within words.
std::string html_name(std::string_view name);

/// Bytes as "data:TYPE;base64,...".
std::string data_uri(std::string_view type, std::string_view bytes);

}  // namespace barycert::report
