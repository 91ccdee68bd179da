/* The textbook's weights of a point in a tetrahedron: four signed volumes over that of the whole. */
#ifndef BARYCERT_TESTS_SIGNED_VOLUMES_H
#define BARYCERT_TESTS_SIGNED_VOLUMES_H

static double signed_volume(const double* a, const double* b, const double* c, const double* d) {
    double u[3], v[3], w[3];
    int i;
    for (i = 0; i < 3; ++i) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
        w[i] = d[i] - a[i];
    }
    return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

static void signed_volumes(const double* vertices, const double* point, double* weights) {
    const double *a = vertices, *b = a + 3, *c = b + 3, *d = c + 3;
    const double whole = signed_volume(a, b, c, d);
    weights[0] = signed_volume(point, b, c, d) / whole;
    weights[1] = signed_volume(a, point, c, d) / whole;
    weights[2] = signed_volume(a, b, point, d) / whole;
    weights[3] = signed_volume(a, b, c, point) / whole;
}

#endif
