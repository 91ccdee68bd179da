#include "barycert/figure.hpp"
#include "files/suffix.hpp"

namespace barycert {

bool is_figure_name(std::string_view path) {
    return base::has_one_of(path, {".png", ".svg", ".pdf"});
}

}  // namespace barycert
