/* A kernel for `barycert audit --kernel-library`: ratios of signed volumes, in plain double. Wrong on purpose: beside
 * faces and edges its signs are rounded away. right_kernel.c is right. */
#include "barycert/kernel.h"

static double det(const double* a, const double* b, const double* c, const double* d) {
    const double x[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double y[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double z[3] = {d[0] - a[0], d[1] - a[1], d[2] - a[2]};
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
}

void barycert_kernel_describe(struct barycert_kernel_info* info) {
    info->abi = BARYCERT_KERNEL_ABI;
    info->name = "mine"; /* listed as tetrahedron.mine */
    info->simplex = "tetrahedron";
    info->formula = "w_i = det(p in place of v_i) / det(v0, v1, v2, v3)";
    info->declares_degenerate = 1;
}

int barycert_kernel_weights(const double* v, const double* p, double* weights) {
    const double *a = v, *b = v + 3, *c = v + 6, *d = v + 9;
    const double whole = det(a, b, c, d);
    if (whole == 0) return 1; /* degenerate */
    weights[0] = det(p, b, c, d) / whole;
    weights[1] = det(a, p, c, d) / whole;
    weights[2] = det(a, b, p, d) / whole;
    weights[3] = det(a, b, c, p) / whole;
    return 0;
}
