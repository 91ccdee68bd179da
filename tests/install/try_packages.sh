# The step `packages` of bare-debian.sh, which reads this file: installs the packages of DEBS in the bare system, with
# what they depend on and nothing else, and does with each what it is for.

# try WORDS COMMAND: runs it in the bare system, in an empty folder, and tells what it said if it fails.
try() {
    words=$1
    if inside "mkdir -p /root/try && cd /root/try && $2" >"$place/try.log" 2>&1; then
        say "holds: $words"
    else
        tail -n 40 "$place/try.log" >&2
        die "$words failed: $2"
    fi
}

# install_packages PATTERNS: dpkg unpacks them and leaves what they depend on to apt.
install_packages() {
    inside "apt-get update -qq; dpkg -i $1 || true; DEBIAN_FRONTEND=noninteractive apt-get install -y -qq -f --no-install-recommends" >"$place/install.log" 2>&1 ||
        { tail -n 40 "$place/install.log" >&2; die "the packages could not be installed: $1"; }
}

# need_there PACKAGES: for what is tried, and no dependency of what is installed.
need_there() {
    inside "DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $1" >"$place/install.log" 2>&1 ||
        { tail -n 40 "$place/install.log" >&2; die "$1 could not be installed"; }
}

try_packages() {
    debs=${DEBS-$root/build/package/packages}
    ls "$debs"/barycert_*.deb >/dev/null 2>&1 || die "there are no packages in $debs: ./run package makes them"
    mkdir -p "$system/debs"
    cp "$debs"/*.deb "$system/debs/"
    meshes=/usr/share/barycert/data/meshes

    timed "programs and the package for Python" -- install_packages \
        "/debs/barycert_*.deb /debs/barycert-tetgen_*.deb /debs/python3-barycert_*.deb"
    try "installed, and nothing to build with" "dpkg -s barycert barycert-tetgen python3-barycert | grep -c 'Status: install ok installed' | grep -qx 3 && ! command -v g++"
    try "barycert audit" "barycert audit --count 1000 --json audit.json --witnesses witnesses.json && barycert replay witnesses.json"
    try "barycert sample, verified to the last bit" "barycert sample $meshes/flange --points $meshes/bracket --output rows.csv && barycert verify $meshes/flange --results rows.csv --exact"
    try "barycert check, resample, render" "barycert check $meshes/cube-hole && barycert resample $meshes/flange --grid 9x9x9 --output grid.vti && barycert render slice $meshes/flange --plane 0,0,1,0.25 --field attribute1 --output slice.png"
    try "barycert mesh" "barycert mesh /barycert/data/plc/cube-hole.poly --output part && barycert check part"
    try "import barycert" "python3 - <<'END'
import barycert, numpy
nodes = numpy.array([[0., 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
f = barycert.Interpolator(nodes, [[0, 1, 2, 3]], [1., 2, 3, 4])
assert f([[0.25, 0.25, 0.25]]) == 2.5 and numpy.isnan(f([[2., 0, 0]])), f([[0.25, 0.25, 0.25]])
mesh = barycert.read('$meshes/flange.node')
assert mesh.check() is not None and len(mesh.sample(mesh.points[:5], 'attribute1')) == 5
END"
    try "completions of bash" "bash -c '. /usr/share/bash-completion/completions/barycert && complete -p barycert'"
    need_there "man-db"
    try "man" "man barycert | grep -q 'barycert - ' && man barycert-render-iso | grep -q -e --value && man barycert-tetgen | grep -q -e --max-volume && apropos barycert | grep -q barycert-sample"

    timed "libbarycert-core-dev" -- install_packages "/debs/libbarycert-core-dev_*.deb"
    need_there "g++ pkg-config cmake ninja-build"
    try "nothing but Highway comes with it" "! dpkg -l libtbb-dev libfmt-dev libcairo2-dev 2>/dev/null | grep '^ii'"
    try "the core linked by pkg-config" "g++ -std=c++20 -O1 /barycert/tests/install/consumer/exact_values.cpp \$(pkg-config --cflags --libs barycert-core) -o core && ./core | grep '^on a face'"
    try "what is not there is told" "mkdir -p lacks && cd lacks && printf 'cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\nfind_package(barycert REQUIRED COMPONENTS draw)\n' >CMakeLists.txt && ! cmake -G Ninja . >said 2>&1 && grep libbarycert-draw-dev said"
    timed "libbarycert-dev" -- install_packages "/debs/libbarycert-core-dev_*.deb /debs/libbarycert-files-dev_*.deb /debs/libbarycert-mesh-dev_*.deb /debs/libbarycert-io-dev_*.deb /debs/libbarycert-dev_*.deb"
    try "a program linked by pkg-config" "g++ -std=c++20 -O1 /barycert/tests/install/consumer/sample_field.cpp \$(pkg-config --cflags --libs barycert) -o by-pkg-config && ./by-pkg-config | grep '^walk, cells 0 0 -1'"
    timed "the other libraries" -- install_packages "/debs/libbarycert-draw-dev_*.deb /debs/libbarycert-audit-dev_*.deb /debs/libbarycert-app-dev_*.deb"
    try "the oracle linked by pkg-config" "g++ -std=c++20 -O1 /barycert/tests/install/consumer/ask_oracle.cpp \$(pkg-config --cflags --libs barycert-audit) -o oracle && ./oracle | grep '^interior, third exact'"
    if ls "$debs"/libbarycert-vtk-dev_*.deb >/dev/null 2>&1; then
        timed "libbarycert-vtk-dev, with VTK" -- install_packages "/debs/libbarycert-vtk-dev_*.deb"
        try "a program linked by CMake, with VTK" "cmake -G Ninja -S /barycert/tests/install/vtk_consumer -B vtk -DEXAMPLE=/barycert/doc/examples/vtk_probe.cpp && cmake --build vtk && vtk/vtk_probe | grep 'valid 1, cell 1, T = 25'"
    fi
    try "all removed" "dpkg --purge \$(dpkg-query -W -f '\${Package} \${Status}\n' '*barycert*' | awk '\$4 == \"installed\" { print \$1 }') && [ -z \"\$(ls -d /usr/bin/barycert* /usr/share/barycert /usr/lib/python3/dist-packages/barycert /usr/share/man/man1/barycert* 2>/dev/null)\" ]"
}
