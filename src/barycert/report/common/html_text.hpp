/// Text in HTML pages.
#pragma once

#include <string>
#include <string_view>

namespace barycert::report {

/// As xml_escaped, and bytes that are no UTF-8 (a file's name may be anything) become U+FFFD.
std::string html_escaped(std::string_view text);

/// A name of words and dots: escaped, and where lines are short broken behind dots, not within words.
std::string html_name(std::string_view name);

}  // namespace barycert::report
