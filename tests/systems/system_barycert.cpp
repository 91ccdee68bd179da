// barycert itself, asked as the others are.
#include <cstdio>
#include <string>

#include "barycert/sampler.hpp"
#include "systems/exchange.hpp"

int main(int count, char** words) {
    using namespace barycert;
    if (count != 4 || std::string(words[2]) != "locate") return 2;
    const systems::Question question(words[3]);
    Mesh mesh;
    mesh.dimension = static_cast<int>(question.dimension);
    mesh.points = question.nodes;
    mesh.cells = question.cells;
    mesh.point_fields = {{"f", 1, question.values}};
    systems::Answer answer;
    const double start = systems::now();
    const Sampler sampler = Sampler::build(mesh, {}, {.threads = 1}).value();
    const double built = systems::now();
    SampleOptions options;
    options.threads = 1;
    const Table rows = sampler.sample(question.points, options).value();
    answer.index_seconds = built - start;
    answer.seconds = systems::now() - built;
    answer.owners.assign(rows.cells.begin(), rows.cells.end());
    answer.sampled = rows.values;
    answer.write(question.folder);
    std::printf("%s\n", BARYCERT_VERSION);
    return 0;
}
