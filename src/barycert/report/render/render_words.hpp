/// Words for what a picture was made with, as on the command line.
#pragma once

#include <string_view>

#include "barycert/scene.hpp"

namespace barycert::report {

constexpr std::string_view word(FillMethod method) {
    return method == FillMethod::scanline ? "scanline" : method == FillMethod::bilinear ? "bilinear" : "barycentric";
}

constexpr std::string_view word(Interpolation interpolation) {
    return interpolation == Interpolation::affine        ? "affine"
           : interpolation == Interpolation::projected_z ? "projected-z"
                                                         : "perspective";
}

constexpr std::string_view word(Rounding rounding) {
    return rounding == Rounding::correct ? "correct" : "plain";
}

}  // namespace barycert::report
