/* The C interface of a user's kernel: build a shared library with these two functions and name it on the command
 * line, `barycert audit --kernel-library FILE`. Both functions must be safe to call from several threads at once. */
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

#ifdef __cplusplus
}
#endif
#endif
