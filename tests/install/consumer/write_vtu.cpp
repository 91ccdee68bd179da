// One cell to a file, whose first line is printed.

#include <cstdio>
#include <fstream>
#include <string>

#include <barycert/vtk_files.hpp>

int main(int argc, char** argv) {
    const std::string path = argc > 1 ? argv[1] : "";
    barycert::Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    mesh.cells = {0, 1, 2, 3};
    const barycert::Status status = barycert::write_vtu(mesh, path);
    if (!status) return std::fprintf(stderr, "%s\n", status.error().message().c_str()), 2;
    std::string line;
    std::getline(std::ifstream(path), line);
    std::printf("%s\n", line.c_str());
    return 0;
}
