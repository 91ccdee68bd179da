#include <string_view>

#include "barycert/figure.hpp"
#include "files/format.hpp"

namespace barycert {

bool is_figure_name(std::string_view path) {
    return base::is_written_as(path, base::Use::picture);
}

}  // namespace barycert
