// The nearest point of a mesh: branch and bound over the tree of boxes, in double.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "barycert/core/exact_environment.hpp"
#include "barycert/core/predicates.hpp"
#include "barycert/core/strict_math.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/locate/locator.hpp"
#include "barycert/locate/locator_data.hpp"

namespace barycert {
namespace {

using Vector = std::array<double, 3>;
using detail::Place;

double dot(const Vector& x, const Vector& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
Vector minus(const Vector& x, const Vector& y) {
    return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
Vector cross(const Vector& x, const Vector& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

constexpr double none = std::numeric_limits<double>::infinity();

/// Not by squares alone: those of distances below 1e-154 vanish.
double length(const Vector& v) {
    const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    if (largest == 0) return 0;
    const Vector scaled{v[0] / largest, v[1] / largest, v[2] / largest};
    return largest * std::sqrt(dot(scaled, scaled));
}

/// Largest |component|, by which v is divided: what is made of directions then neither overflows nor vanishes.
double normalise(Vector& v) {
    const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    for (double& x : v) x /= largest;
    return largest;
}

/// Distance of the origin to the inside of the segment or triangle, infinite if its nearest point is on its boundary.
double to_edge(const Vector& a, const Vector& b) {
    Vector e = minus(b, a);
    const double size = normalise(e), square = dot(e, e), t = -dot(a, e);
    if (!(t > 0 && t < square * size)) return none;
    return length(cross(a, e)) / std::sqrt(square);
}
double to_face(const Vector& a, const Vector& b, const Vector& c) {
    Vector e = minus(b, a), f = minus(c, a);
    const double size_e = normalise(e), size_f = normalise(f);
    const Vector n = cross(e, f);
    const double square = dot(n, n), beta = dot(cross(f, a), n) / size_e, gamma = dot(cross(a, e), n) / size_f;
    if (!(beta > 0 && gamma > 0 && beta + gamma < square)) return none;
    return std::abs(dot(a, n)) / std::sqrt(square);
}

class Search {
public:
    Search(const detail::LocatorData& data, const double* point, double limit) : data_(data), index_(data.index) {
        double largest = 0;
        for (std::size_t k = 0; k < index_.dimension(); ++k) {
            point_[k] = point[k];
            largest = std::max({largest, std::abs(point[k]), std::abs(index_.low[k]), std::abs(index_.high[k])});
        }
        // Squares of coordinates neither overflow nor vanish; numbers in between stay as they are, to the last bit.
        constexpr double least = 0x1p-200, most = 0x1p200;
        if (largest > most || (largest < least && largest > 0)) exponent_ = -std::ilogb(largest);
        slack_ = std::ldexp(largest, exponent_) * 0x1p-48;
        best_ = std::ldexp(limit, exponent_) * (1 + 0x1p-50);  // what is beyond the limit is told in the end
    }

    Nearest run() {
        struct Open {
            double bound;
            std::size_t level, group;
        };
        const detail::CellTree& tree = data_.tree();
        std::vector<Open> stack{{0, tree.levels() - 1, 0}};
        while (!stack.empty() && index_.cell_count() != 0) {
            const Open open = stack.back();
            stack.pop_back();
            if (open.bound > best_) continue;
            std::array<std::pair<double, std::size_t>, 8> boxes;
            const detail::BoxGroup& group = tree.level(open.level)[open.group];
            for (std::size_t b = 0; b < 8; ++b) boxes[b] = {bound(group, b), b};
            std::sort(boxes.begin(), boxes.end(), std::greater<>());
            for (const auto& [bound, b] : boxes) {
                if (bound > best_ || bound == none) continue;
                if (open.level != 0) stack.push_back({bound, open.level - 1, 8 * open.group + b});
            }
            if (open.level != 0) continue;
            for (auto box = boxes.rbegin(); box != boxes.rend(); ++box) {
                if (box->first <= best_ && box->first != none) try_cell(8 * open.group + box->second);
            }
        }
        found_.distance = found_.cell < 0 ? none : std::ldexp(best_, -exponent_);
        return found_;
    }

private:
    /// Of the distance to a box, from below; infinite if there is no box.
    double bound(const detail::BoxGroup& group, std::size_t b) const {
        if (group.low[0][b] > group.high[0][b]) return none;
        double sum = 0;
        for (std::size_t k = 0; k < index_.dimension(); ++k) {
            const detail::Quantizer& q = index_.bins.quantizer();
            const double below = std::ldexp(q.below(k, group.low[k][b]), exponent_);
            const double above = std::ldexp(q.above(k, group.high[k][b]), exponent_);
            const double x = std::ldexp(point_[k], exponent_);
            const double away = std::max({below - x, x - above, 0.0}) - slack_;
            if (away > 0) sum += away * away * (1 - 0x1p-40);
        }
        return std::sqrt(sum);
    }

    void try_cell(std::size_t place) {
        const std::size_t corners = index_.corners();
        // Always the same order, so that cells compute the same distance to what they share.
        std::array<std::pair<Mesh::Index, Vector>, 4> v;
        for (std::size_t i = 0; i < corners; ++i) {
            const auto node = static_cast<std::size_t>(index_.cells[place].node[i]);
            Vector at{};
            for (std::size_t k = 0; k < index_.dimension(); ++k)
                at[k] = std::ldexp(index_.nodes[node].at[k], exponent_) - std::ldexp(point_[k], exponent_);
            v[i] = {index_.original_node[node], at};
        }
        for (std::size_t i = 1; i < corners; ++i) {
            for (std::size_t j = i; j > 0 && v[j].first < v[j - 1].first; --j) std::swap(v[j], v[j - 1]);
        }
        double distance = none;
        std::array<Mesh::Index, 3> nodes{-1, -1, -1};
        const auto take = [&](double x, Mesh::Index a, Mesh::Index b, Mesh::Index c) {
            if (!(x < distance)) return;
            distance = x;
            nodes = {a, b, c};
        };
        for (std::size_t i = 0; i < corners; ++i) take(length(v[i].second), v[i].first, -1, -1);
        for (std::size_t i = 0; i < corners; ++i) {
            for (std::size_t j = i + 1; j < corners; ++j)
                take(to_edge(v[i].second, v[j].second), v[i].first, v[j].first, -1);
        }
        for (std::size_t left_out = 0; corners == 4 && left_out < 4; ++left_out) {
            const std::size_t a = left_out == 0 ? 1 : 0, b = left_out <= 1 ? 2 : 1, c = left_out <= 2 ? 3 : 2;
            take(to_face(v[a].second, v[b].second, v[c].second), v[a].first, v[b].first, v[c].first);
        }
        const Mesh::Index cell = index_.original[place];
        const bool better = distance < best_ || (distance == best_ && (found_.cell < 0 || cell < found_.cell));
        if (!better || degenerate(cell)) return;
        best_ = distance;
        found_.cell = cell;
        found_.nodes = nodes;
    }

    bool degenerate(Mesh::Index cell) const {
        const std::size_t d = index_.dimension();
        std::array<double, 12> vertices{};
        for (std::size_t i = 0; i <= d; ++i) {
            const auto node = static_cast<std::size_t>(data_.mesh->cells[(d + 1) * static_cast<std::size_t>(cell) + i]);
            for (std::size_t k = 0; k < d; ++k) vertices[d * i + k] = data_.mesh->points[d * node + k];
        }
        return weight_signs(index_.simplex, vertices.data(), point_.data())->degenerate();
    }

    const detail::LocatorData& data_;
    const detail::CellIndex& index_;
    Vector point_{};
    int exponent_ = 0;
    double slack_ = 0;    ///< more than the roundings of bounds of boxes
    double best_ = none;  ///< distance, scaled
    Nearest found_;
};

}  // namespace

Result<Nearest> Locator::nearest(const double* point, double limit) const {
    const ExactEnvironment environment;
    limit = held(limit);
    const std::size_t d = data_->index.dimension();
    if (Status status = detail::check_finite({point, d}, d); !status) return status.error();
    if (!(limit >= 0)) return Nearest{.distance = none};
    const Nearest found = Search(*data_, point, limit).run();
    return found.distance <= limit ? found : Nearest{.distance = none};
}

}  // namespace barycert
