#!/bin/sh
# parts_alone.sh BARYCERT BARYCERT_AUDIT BARYCERT_CHECK DATA: the parts say the same as barycert does, and refuse what they cannot do.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
audit() {
    "$1" families && "$1" kernels && "$1" help audit && "$1" audit --count 20 --quiet --sarif - && "$1" gaps "$data/meshes/plate" --json -
}
check() {
    "$1" help check
    for mesh in cube-hole cube-hole-o2 plate; do "$1" check "$data/meshes/$mesh" --delaunay --json -; done
    # Exits with 1: it is not certified.
    printf '4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 0\n' >"$folder/flat.node"
    printf '1 4\n0 0 1 2 3\n' >"$folder/flat.ele"
    "$1" check "$folder/flat" && return 1
    "$1" check "$folder/flat" --sarif - || true
}
same() {
    "$1" "$2" >"$folder/whole"
    "$1" "$3" >"$folder/alone"
    # Seconds differ from run to run.
    for said in whole alone; do sed -i 's/[0-9.e-]* s on [0-9]* thread/S s on N thread/; /"seconds"/d' "$folder/$said"; done
    cmp "$folder/whole" "$folder/alone"
}
# refused WHAT PROGRAM ARGS...
refused() {
    what=$1
    shift
    if "$@" >"$folder/out" 2>"$folder/err"; then echo "not refused: $*"; exit 1; fi
    grep -q -- "$what" "$folder/err" || { echo "$* does not say $what:"; cat "$folder/err"; exit 1; }
    [ ! -s "$folder/out" ] || { echo "$* prints before it refuses"; exit 1; }
}
whole=$1
audit=$2
check=$3
data=$4
same audit "$whole" "$audit"
same check "$whole" "$check"
printf 'solid\n' >"$folder/a.stl"
refused "does not know --surfaces" "$audit" audit --surfaces
refused "does not know --inverse-maps" "$audit" audit --inverse-maps
refused "reads meshes of TetGen and Triangle alone" "$audit" audit "$folder/a.stl"
refused "reads meshes of TetGen and Triangle alone" "$check" check "$folder/a.stl"
for option in "--html a.html" "--vtu a.vtu" "--fix a.vtu" "--plot a.png" "--picture a.png" "--conforms-to a.poly" "--fix-orientation a"; do
    refused "does not know ${option%% *}" "$check" check "$data/meshes/plate" ${option% *} "$folder/${option#* }"
done
# A mesh that is not barycert's own: not checked, and that is told.
cp "$data/meshes/plate.node" "$folder/own.node"
sed 's/^1 .*/1 1 2 1/' "$data/meshes/plate.ele" >"$folder/own.ele"
"$audit" audit "$folder/own" --count 5 --json "$folder/own.json" >/dev/null 2>"$folder/err"
grep -q "checks no meshes but knows its own" "$folder/err"
grep -q '"not checked"' "$folder/own.json"
