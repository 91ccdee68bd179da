// ./run flags: the matrix as Markdown on stdout, as JSON and as a picture in files.
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "files/output_file.hpp"
#include "matrix.hpp"

namespace {

barycert::Status write(const std::string& path, const std::string& text) {
    barycert::base::OutputFile file(path);
    file.write(text);
    return file.commit();
}

int failed(const barycert::Error& error) {
    fmt::print(stderr, "error: {}\n", error.message());
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace barycert;
    std::string json, svg;
    std::uint64_t count = 2000;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        const char* const value = i + 1 < argc ? argv[++i] : nullptr;
        const bool known = option == "--json" || option == "--svg" || option == "--count";
        if (!known || value == nullptr) {
            fmt::print(stderr, "usage: flags [--count CASES] [--json FILE] [--svg FILE]\n");
            return 2;
        }
        if (option == "--json") json = value;
        if (option == "--svg") svg = value;
        if (option == "--count") count = std::strtoull(value, nullptr, 10);
        if (option == "--count" && (count == 0 || count > 1000000)) {
            fmt::print(stderr, "error: --count: expected 1 to 1000000, found {}\n", value);
            return 2;
        }
    }
    const Result<flags::Matrix> matrix = flags::measure(FLAGS_LIST, count, 1);
    if (!matrix) return failed(matrix.error());
    for (const std::string& compiler : matrix->compilers) fmt::print("{}  \n", compiler);
    fmt::print("{} cases of each of {} families, seed {}\n\n{}", matrix->count, matrix->families.size(), matrix->seed,
               flags::markdown(*matrix));
    if (!json.empty()) {
        if (const Status ok = write(json, flags::json(*matrix)); !ok) return failed(ok.error());
    }
    if (!svg.empty()) {
        if (const Status ok = write(svg, flags::picture(*matrix)); !ok) return failed(ok.error());
    }
    return 0;
}
