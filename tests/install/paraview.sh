#!/bin/sh
# The plug-in for ParaView, built and tested in a bare Debian 12 of its own: Debian's paraview-dev and python3-paraview
# conflict with the packages of VTK that all else is built with. Run by hand, as root, where debootstrap is installed; it
# needs about 6 GB in TMPDIR.
#   tests/install/paraview.sh [MIRROR]
# MIRROR: a Debian archive; the first that this machine's apt uses for bookworm if left out. KEEP=1 leaves the system for
# a look inside, SYSTEM=FOLDER takes one that was left, with what is built in it.
#
# 1 the classes of src/vtk with ParaView's VTK 9.2: tests/vtk, tests/mpi; 2 the package barycert-paraview, judged by lintian and installed; 3 the
# plug-in in it: tests/paraview by pvpython; the commands of doc/paraview.md; two and three processes of pvbatch give the values
# of one.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
name=paraview
. "$root/tests/install/bare_system.sh"
bare_system "$@"

packages=$(sed -n 's/^\(build\|package\|paraview\)_packages="\([^"$]*\)".*/\2/p' "$root/run" | tr '\n' ' ')
timed install $packages -- inside "apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $packages" \
    >"$place/apt.log" 2>&1 || { tail -n 30 "$place/apt.log" >&2; die "apt-get failed"; }
say "$(inside "dpkg-query -W -f '\${Package} \${Version}  ' paraview libexpat1 cmake g++")"

log=$place/log
step() {
    words=$1
    timed "$words" -- inside "$2" >"$log" 2>&1 || { tail -n 80 "$log" >&2; die "$words: failed"; }
    tail -n 1 "$log"
}
step configure "cmake -S . -B build/paraview -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr \
    -DBARYCERT_WERROR=ON -DBARYCERT_TETGEN=OFF -DBARYCERT_PARAVIEW=ON -DBARYCERT_PACKAGE=ON \
    -DBARYCERT_TESTS=ON -DBARYCERT_TEST_FOLDERS='vtk;mpi' -DBARYCERT_VTK=ON -DVTK_DIR=\$(echo /usr/lib/*/cmake/paraview-5.11/vtk)"
step build "cmake --build build/paraview --target Barycert barycert_cli test_vtk test_mpi"
step "tests/vtk with VTK 9.2" "build/paraview/tests/vtk/test_vtk"
grep -E '^\[  PASSED' "$log" || die "no verdict of tests/vtk"
for ranks in 1 4; do
    step "tests/mpi with VTK 9.2, $ranks ranks" "mpirun --allow-run-as-root --oversubscribe -n $ranks build/paraview/tests/mpi/test_mpi"
    grep -E '^\[  PASSED' "$log" || die "no verdict of tests/mpi"
done
step package "cd build/paraview && rm -rf packages && cpack"
step lintian ".ci/lintian build/paraview/packages/*.deb"
step install "dpkg -i build/paraview/packages/barycert-paraview_*.deb"
plugin=$(inside "ls /usr/lib/*/paraview-5.11/plugins/Barycert/Barycert.so") || die "no plug-in was installed"
say "plug-in: $plugin"
# One screen for all, which stays when a program leaves it.
step tests/paraview "xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' sh tests/paraview/run.sh /barycert/build/paraview/bin $plugin /tmp/tests"
grep -E '^Ran [0-9]+ tests|owner than|^[0-9] processes' "$log"
say "pictures: $(inside "ls /tmp/tests/plugin/*.png /tmp/tests/document/copy/*.png" | tr '\n' ' ')"
say "all of it holds"
