/// What objects of CGAL meet in: CGAL 5 answers with Boost's variant, CGAL 6 with that of the standard library.
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
