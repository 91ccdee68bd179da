/// The large mesh of the benchmarks: the unit cube in about 2 million cells, made by TetGen in the first run (a minute)
/// and kept in the folder BARYCERT_BENCH_DIR, or else the system's temporary folder. Developers only: TetGen is AGPL.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <string>

/// TetGen prints; while this lives, what goes to stdout is lost.
class Silence {
public:
    Silence() : kept_((std::fflush(stdout), ::dup(STDOUT_FILENO))) {
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, STDOUT_FILENO);
        ::close(nowhere);
    }
    ~Silence() {
        std::fflush(stdout);
        ::dup2(kept_, STDOUT_FILENO);
        ::close(kept_);
    }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    int kept_;
};

/// The stem of the mesh's files, which are there afterwards.
std::string large_mesh_stem();
