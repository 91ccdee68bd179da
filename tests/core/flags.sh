#!/bin/sh
# Flags that let a compiler change results: taken back by the build (cmake/BarycertFlags.cmake), and where the sources
# are compiled in another way, refused or taken back by core/base/strict_math.hpp. With every compiler at hand.
#
# flags.sh SOURCE_DIR BUILD_DIR "FLAGS OF THE BUILD FOR g++" "FOR clang++"     77 if clang++ is not there
set -u
source=$1
build=$2
mkdir -p "$build"
. "$(dirname "$0")/core_sources.sh"
launcher=
command -v ccache >/dev/null && launcher=ccache
status=0
fault() { echo "FAULT: $*"; status=1; }

# The first all together, as the build meets them; each alone.
together='-ffast-math -funsafe-math-optimizations -fassociative-math -freciprocal-math -fno-signed-zeros -ffp-contract=fast'
alone='-ffast-math -Ofast -funsafe-math-optimizations -freciprocal-math -fno-signed-zeros -ffinite-math-only
-fassociative-math;-fno-signed-zeros;-fno-trapping-math'
gnu_alone=-fsingle-precision-constant
clang_alone='-fapprox-func -fno-honor-nans -fno-honor-infinities -ffp-model=fast'

cat >"$build/with_header.cpp" <<'EOF'
#include "core/base/strict_math.hpp"
double f(double a, double b, double c) { return (a + b) + c / b; }
EOF
grep -v include "$build/with_header.cpp" >"$build/without_header.cpp"

# GCC's header sees every flag: refused, unless the build's own come after it.
if command -v g++ >/dev/null; then
    for flags in $alone $gnu_alone; do
        flags=$(echo "$flags" | tr ';' ' ')
        # shellcheck disable=SC2086
        g++ -std=c++20 -O2 $flags $(core_includes "$source") -fsyntax-only "$build/with_header.cpp" 2>&1 |
            grep -q 'barycert is not correct under -ffast-math or a part of it' || fault "g++ does not refuse $flags"
        # shellcheck disable=SC2086
        g++ -std=c++20 -O2 $flags $3 $(core_includes "$source") -fsyntax-only "$build/with_header.cpp" ||
            fault "g++: the build's flags do not take back $flags"
    done
fi

# Clang writes into its intermediate code what it may do: "fadd reassoc nsz arcp afn double" for "fadd double".
operations() {
    clang++ -std=c++20 -O1 "$@" $(core_includes "$source") -S -emit-llvm -o - 2>&1 | grep -E ' (fadd|fdiv|fmul) |error:'
}
if command -v clang++ >/dev/null; then
    for flags in $alone $clang_alone; do
        flags=$(echo "$flags" | tr ';' ' ')
        # shellcheck disable=SC2086
        operations $flags "$build/without_header.cpp" | grep -qE '(fadd|fdiv) [a-z]+ ' ||
            fault "clang++: $flags changes nothing here: this test shows nothing"
        # shellcheck disable=SC2086
        found=$(operations $flags "$build/with_header.cpp")
        echo "$found" | grep -q 'barycert is not correct under' ||
            { echo "$found" | grep -q 'fadd double' && ! echo "$found" | grep -qE '(fadd|fdiv) [a-z]+ double'; } ||
            fault "clang++ neither refuses nor takes back $flags: $found"
        # shellcheck disable=SC2086
        found=$(operations $flags $4 "$build/without_header.cpp")
        echo "$found" | grep -q 'fadd double' && ! echo "$found" | grep -qE '(fadd|fdiv) [a-z]+ double' ||
            fault "clang++: the build's flags do not take back $flags: $found"
    done
fi

# Compares the answers of the exact core: answers.hpp.
# answers COMPILER NAME "FLAGS OF THE BUILD" FLAGS...      the cases themselves are made under the former alone
answers() {
    compiler=$1
    name=$2
    own=$3
    shift 3
    objects=
    for file in $(core_sources "$source" "$build"); do
        object=$build/$name-$(basename "$file" .cpp).o
        rm -f "$object"
        case $file in *same_bytes.cpp) set -- $own ;; esac
        $launcher "$compiler" -std=c++20 -O2 -pthread -Wno-psabi -w -DHWY_COMPILE_ONLY_STATIC -march=haswell -maes "$@" \
            -DBARYCERT_VERSION='"x"' $(core_includes "$source") -c "$file" -o "$object" &
        objects="$objects $object"
    done
    wait
    # shellcheck disable=SC2086
    "$compiler" -pthread $objects -lhwy -o "$build/$name" || { fault "$name does not build"; return; }
    echo "$name:"
    "$build/$name" || fault "$name: answers differ from the pinned number"
}
# shellcheck disable=SC2086
if command -v g++ >/dev/null; then answers g++ g++-taken-back "$3" $together $3; fi
# shellcheck disable=SC2086
if command -v clang++ >/dev/null; then
    answers clang++ clang++-taken-back "$4" $together $4
    # No flags of the build but -ffp-contract=off, without which the back end contracts what it likes: pragmas alone.
    answers clang++ clang++-alone "$4" -funsafe-math-optimizations -ffp-contract=off
else
    echo "clang++ is not here: left out (Debian: apt-get install clang)"
    [ $status -ne 0 ] || exit 77
fi
exit $status
