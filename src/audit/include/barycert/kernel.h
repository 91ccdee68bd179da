/* The C interface of a user's kernel: build a shared library with the first two functions, and the others if you like,
 * and name it on the command line, `barycert audit --kernel-library FILE`. All functions must be safe to call from
 * several threads at once. They are to leave rounding mode and flush-to-zero as they are, and to write nothing to
 * stdout. */
#ifndef BARYCERT_KERNEL_H
#define BARYCERT_KERNEL_H

#ifdef __cplusplus
extern "C" {
#endif

#define BARYCERT_KERNEL_ABI 1

struct barycert_kernel_info {
    int abi;                 /* set to BARYCERT_KERNEL_ABI */
    const char* name;        /* without the simplex: "my-formula" is listed as "tetrahedron.my-formula" */
    const char* simplex;     /* "segment", "triangle", "triangle3d" or "tetrahedron"; or "triangle.perspective", whose
                                "my-formula" is listed as "triangle.perspective-my-formula" */
    const char* formula;     /* one line; may be NULL */
    const char* source;      /* may be NULL */
    int declares_degenerate; /* 1 if barycert_kernel_weights may return 1 */
    int certifies;           /* 1 if every sign is promised exact and every weight correctly rounded */
};

/* Fills *info, whose members are zero on entry. The strings must live as long as the library. */
void barycert_kernel_describe(struct barycert_kernel_info* info);

/* vertices: the coordinates, vertex after vertex (segment 2x3, triangle 3x2, triangle3d 3x3, tetrahedron 4x3;
 * triangle.perspective 3x3: x, y in the window and the depth w, above 0); point: its 2 or 3 coordinates; weights: room
 * for one a vertex.
 * Returns 0 if the weights are set, 1 if the simplex is declared degenerate. */
int barycert_kernel_weights(const double* vertices, const double* point, double* weights);

enum barycert_kernel_region {
    BARYCERT_INTERIOR = 0,
    BARYCERT_BOUNDARY = 1, /* inside as well */
    BARYCERT_OUTSIDE = 2,
    BARYCERT_DEGENERATE = 3 /* also any other number */
};

/* Optional: where the point lies by the rule of your program, such as w >= -1e-10 for all weights. `weights` are those
 * that barycert_kernel_weights set for the same arguments; not called if it returned 1. Returns a
 * barycert_kernel_region. Without it the signs of the weights tell: any < 0 outside, else any = 0 boundary, else
 * interior; or, with --class-tolerance X, all >= -X interior, else outside. */
int barycert_kernel_classify(const double* vertices, const double* point, const double* weights);

/* Optional: the interpolated value at the point, of the nodal values, one a vertex. Without it the value is the sum of
 * weight times nodal value. */
double barycert_kernel_value(const double* vertices, const double* point, const double* values);

#ifdef __cplusplus
}
#endif
#endif
