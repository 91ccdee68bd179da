#!/bin/sh
# Makes everything in data/plc and data/meshes again, byte for byte: data/make.sh BUILD-FOLDER
# BUILD-FOLDER is a build with BARYCERT_TETGEN. Meshes may differ in another version of TetGen than 1.5.0.
set -eu
data=$(cd "$(dirname "$0")" && pwd)
build=$(cd "${1:?usage: data/make.sh BUILD-FOLDER}" && pwd)
tetgen=$build/bin/barycert-tetgen
make_data=$build/data/barycert-make-data
for program in "$tetgen" "$make_data"; do
    [ -x "$program" ] || { echo "error: $program: not built" >&2; exit 2; }
done
raw=$(mktemp -d)
trap 'rm -rf "$raw"' EXIT

rm -rf "$data/plc" "$data/meshes"
mkdir "$data/plc" "$data/meshes"
"$make_data" plc "$data/plc"
"$make_data" plate "$data/meshes/plate"

# mesh NAME PLC TO-KEEP OPTIONS...: TO-KEEP is --bare (.node and .ele) or --whole (.face and .neigh too).
mesh() {
    name=$1 plc=$2 keep=$3
    shift 3
    "$tetgen" "$data/plc/$plc" --output "$raw/$name" "$@"
    if [ "$keep" = --bare ]; then set -- --bare; else set --; fi
    "$make_data" fields "$raw/$name" "$data/meshes/$name" "$@"
}

mesh cube-hole cube-hole.poly --whole --quality 1.4
mesh cube-hole-o2 cube-hole.poly --whole --max-volume 0.01 --order 2
mesh bracket bracket.poly --whole --quality 1.4 --min-dihedral 12 --index-base 1
mesh needle-slit needle-slit.smesh --bare --quality 1.4 --max-volume 0.02
mesh lattice-box lattice-box.poly --bare
mesh lattice-eighths lattice-eighths.poly --bare
mesh torus torus.off --bare --quality 1.4
mesh flange flange.poly --bare --quality 1.3 --max-volume 0.0004
