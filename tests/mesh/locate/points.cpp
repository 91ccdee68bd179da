#include "tests/mesh/locate/points.hpp"
#include "tests/limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/text.hpp"

namespace barycert::testing {
namespace {

class Maker {
public:
    Maker(const Mesh& mesh, base::Random& random)
        : mesh_(mesh), random_(random), d_(static_cast<std::size_t>(mesh.dimension)) {
        low_.fill(infinity);
        high_.fill(-infinity);
        for (const Mesh::Index node : mesh.cells) {
            for (std::size_t k = 0; k < d_; ++k) {
                low_[k] = std::min(low_[k], at(node, k));
                high_[k] = std::max(high_[k], at(node, k));
            }
        }
    }

    std::vector<double> points;

    /// On the open face of `support` random corners of a random cell; dyadic weights as often as not.
    void on_cell(std::size_t support) {
        const std::size_t cell = random_.below(mesh_.cell_count());
        std::array<double, 4> weight{};
        double sum = 0;
        const bool dyadic = random_.coin();
        std::size_t left = 4;
        for (std::size_t n = 0; n < support; ++n) {
            std::size_t i = random_.below(d_ + 1);
            while (weight[i] != 0) i = (i + 1) % (d_ + 1);
            // Quarters that add up to 1, or anything.
            const std::size_t quarters = n + 1 == support ? left : 1;
            left -= quarters;
            weight[i] = dyadic ? 0.25 * static_cast<double>(quarters) : random_.uniform(0.001, 1);
            sum += weight[i];
        }
        for (std::size_t k = 0; k < d_; ++k) {
            double x = 0;
            for (std::size_t i = 0; i <= d_; ++i)
                if (weight[i] != 0) x += weight[i] / sum * at(mesh_.cells[cell * (d_ + 1) + i], k);
            points.push_back(std::clamp(x, -max_double, max_double));
        }
    }
    void any_node() {
        const auto node = static_cast<Mesh::Index>(random_.below(mesh_.point_count()));
        for (std::size_t k = 0; k < d_; ++k) points.push_back(at(node, k));
    }
    void mixed_nodes() {
        for (std::size_t k = 0; k < d_; ++k) points.push_back(at(mesh_.cells[random_.below(mesh_.cells.size())], k));
    }
    /// A corner of the box, a point of its side, in it or around it.
    void box(double corner, double beyond) {
        for (std::size_t k = 0; k < d_; ++k) {
            const double side = high_[k] * 0.5 - low_[k] * 0.5;
            if (random_.unit() < corner) {
                points.push_back(random_.coin() ? low_[k] : high_[k]);
            } else {
                const double x = low_[k] + 2 * side * random_.uniform(-beyond, 1 + beyond);
                points.push_back(std::clamp(x, -max_double, max_double));
            }
        }
    }
    void far() {
        static constexpr std::array<double, 9> some{max_double, -max_double, 1e300,  -1e200, 1e30,
                                                    -1e9,       0,           5e-324, -0.0};
        for (std::size_t k = 0; k < d_; ++k)
            points.push_back(random_.below(4) == 0 ? at(mesh_.cells[0], k) : some[random_.below(some.size())]);
    }
    void nudged_copies() {
        const std::size_t count = points.size();
        for (std::size_t i = 0; i < count; i += d_) {
            for (std::size_t k = 0; k < d_; ++k) points.push_back(points[i + k]);
            nudge(&points[points.size() - d_], d_, random_);
        }
    }

private:
    double at(Mesh::Index node, std::size_t k) const { return mesh_.points[d_ * static_cast<std::size_t>(node) + k]; }

    const Mesh& mesh_;
    base::Random& random_;
    std::size_t d_;
    std::array<double, 3> low_{}, high_{};
};

}  // namespace

void nudge(double* point, std::size_t d, base::Random& random) {
    for (std::size_t k = 0; k < d; ++k) {
        const int way = random.integer(-1, 1);
        const double x = way == 0 ? point[k] : std::nextafter(point[k], way < 0 ? -infinity : infinity);
        if (std::isfinite(x)) point[k] = x;
    }
}

std::vector<double> awkward_points(const Mesh& mesh, std::size_t of_each, base::Random& random) {
    if (mesh.cells.empty()) return std::vector<double>(static_cast<std::size_t>(2 * mesh.dimension), 0.0);
    Maker maker(mesh, random);
    const auto corners = static_cast<std::size_t>(mesh.dimension) + 1;
    for (std::size_t i = 0; i < of_each; ++i) {
        maker.any_node();
        for (std::size_t support = 1; support <= corners; ++support) maker.on_cell(support);
        maker.mixed_nodes();
        maker.box(0.5, 0);
    }
    maker.nudged_copies();
    for (std::size_t i = 0; i < of_each; ++i) {
        maker.box(0.1, 0.2);
        maker.far();
    }
    return maker.points;
}

std::vector<double> inner_points(const Mesh& mesh, std::size_t count, base::Random& random) {
    Maker maker(mesh, random);
    for (std::size_t i = 0; i < count; ++i) maker.on_cell(static_cast<std::size_t>(mesh.dimension) + 1);
    return maker.points;
}

std::string text_of(const double* point, int d) {
    std::string text = "(";
    for (int k = 0; k < d; ++k) text += (k == 0 ? "" : ", ") + base::hexadecimal(point[k]);
    return text + ")";
}

}  // namespace barycert::testing
