/* A right kernel for `barycert audit --kernel-library`: ratios of signed volumes in GMP's rationals. Signs are exact,
 * so it has no finding; weights are truncated, so off by less than an ulp. And a rule of its own: the signs, told by
 * the numbers themselves and not by weights that may underflow. */
#include <gmp.h>

#include "barycert/kernel.h"

void barycert_kernel_describe(struct barycert_kernel_info* info) {
    info->abi = BARYCERT_KERNEL_ABI;
    info->name = "rational"; /* listed as tetrahedron.rational */
    info->simplex = "tetrahedron";
    info->formula = "w_i = det(p in place of v_i) / det(v0, v1, v2, v3), exactly, truncated";
    info->declares_degenerate = 1;
}

/* out = det(b - a, c - a, d - a) */
static void det(mpq_t out, const double* a, const double* b, const double* c, const double* d) {
    const double* rows[3];
    mpq_t m[3][3], x, y;
    int i, k;
    rows[0] = b, rows[1] = c, rows[2] = d;
    mpq_inits(x, y, NULL);
    for (i = 0; i < 3; ++i) {
        for (k = 0; k < 3; ++k) {
            mpq_init(m[i][k]);
            mpq_set_d(m[i][k], rows[i][k]);
            mpq_set_d(x, a[k]);
            mpq_sub(m[i][k], m[i][k], x);
        }
    }
    mpq_set_ui(out, 0, 1);
    for (k = 0; k < 3; ++k) {
        mpq_mul(x, m[1][(k + 1) % 3], m[2][(k + 2) % 3]);
        mpq_mul(y, m[1][(k + 2) % 3], m[2][(k + 1) % 3]);
        mpq_sub(x, x, y);
        mpq_mul(x, x, m[0][k]);
        mpq_add(out, out, x);
    }
    for (i = 0; i < 3; ++i) {
        for (k = 0; k < 3; ++k) mpq_clear(m[i][k]);
    }
    mpq_clears(x, y, NULL);
}

/* w[i] = the exact weights; 1 if there are none. */
static int solve(const double* v, const double* p, mpq_t w[4]) {
    const double* u[4];
    mpq_t whole;
    int i, k, flat;
    mpq_init(whole);
    det(whole, v, v + 3, v + 6, v + 9);
    flat = mpq_sgn(whole) == 0;
    for (i = 0; i < 4 && !flat; ++i) {
        for (k = 0; k < 4; ++k) u[k] = k == i ? p : v + 3 * k;
        det(w[i], u[0], u[1], u[2], u[3]);
        mpq_div(w[i], w[i], whole);
    }
    mpq_clear(whole);
    return flat;
}

int barycert_kernel_weights(const double* v, const double* p, double* weights) {
    mpq_t w[4];
    int i, flat;
    mpq_inits(w[0], w[1], w[2], w[3], NULL);
    flat = solve(v, p, w);
    for (i = 0; i < 4 && !flat; ++i) weights[i] = mpq_get_d(w[i]);
    mpq_clears(w[0], w[1], w[2], w[3], NULL);
    return flat;
}

int barycert_kernel_classify(const double* v, const double* p, const double* weights) {
    mpq_t w[4];
    int i, region = BARYCERT_INTERIOR;
    (void)weights;
    mpq_inits(w[0], w[1], w[2], w[3], NULL);
    if (solve(v, p, w)) region = BARYCERT_DEGENERATE;
    for (i = 0; i < 4 && region < BARYCERT_OUTSIDE; ++i) {
        if (mpq_sgn(w[i]) < 0)
            region = BARYCERT_OUTSIDE;
        else if (mpq_sgn(w[i]) == 0)
            region = BARYCERT_BOUNDARY;
    }
    mpq_clears(w[0], w[1], w[2], w[3], NULL);
    return region;
}
