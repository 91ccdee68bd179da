#!/bin/sh
# The promise of `./run`, kept or not: on a bare Debian 12 with nothing but its base system, a fresh clone audits and
# passes its tests, and samples VTK's files without VTK. Run by hand, as root, where debootstrap is installed; it needs about 5 GB in TMPDIR.
#   tests/install/bare-debian.sh [MIRROR]
# MIRROR: a Debian archive; the first that this machine's apt uses for bookworm if left out.
# STEPS="sample audit test" by default; each can be had alone. sample: a .vtu by VTK's writer goes in, a .vtu with values comes out, without VTK. KEEP=1 leaves the system for a look inside.
# packages: the packages that `./run package` made, from DEBS (build/package/packages), are installed and used; nothing is
# built there, so ask for it alone. SUITE=trixie: all that in Debian 13.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
name=bare-debian
. "$root/tests/install/bare_system.sh"
. "$root/tests/install/try_packages.sh"
steps=${STEPS-sample audit test}
bare_system "$@"

for step in $steps; do
    if [ $step = packages ]; then
        try_packages
        continue
    fi
    words=$step
    [ $step != sample ] || words="barycert sample data/vtk/bracket.vtu --points data/meshes/bracket --output values.vtu"
    timed "./run $words" -- inside "./run $words" >"$place/$step.log" 2>&1 ||
        { tail -n 60 "$place/$step.log" >&2; die "./run $words failed"; }
    tail -n 1 "$place/$step.log"
    case $step in
        sample)
            ! inside "dpkg -s libvtk9-dev >/dev/null 2>&1" || die "VTK was installed"
            inside "./run barycert verify data/vtk/bracket.vtu --results values.vtu --exact" || die "values.vtu is not right"
            ;;
        audit)
            for file in audit.json witnesses.json; do
                [ -s "$system/barycert/$file" ] || die "./run audit left no $file"
            done
            # The reader of witnesses refuses what is not JSON, has another schema or lacks a member.
            inside "build/release/bin/barycert replay audit.json >/dev/null" || die "audit.json does not replay"
            say "audit.json: $(wc -c <"$system/barycert/audit.json") bytes, every witness reproduced"
            ;;
        test)
            grep -E 'tests passed|tests failed' "$place/test.log" || die "no verdict of ctest in its output"
            ;;
    esac
done
say "all of it holds"
