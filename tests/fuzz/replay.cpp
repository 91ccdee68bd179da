// fuzz_replay TARGET PATH...: runs a target over files, and over all files in folders: the fuzzer's inputs as tests,
// for any compiler. Ends at the first that fails, whose name is the last that was printed.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/target.hpp"

int main(int argc, char** argv) {
    namespace fs = std::filesystem;
    using namespace barycert::fuzz;
    const std::string_view name = argc > 1 ? argv[1] : "";
    const auto target =
        std::find_if(targets().begin(), targets().end(), [&](const Target& t) { return t.name == name; });
    if (target == targets().end()) {
        std::fprintf(stderr, "usage: fuzz_replay TARGET PATH...; targets:");
        for (const Target& t : targets()) std::fprintf(stderr, " %s", t.name);
        std::fprintf(stderr, "\n");
        return 2;
    }
    std::vector<fs::path> files;
    for (int i = 2; i < argc; ++i) {
        if (!fs::exists(argv[i])) continue;  // a target that has never failed has no folder of what was found
        if (!fs::is_directory(argv[i])) files.emplace_back(argv[i]);
        if (!fs::is_directory(argv[i])) continue;
        for (const auto& entry : fs::directory_iterator(argv[i])) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        std::ifstream stream(file, std::ios::binary);
        if (!stream) {
            std::fprintf(stderr, "cannot read %s\n", file.c_str());
            return 2;
        }
        const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        std::printf("%s\n", file.c_str());
        std::fflush(stdout);
        run(*target, bytes);
    }
    std::printf("%zu inputs\n", files.size());
    return files.empty() ? 2 : 0;
}
