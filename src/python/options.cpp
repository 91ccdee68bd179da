#include "options.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "errors.hpp"

namespace barycert::python {

OutsidePolicy outside_policy(const std::string& outside, double fill, double limit) {
    constexpr std::array<std::pair<std::string_view, Outside>, 5> words{{{"nan", Outside::nan},
                                                                         {"raise", Outside::error},
                                                                         {"fill", Outside::fill},
                                                                         {"nearest", Outside::nearest},
                                                                         {"extrapolate", Outside::extrapolate}}};
    for (const auto& [word, kind] : words) {
        if (word == outside) return {kind, fill, limit};
    }
    throw Exception({.what = "what points outside get (outside=)",
                     .expected = "nan, raise, fill, nearest or extrapolate",
                     .found = outside});
}

NonfinitePoints nonfinite_points(const std::string& nonfinite) {
    if (nonfinite != "error" && nonfinite != "nan")
        throw Exception({.what = "what points that are not finite get (nonfinite_points=)",
                         .expected = "error or nan",
                         .found = nonfinite});
    return nonfinite == "nan" ? NonfinitePoints::nan : NonfinitePoints::error;
}

SampleOptions sample_options(const std::string& outside, double fill, double limit, const std::string& rounding,
                             int threads, const std::string& nonfinite) {
    if (rounding != "correct" && rounding != "plain")
        throw Exception({.what = "rounding of values (rounding=)", .expected = "correct or plain", .found = rounding});
    return {.rounding = rounding == "plain" ? Rounding::plain : Rounding::correct,
            .outside = outside_policy(outside, fill, limit),
            .threads = threads,
            .nonfinite_points = nonfinite_points(nonfinite)};
}

}  // namespace barycert::python
