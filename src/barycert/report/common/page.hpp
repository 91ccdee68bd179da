/// The frame of HTML pages: head with style, and foot. Pages ask for nothing from anywhere, and their head forbids it.
#pragma once

#include <string>
#include <string_view>

#include "barycert/check.hpp"

namespace barycert::report {

/// From the document type to the opening of the page's main part. `title` is escaped here; `style` is appended to the
/// common one.
std::string page_head(std::string_view title, std::string_view style = {});

/// The foot and the end of the page: `made_by` is escaped here. With `script`, tables of class "sortable" are sorted by
/// a click on their heads, and a button beside each code of class "copy" copies it; without JavaScript both are there
/// to be read all the same.
std::string page_foot(std::string_view made_by, bool script = false);

/// What stands before all else on a mesh whose sides are not straight; empty if they are.
std::string curved_section(const CurvedCells& curved, const std::string& mesh = {});

/// Bytes as "data:TYPE;base64,...".
std::string data_uri(std::string_view type, std::string_view bytes);

}  // namespace barycert::report
