// The oracle: exact signs, correctly rounded weights and value of one case, by integers alone.

#include <barycert/oracle.hpp>

#include <cstdio>

using namespace barycert;

int main() {
    Case c;
    c.simplex = Simplex::tetrahedron;
    c.vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    c.point = {0.1, 0.2, 0.3};
    c.values = {1, 2, 3, 4};

    const OracleAnswer answer = ask_oracle(c);
    std::printf("%s, weights %g %g %g %g, value %.17g\n", name(answer.region).data(), answer.weights[0],
                answer.weights[1], answer.weights[2], answer.weights[3], answer.value);
}
