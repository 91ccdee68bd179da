// A 3x3 solve by Eigen's QR decomposition with pivots; its LU decompositions are kernels of the catalogue.
#include <Eigen/QR>

#include "library.hpp"

#define BARYCERT_TEXT_OF(x) #x
#define BARYCERT_TEXT(x) BARYCERT_TEXT_OF(x)
#define BARYCERT_EIGEN \
    BARYCERT_TEXT(EIGEN_WORLD_VERSION) "." BARYCERT_TEXT(EIGEN_MAJOR_VERSION) "." BARYCERT_TEXT(EIGEN_MINOR_VERSION)

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    barycert::libraries::describe(info, "eigen-" BARYCERT_EIGEN ".qr", "tetrahedron",
                                  "[v0 - v3, v1 - v3, v2 - v3] W = p - v3; the last weight is 1 - sum",
                                  "Eigen::ColPivHouseholderQR", false);
}

extern "C" int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 4>> v(vertices);
    const Eigen::Map<const Eigen::Vector3d> p(point);
    const Eigen::Matrix3d edges = v.leftCols<3>().colwise() - v.col(3);
    const Eigen::Vector3d right = p - v.col(3);
    Eigen::Map<Eigen::Vector3d> first(weights);
    first = edges.colPivHouseholderQr().solve(right);
    weights[3] = 1 - first.sum();
    return 0;
}
