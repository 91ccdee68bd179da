#!/bin/sh
# pkg_config.sh PREFIX WORK CONSUMER PLATE COMPILER [FLAGS]: the programs of CONSUMER, compiled and linked by what
# pkg-config says of the installation, run and answer as they do when CMake links them.
set -eu
prefix=$1 work=$2 consumer=$3 plate=$4
shift 4
command -v pkg-config >/dev/null || { echo "pkg-config is not installed"; exit 77; }
found=$(find "$prefix" -name barycert.pc)
[ -n "$found" ] || { echo "no barycert.pc in $prefix"; exit 1; }
PKG_CONFIG_PATH=$(dirname "$found")
export PKG_CONFIG_PATH
pkg-config --validate barycert barycert-core barycert-audit barycert-audit-report
rm -rf "$work" && mkdir -p "$work"

# expect MODULE PROGRAM ANSWER [ARGS...]
expect() {
    module=$1 program=$2 answer=$3
    shift 3
    # Words of flags. shellcheck disable=SC2046
    $compile -o "$work/$program" "$consumer/$program.cpp" $(pkg-config --cflags --libs $module)
    said=$("$work/$program" "$@")
    [ "$said" = "$answer" ] || { printf '%s says: %s\nnot: %s\n' "$program" "$said" "$answer"; exit 1; }
}
compile="$* -std=c++20"
expect barycert read_mesh "2 dimensions, cells, weights 0.25 0.25 0.5" "$plate"
expect barycert sample_field "walk, cells 0 0 -1, values 1 1.5 nan, grid to 3, 12 points"
expect barycert-audit-report ask_oracle "interior, third exact, value 1, report long"
# Where it was moved to it is found as well.
folder=${PKG_CONFIG_PATH#"$prefix"}
mkdir -p "$work/moved$folder"
cp "$PKG_CONFIG_PATH"/*.pc "$work/moved$folder/"
PKG_CONFIG_PATH=$work/moved$folder
flags=$(pkg-config --cflags barycert)
case $flags in
    *"$work/moved"*) ;;
    *) echo "moved to $work/moved, its flags are $flags"; exit 1 ;;
esac
