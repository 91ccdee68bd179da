/* An example of a user's kernel: the weights of the octant tetrahedron 0, e_x, e_y, e_z scaled by its edge, whatever
 * the other vertices are. The macros make libraries with one fault each for the tests. */
#include "barycert/kernel.h"

#ifndef EXAMPLE_ABI
#define EXAMPLE_ABI BARYCERT_KERNEL_ABI
#endif
#ifndef EXAMPLE_SIMPLEX
#define EXAMPLE_SIMPLEX "tetrahedron"
#endif
#ifndef EXAMPLE_NAME
#define EXAMPLE_NAME "octant"
#endif

void barycert_kernel_describe(struct barycert_kernel_info* info) {
    info->abi = EXAMPLE_ABI;
    info->name = EXAMPLE_NAME;
    info->simplex = EXAMPLE_SIMPLEX;
    info->formula = "W_b = x/h, W_c = y/h, W_d = z/h, W_a = 1 - sum";
    info->declares_degenerate = 1;
}

#ifndef EXAMPLE_NO_WEIGHTS
int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    const double h = vertices[3] - vertices[0];
    int i;
    if (h == 0) return 1;
    weights[0] = 1;
    for (i = 0; i < 3; ++i) {
        weights[i + 1] = (point[i] - vertices[i]) / h;
        weights[0] -= weights[i + 1];
    }
    return 0;
}
#endif
