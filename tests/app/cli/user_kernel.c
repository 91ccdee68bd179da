/* A user's kernel of tetrahedra, the textbook's four signed volumes; with USER_KERNEL_SWAPS the first two weights
 * change places and are certified: a fault that an audit must find at once. */
#include "tests/audit/signed_volumes.h"
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

int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    signed_volumes(vertices, point, weights);
#ifdef USER_KERNEL_SWAPS
    {
        const double first = weights[0];
        weights[0] = weights[1];
        weights[1] = first;
    }
#endif
    return 0;
}
