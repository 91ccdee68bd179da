/// Floating-point environments to ask questions in, and cases laid out for batches.
#pragma once

#include <array>
#include <cfenv>
#include <string>
#include <vector>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "barycert/simplex.hpp"

namespace barycert::testing_environments {

struct Environment {
    std::string name;
    int rounding = FE_TONEAREST;
    unsigned flags = 0;  ///< of the SSE control register, besides
    std::string found;   ///< what an Error calls it
    std::string remedy;  ///< a word of the remedy
    bool is_default = false;
};

inline std::vector<Environment> all_environments() {
    std::vector<Environment> all{{"default", FE_TONEAREST, 0, "", "", true},
                                 {"upward", FE_UPWARD, 0, "rounding upward", "fesetround"},
                                 {"downward", FE_DOWNWARD, 0, "rounding downward", "fesetround"},
                                 {"toward zero", FE_TOWARDZERO, 0, "rounding toward-zero", "fesetround"}};
#ifdef __SSE2__
    constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    const std::string found = "subnormal numbers flushed to zero";
    all.push_back({"flush to zero", FE_TONEAREST, flush_to_zero, found, "FTZ"});
    all.push_back({"denormals are zero", FE_TONEAREST, denormals_are_zero, found, "DAZ"});
    all.push_back({"both", FE_TONEAREST, flush_to_zero | denormals_are_zero, found, "DAZ"});
    all.push_back(
        {"both, downward", FE_DOWNWARD, flush_to_zero | denormals_are_zero, "rounding downward", "fesetround"});
#endif
    return all;
}

/// Sets an environment for as long as it lives. Comparisons of doubles belong outside.
class Changed {
public:
    explicit Changed(const Environment& e) {
        std::fegetenv(&before_);
        std::fesetround(e.rounding);
#ifdef __SSE2__
        _mm_setcsr(_mm_getcsr() | e.flags);
#endif
    }
    ~Changed() {
        std::fesetenv(&before_);
    }
    Changed(const Changed&) = delete;
    Changed& operator=(const Changed&) = delete;

private:
    std::fenv_t before_;
};

/// Cases as a structure of arrays, and as a mesh that has nodes of its own for each.
class Columns {
public:
    Columns(Simplex s, const std::vector<Case>& cases) : simplex_(s), count_(cases.size()) {
        const int n = vertex_count(s), d = space_dimension(s);
        for (std::size_t j = 0; j < count_; ++j) {
            const Case& c = cases[j];
            for (int i = 0; i < n; ++i) {
                for (int k = 0; k < d; ++k) {
                    vertices_[static_cast<std::size_t>(d * i + k)].push_back(c.vertex(i, k));
                    nodes_.push_back(c.vertex(i, k));
                }
                values_[static_cast<std::size_t>(i)].push_back(c.values[static_cast<std::size_t>(i)]);
                node_values_.push_back(c.values[static_cast<std::size_t>(i)]);
                corners_.push_back(static_cast<std::int32_t>(corners_.size()));
            }
            for (int k = 0; k < d; ++k) {
                point_[static_cast<std::size_t>(k)].push_back(c.point[static_cast<std::size_t>(k)]);
                points_.push_back(c.point[static_cast<std::size_t>(k)]);
            }
            cells_.push_back(static_cast<std::int32_t>(j));
        }
    }

    CaseArrays arrays() const {
        CaseArrays a{.simplex = simplex_, .count = count_};
        for (std::size_t i = 0; i < 12; ++i) a.vertices[i] = vertices_[i].empty() ? nullptr : vertices_[i].data();
        for (std::size_t k = 0; k < 3; ++k) a.point[k] = point_[k].empty() ? nullptr : point_[k].data();
        return a;
    }
    MeshQueries mesh() const { return {simplex_, nodes_, corners_, cells_, points_}; }
    ValueArrays<double> values() const {
        ValueArrays<double> v;
        for (std::size_t i = 0; i < 4; ++i) v.at[i] = values_[i].data();
        return v;
    }
    NodalValues<double> nodal_values() const { return {node_values_, 1}; }

private:
    Simplex simplex_;
    std::size_t count_;
    std::array<std::vector<double>, 12> vertices_;
    std::array<std::vector<double>, 3> point_;
    std::array<std::vector<double>, 4> values_;
    std::vector<double> nodes_, points_, node_values_;
    std::vector<std::int32_t> corners_, cells_;
};

}  // namespace barycert::testing_environments
