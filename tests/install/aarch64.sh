#!/bin/sh
# barycert on 64-bit ARM: cross-compiled in a bare Debian 12 of its own, run under qemu-user there. Results hash as on
# x86-64 (tests/processors/hashes.txt), the tests of the core, of location and of sampling must pass, and the program's
# own `verify --exact` finds nothing wrong with what it samples and resamples. Run by hand, as root, where debootstrap is
# installed; it needs about 4 GB in TMPDIR.
#   tests/install/aarch64.sh [MIRROR]
# MIRROR, KEEP and SYSTEM as for paraview.sh.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
name=aarch64
. "$root/tests/install/bare_system.sh"
bare_system "$@"

tools="g++ g++-aarch64-linux-gnu cmake ninja-build qemu-user"
libraries="libeigen3-dev libfast-float-dev nlohmann-json3-dev libcli11-dev libcgal-dev:arm64 libhwy-dev:arm64 libboost-dev:arm64 libtbb-dev:arm64 libfmt-dev:arm64 libpng-dev:arm64 libcairo2-dev:arm64
    zlib1g-dev:arm64 libexpat1-dev:arm64 libdeflate-dev:arm64 liblz4-dev:arm64 liblzma-dev:arm64 libgtest-dev:arm64 librapidcheck-dev:arm64 libgmp-dev:arm64"
packages=$(echo $tools $libraries)
timed install $packages -- inside "dpkg --add-architecture arm64 && apt-get update -qq &&
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $packages" \
    >"$place/apt.log" 2>&1 || { tail -n 30 "$place/apt.log" >&2; die "apt-get failed"; }

log=$place/log
step() {
    words=$1
    timed "$words" -- inside "$2" >"$log" 2>&1 || { tail -n 80 "$log" >&2; die "$words: failed"; }
    tail -n 1 "$log"
}
step configure "cmake -S . -B build/aarch64 -G Ninja -DCMAKE_BUILD_TYPE=Release -DBARYCERT_WERROR=ON \
    -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc \
    -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ -DCMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64 \
    -DBARYCERT_TETGEN=OFF -DBARYCERT_TESTS=ON '-DBARYCERT_TEST_FOLDERS=base;core;processors;locate;sample'"
step build "cmake --build build/aarch64 --target hashes barycert_cli test_base test_core test_locate test_sample"
say "$(inside "file -b build/aarch64/tests/processors/hashes 2>/dev/null || aarch64-linux-gnu-objdump -f build/aarch64/tests/processors/hashes | sed -n 2p")"
step "the same hashes" "qemu-aarch64 build/aarch64/tests/processors/hashes data | diff tests/processors/hashes.txt - && echo 'as on x86-64'"
program="qemu-aarch64 build/aarch64/bin/barycert"
step "barycert check" "$program check data/meshes/lattice-eighths"
step "barycert sample" "$program sample data/meshes/flange --points data/meshes/flange --output values.csv"
step "barycert verify, rows of sample" "$program verify data/meshes/flange --results values.csv --exact"
step "barycert resample" "$program resample data/meshes/flange --grid 40x40x40 --output grid.vti"
step "barycert verify, the grid of resample" "$program verify data/meshes/flange --results grid.vti --exact"
for tests in base core locate sample; do
    step "tests/$tests" "qemu-aarch64 build/aarch64/tests/$tests/test_$tests --gtest_brief=1"
done
say "all of it holds"
