#!/bin/sh
# Law D1 across compilers: builds the exact core at several levels of optimisation with every compiler at hand, and
# compares what it answers with the number pinned in answers.hpp.
#
# same_bytes.sh SOURCE_DIR BUILD_DIR [LEVEL...]     levels -O0 and -O3 unless given; 77 if there is no compiler
#
# g++ -O3 is left out unless levels are given: the library itself is built so, and determinism_test.cpp compares its answers.
set -u
source=$1
build=$2
shift 2
built=
[ $# -gt 0 ] || { set -- -O0 -O3; built='g++ -O3'; }
mkdir -p "$build"
. "$(dirname "$0")/core_sources.sh"
flags='-std=c++20 -ffp-contract=off -pthread -Wno-psabi'
launcher=
command -v ccache >/dev/null && launcher=ccache

ran=0
status=0
for compiler in g++ clang++; do
    if ! command -v $compiler >/dev/null; then
        echo "$compiler: not here, left out"
        continue
    fi
    for level in "$@"; do
        [ "$compiler $level" != "$built" ] || continue
        objects=
        for file in $(core_sources "$source" "$build"); do
            object=$build/$compiler$level-$(basename "$file" .cpp).o
            rm -f "$object"
            $launcher $compiler $flags "$level" -DBARYCERT_VERSION='"x"' $(core_includes "$source") -c "$file" \
                -o "$object" &
            objects="$objects $object"
        done
        wait
        $compiler -pthread $objects -lhwy -o "$build/same_bytes$compiler$level" || exit 1
        echo "$compiler $level:"
        "$build/same_bytes$compiler$level" || status=1
        ran=$((ran + 1))
    done
done
[ $ran -gt 0 ] || exit 77
[ $status -eq 0 ] || echo "answers differ from the pinned number"
exit $status
