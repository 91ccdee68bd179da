/// Reads the variant in which CGAL returns an intersection: Boost's in CGAL 5, the standard library's in CGAL 6.
#pragma once

#include <boost/variant/get.hpp>

#include <variant>

namespace barycert::exact {

/// The object, if it is of that type; else nullptr.
template <class Object, class Variant>
const Object* met_as(const Variant& met) {
    if constexpr (requires { std::get_if<Object>(&met); }) {
        return std::get_if<Object>(&met);
    } else {
        return boost::get<Object>(&met);
    }
}

}  // namespace barycert::exact
