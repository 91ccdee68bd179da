#include "barycert/base/finite.hpp"
#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/raster/exact_point.hpp"

// Sutherland and Hodgman's way (Reentrant Polygon Clipping, CACM 17, 1974): bound after bound, each taking off what
// lies beyond it. But polygons are kept as what they are exactly, never as rounded vertices: an edge is the line where
// a form is zero (one of the triangle's weights, or the distance to a bound that has cut), a new vertex is where two
// lines meet. Signs of forms at vertices are exact, and rounding is done once, at the end.

namespace barycert::raster {
namespace {

constexpr int bounds = 6;  ///< x, y, z <= w, then -w <= x, y, z

/// What bound b holds against w: x, y, z or -x, -y, -z.
double beside(const double* vertex, int b) {
    return b < 3 ? vertex[b] : -vertex[b - 3];
}

/// On which side of bound b a vertex lies; positive inside. Exact: doubles are compared.
int side(const double* vertex, int b) {
    const double x = beside(vertex, b), w = vertex[3];
    return x < w ? 1 : x == w ? 0 : -1;
}

class TriangleClipper {
public:
    TriangleClipper(const double* vertices, std::size_t stride) : vertices_(vertices), stride_(stride) {}

    /// False if less than a polygon is left.
    bool clip(int bound) {
        const Form form = form_of(3 + bound);
        std::vector<int> signs;
        for (const Corner& c : polygon_)
            signs.push_back(c.vertex < 3 ? side(vertex(c.vertex), bound) : sign_at(form, made(c.vertex)));
        std::vector<Corner> left;
        // Where the sign changes strictly along an edge, its form and that of the bound differ by more than a factor,
        // so that they have one zero in common.
        const auto cross = [&](int edge, int next_edge) {
            made_.push_back(zero_in_triangle(form_of(edge), form));
            left.push_back({2 + static_cast<int>(made_.size()), next_edge});
        };
        for (std::size_t i = 0; i < polygon_.size(); ++i) {
            const Corner& c = polygon_[i];
            const int from = signs[i], to = signs[(i + 1) % signs.size()];
            if (from >= 0) left.push_back({c.vertex, from == 0 && to < 0 ? 3 + bound : c.edge});
            if (from > 0 && to < 0) cross(c.edge, 3 + bound);
            if (from < 0 && to > 0) cross(c.edge, c.edge);
        }
        polygon_ = std::move(left);
        return polygon_.size() >= 3;
    }

    void append_to(std::vector<double>& rows) const {
        for (const Corner& c : polygon_) {
            for (std::size_t k = 0; k < stride_; ++k)
                rows.push_back(c.vertex < 3 ? vertex(c.vertex)[k]
                                            : value_at(made(c.vertex), vertices_ + k, stride_, 3));
        }
    }

private:
    /// A vertex, and what the edge from it to the next one lies on: 0 to 2: where the weight of that vertex is zero;
    /// 3 + b: on bound b.
    struct Corner {
        int vertex;  ///< 0 to 2: of the triangle; 3 + k: made_[k]
        int edge;
    };

    const double* vertex(int i) const { return vertices_ + stride_ * static_cast<std::size_t>(i); }
    const ExactPoint& made(int i) const { return made_[static_cast<std::size_t>(i - 3)]; }

    Form form_of(int edge) const {
        if (edge >= 3)
            return difference_form(
                3, [&](int i) { return vertex(i)[3]; }, [&](int i) { return beside(vertex(i), edge - 3); });
        Form form;
        form[static_cast<std::size_t>(edge)] = core::Integer(false, 1, 0);
        return form;
    }

    const double* vertices_;
    std::size_t stride_;
    std::vector<Corner> polygon_{{0, 2}, {1, 0}, {2, 1}};
    std::vector<ExactPoint> made_;
};

/// The bounds beyond which a vertex lies, as a mask.
unsigned beyond(const double* vertex) {
    unsigned mask = 0;
    for (int b = 0; b < bounds; ++b) mask |= static_cast<unsigned>(side(vertex, b) < 0) << b;
    return mask;
}

Status check_rows(std::span<const double> vertices) {
    if (vertices.size() < 12 || vertices.size() % 3 != 0)
        return Error{.what = "a triangle of other than three vertices",
                     .expected = "three rows of x, y, z, w and attributes, of equal length",
                     .found = std::to_string(vertices.size()) + " numbers",
                     .remedy = "give a number for each attribute of each vertex"};
    const std::size_t i = base::first_not_finite(vertices), row = vertices.size() / 3;
    if (i == vertices.size()) return Done{};
    return base::not_finite("number " + std::to_string(i % row) + " of vertex " + std::to_string(i / row), vertices[i],
                            "leave the triangle out");
}

}  // namespace
}  // namespace barycert::raster

namespace barycert {

Result<Clip> clip_triangle(std::span<const double> vertices, std::vector<double>& polygon) {
    using namespace raster;
    const ExactEnvironment environment;  // for comparisons of subnormal numbers
    if (Status good = check_rows(vertices); !good) return good.error();
    const std::size_t row = vertices.size() / 3;
    unsigned any = 0, all = (1U << bounds) - 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const unsigned mask = beyond(vertices.data() + row * i);
        any |= mask;
        all &= mask;
    }
    polygon.clear();
    if (all != 0) return Clip::outside;
    if (any == 0) {
        polygon.assign(vertices.begin(), vertices.end());
    } else {
        TriangleClipper clipper(vertices.data(), row);
        for (int b = 0; b < bounds; ++b) {
            // A bound beyond which no vertex lies has nothing of the triangle beyond it.
            if ((any >> b & 1U) != 0 && !clipper.clip(b)) return Clip::outside;
        }
        clipper.append_to(polygon);
    }
    for (std::size_t i = 3; i < polygon.size(); i += row) {
        if (polygon[i] != 0) continue;
        polygon.clear();
        return Clip::at_eye;
    }
    return any == 0 ? Clip::inside : Clip::cut;
}

}  // namespace barycert
