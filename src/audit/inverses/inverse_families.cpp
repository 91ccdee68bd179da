// Cells and points for inverse maps. Only + - * / and powers of two, so that each is the same on every machine.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "audit/inverses/reference.hpp"
#include "audit/recipes.hpp"
#include "barycert/environment.hpp"
#include "barycert/inverse_rules.hpp"
#include "core/base/random.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"

namespace barycert {

using namespace audit;

namespace {

using base::Random;
using Triple = std::array<double, 3>;

/// As coefficients alone tell it, without bisections: cells that are hardly injective are no cases of these families.
bool is_injective(const InverseCase& c) {
    return iso::jacobian_sign(*iso::linear_reference(c.type), places_of(c), 0) == iso::JacobianSign::positive;
}

/// Sets the point to the image of x, in plain double from left to right. `mirrored`: x in the half of the unit square
/// that a wedge has not is taken into the other.
void set_point(InverseCase& c, Triple x, bool mirrored = true) {
    if (mirrored && c.type == vtk_wedge && std::max(x[0], x[1]) <= 1 && x[0] + x[1] > 1) x = {1 - x[0], 1 - x[1], x[2]};
    std::array<double, iso::max_nodes> n{};
    iso::shape_functions(*iso::linear_reference(c.type), x, n, nullptr);
    std::ranges::fill(c.point, 0.0);
    const std::size_t d = c.point.size();
    for (std::size_t i = 0; i < c.nodes.size(); ++i) c.point[i % d] += n[i / d] * c.nodes[i];
}

Triple any_inside(const InverseCase& c, Random& random) {
    Triple x{};
    for (std::size_t k = 0; k < c.point.size(); ++k) x[k] = random.unit();
    return x;
}

void inside(InverseCase& c, Random& random) {
    set_point(c, any_inside(c, random));
}

/// Nodes that `place` makes of those of the reference cell, drawn until the map is proved to be injective.
template <class Place>
void set_nodes(InverseCase& c, const Place& place) {
    do {
        for (std::size_t i = 0; i < c.values.size(); ++i) {
            const Triple p = place(reference_node(c.type, i));
            std::copy_n(p.begin(), c.point.size(), &c.nodes[c.point.size() * i]);
        }
    } while (!is_injective(c));
}

/// Each coordinate off by up to that, then moved.
void warp(InverseCase& c, Random& random, double most, double by = 0) {
    set_nodes(c, [&](Triple p) {
        for (double& x : p) x += by + random.uniform(-most, most);
        return p;
    });
}

/// Nodes of a parallelepiped, multiples of 2^-20, exact; the point is rounded.
void affine(InverseCase& c, Random& random) {
    std::array<Triple, 4> edges{};
    set_nodes(c, [&](const Triple& p) {
        for (std::size_t i = 0; p == Triple{} && i < 12; ++i)  // others for each try, which starts at the first node
            edges[i / 3][i % 3] = std::ldexp(random.integer(-(1 << 20), 1 << 20), -20);
        Triple at = edges[3];
        for (std::size_t i = 0; i < 9; ++i) at[i % 3] += p[i / 3] * edges[i / 3][i % 3];
        return at;
    });
    inside(c, random);
}

/// The first corner nearly in the plane of its three neighbours, where the Jacobian is nearly 0; or the apex of a
/// pyramid, where it is 0.
void flat_corner(InverseCase& c, Random& random) {
    const std::size_t d = c.point.size();
    const std::array<std::size_t, 3> next{1, c.type == vtk_wedge ? 2U : 3U, c.type == vtk_wedge ? 3U : 4U};
    const bool apex = c.type == vtk_pyramid && random.coin();
    do {
        warp(c, random, 0.2);
        const double height = apex ? 1 : random.scaled(0.5, 1, -40, -4);
        for (std::size_t k = 0; k < d; ++k) {
            double middle = 0;
            for (std::size_t i = 0; i < d; ++i) middle += c.nodes[d * next[i] + k] / double(d);
            c.nodes[k] = middle + height * (c.nodes[k] - middle);
        }
    } while (!is_injective(c));
    Triple x = any_inside(c, random);
    const int scale = random.integer(-20, 0);
    for (double& own : x) own = std::ldexp(own, scale);
    if (apex) x[2] = 1 - x[2];
    set_point(c, x);
}

void thin(InverseCase& c, Random& random) {
    warp(c, random, 0.2);
    const int size = random.integer(-20, 0), thickness = random.integer(-24, -8);
    const std::size_t d = c.point.size();
    for (std::size_t i = 0; i < c.nodes.size(); ++i)
        c.nodes[i] = std::ldexp(c.nodes[i], size + (i % d == d - 1 ? thickness : 0));
    inside(c, random);
}

void on_side(InverseCase& c, Random& random, Triple x) {
    const std::size_t axis = random.below(c.point.size());
    x[axis] = random.integer(0, c.type == vtk_pyramid && axis == 2 ? 0 : 1);  // no apex
    if (c.type == vtk_wedge && x[0] == 1) x[0] = 1 - x[1];                    // the slanted side
    set_point(c, x);
}

void on_lattice(InverseCase& c, Random& random) {
    set_nodes(c, [&](Triple p) {
        for (double& x : p) x = 4 * x + random.integer(-1, 1);
        return p;
    });
    Triple x{};
    for (std::size_t k = 0; k < c.point.size(); ++k) x[k] = random.integer(0, 4) / 4.0;
    on_side(c, random, x);
}

void beside(InverseCase& c, Random& random) {
    warp(c, random, 0.3);
    on_side(c, random, any_inside(c, random));
    for (double& x : c.point) x = ulps_away(x, random);
}

void beyond(InverseCase& c, Random& random) {
    warp(c, random, 0.3);
    Triple x = any_inside(c, random);
    const double off = random.scaled(0.5, 1, -40, 0);
    const std::size_t axis = random.below(c.point.size());
    const double end = c.type == vtk_wedge && axis < 2 ? 1 - x[1 - axis] : 1;  // the slanted side
    x[axis] = random.coin() ? end + off : -off;
    set_point(c, x, axis == 2);
}

void far(InverseCase& c, Random& random) {
    warp(c, random, 0.3);
    for (double& x : c.point) {
        x = random.scaled(0.5, 1, 0, 20);
        if (random.coin()) x = -x;
    }
}

}  // namespace

const std::vector<InverseFamily>& inverse_families() {
    static const std::vector<InverseFamily> all{
        {"affine", "parallelepipeds, and parts of them; points inside", affine},
        {"warped", "nodes of the unit cell off by up to 0.3; points inside",
         [](InverseCase& c, Random& random) {
             warp(c, random, 0.3);
             inside(c, random);
         }},
        {"moved", "nodes off by up to 0.2, moved by 2^20; points inside",
         [](InverseCase& c, Random& random) {
             warp(c, random, 0.2, 0x1p20);
             inside(c, random);
         }},
        {"thin", "2^-8 to 2^-24 as thick as wide, 1 to 2^-20 wide; points inside", thin},
        {"flat-corner",
         "a corner 2^-4 to 2^-41 over the plane of its neighbours; points 1 to 2^-20 from it, or an apex", flat_corner},
        {"boundary", "nodes with small integers; points exactly on sides, edges and nodes", on_lattice},
        {"beside", "warped ones; points within a few ulps of a side", beside},
        {"beyond", "warped ones; points past a side by 2^-41 to 1 of the cell", beyond},
        {"far", "warped ones; points up to 2^20 cells away", far},
    };
    return all;
}

InverseCase make_inverse_case(const InverseFamily& family, std::uint8_t type, std::uint64_t seed, std::uint64_t index) {
    const ExactEnvironment environment;
    Random random = Random::stream(seed, base::hash64(family.name) + type, index);
    const iso::Reference& of = *iso::linear_reference(type);
    InverseCase c{type, std::vector<double>(of.dimension() * of.nodes), std::vector<double>(of.nodes),
                  std::vector<double>(of.dimension())};
    family.make(c, random);
    for (double& x : c.values) x = random.uniform(-1, 1);
    return c;
}

}  // namespace barycert
