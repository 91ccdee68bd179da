/// Rows that Sampler must give: by the oracle, cell by cell.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/sampler.hpp"
#include "core/base/random.hpp"

namespace barycert::testing {

/// The same number, bit for bit; one NaN is as good as another.
bool same(double x, double y);

/// Both outputs, bit for bit, NaN for NaN.
bool same(const Table& a, const Table& b);

/// The correctly rounded value of component c of a point field at a point, by the function of the cell, linear or
/// quadratic as the mesh is; NaN if a nodal value that has a part is not finite or the cell is degenerate.
double true_value(const Mesh& mesh, const Field& field, std::size_t c, Mesh::Index cell, const double* point);

/// Fields of these numbers of components at every node or cell: ordinary values, or some that are awkward: zeros of
/// both signs, subnormal, the largest ones, values that cancel.
std::vector<Field> random_fields(std::size_t entities, const std::vector<int>& components, bool awkward,
                                 base::Random& random);

/// All point fields, then all cell fields of the mesh.
std::vector<FieldChoice> all_fields(const Mesh& mesh);

/// Every row that says that the point is in a cell has the values that it should have. Returns how many had one.
std::size_t expect_true_values(const Mesh& mesh, const std::vector<double>& points, const Table& samples,
                               const std::string& what);

/// Owners and features are those of the judge.
void expect_true_owners(const Mesh& mesh, const std::vector<double>& points, const Table& samples,
                        const std::string& what);

}  // namespace barycert::testing
