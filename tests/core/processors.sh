#!/bin/sh
# -march and the like: every source that includes Highway compiles for a processor that has more than its targets ask
# for, and the exact core answers the same, whatever the least processor is.
#
# processors.sh SOURCE_DIR BUILD_DIR [PROCESSOR...]     x86-64-v2, -v3, -v4 and native unless given; 77 elsewhere
set -u
source=$1
build=$2
shift 2
[ "$(uname -m)" = x86_64 ] || { echo "not an x86-64 machine: left out"; exit 77; }
command -v g++ >/dev/null || { echo "g++ is not here: left out"; exit 77; }
[ $# -gt 0 ] || set -- x86-64-v2 x86-64-v3 x86-64-v4 native
mkdir -p "$build"
. "$(dirname "$0")/core_sources.sh"
flags='-std=c++20 -ffp-contract=off -pthread -Wno-psabi'
launcher=
command -v ccache >/dev/null && launcher=ccache
status=0

# All that includes Highway, by way of others too. By syntax alone: what failed were its headers.
sapphire() {
    for file in $(cd "$source/src" && grep -lE '(numerators|lane_loop|refinement|filter|gradient|quadratic|records)-inl.hpp|foreach_target.hpp|hwy/' \
        barycert/*/*.cpp barycert/*/*/*.cpp); do
        echo "$source/src/$file"
    done
}
for file in $(sapphire); do
    # shellcheck disable=SC2086
    g++ $flags -march=sapphirerapids -I"$source/src" -fsyntax-only "$file" ||
        { echo "FAULT: $file does not compile with -march=sapphirerapids"; status=1; }
done

for processor in "$@"; do
    objects=
    for file in $(core_sources "$source" "$build"); do
        object=$build/$processor-$(basename "$file" .cpp).o
        rm -f "$object"
        # shellcheck disable=SC2086
        $launcher g++ $flags -O1 -march="$processor" -DBARYCERT_VERSION='"x"' -I"$source/src" -I"$source/tests" \
            -c "$file" -o "$object" &
        objects="$objects $object"
    done
    wait
    # shellcheck disable=SC2086
    g++ -pthread $objects -lhwy -lfmt -o "$build/same_bytes-$processor" || { status=1; continue; }
    case $processor in
        x86-64-v4) needs=avx512dq ;;
        x86-64-v3) needs=avx2 ;;
        *) needs=fpu ;;
    esac
    if ! grep -qw "$needs" /proc/cpuinfo; then
        echo "$processor: built; this processor cannot run it"
        continue
    fi
    echo "$processor:"
    "$build/same_bytes-$processor" || { echo "FAULT: answers differ from the pinned number"; status=1; }
done
exit $status
