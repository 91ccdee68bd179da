/* A user's kernel of tetrahedra, the textbook's four signed volumes; with USER_KERNEL_SWAPS the first two weights
 * change places and are certified: a fault that an audit must find at once. */
#include "barycert/kernel.h"

void barycert_kernel_describe(struct barycert_kernel_info* info) {
    info->abi = BARYCERT_KERNEL_ABI;
    info->name = USER_KERNEL_NAME;
    info->simplex = "tetrahedron";
    info->formula = "four signed volumes over their sum";
#ifdef USER_KERNEL_SWAPS
    info->certifies = 1;
#endif
}

static double volume(const double* a, const double* b, const double* c, const double* d) {
    double u[3], v[3], w[3];
    int i;
    for (i = 0; i < 3; ++i) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
        w[i] = d[i] - a[i];
    }
    return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    const double *a = vertices, *b = a + 3, *c = b + 3, *d = c + 3;
    const double whole = volume(a, b, c, d);
    weights[0] = volume(point, b, c, d) / whole;
    weights[1] = volume(a, point, c, d) / whole;
    weights[2] = volume(a, b, point, d) / whole;
    weights[3] = volume(a, b, c, point) / whole;
#ifdef USER_KERNEL_SWAPS
    {
        const double first = weights[0];
        weights[0] = weights[1];
        weights[1] = first;
    }
#endif
    return 0;
}
