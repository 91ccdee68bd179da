// See check_delaunay in delaunay_check.hpp.
