#!/bin/sh
# -march and the like: every source that includes Highway compiles for a processor that has more than its targets ask
# for, and the exact core answers the same, whatever the least processor is.
#
# processors.sh SOURCE_DIR BUILD_DIR [PROCESSOR...]     x86-64-v2, -v3, -v4 and native unless given; 77 elsewhere
#
# The first two have all targets of Highway above the least processor. The others have the one of that processor: what is
# above it is compiled for by the first two.
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

# Every header that includes Highway, by way of others too, in sources that have it: what failed were these headers. By
# syntax alone. A source that brings no header which those before it have not is left out.
sapphire() {
    (cd "$source/src" && grep -oE 'include "(hwy/[a-z_/]+\.h|[a-z_/]+-inl\.hpp|core/foreach_target\.hpp)' \
        -r core mesh draw --include '*.cpp') | sort | awk -F: '
        { count[$1]++; of[$1, count[$1]] = $2; headers[$2] = 1 }
        END {
            for (;;) {
                best = ""; most = 0
                for (file in count) {
                    new = 0
                    for (i = 1; i <= count[file]; ++i) if (!(of[file, i] in seen)) ++new
                    if (new > most || (new == most && new > 0 && file < best)) { most = new; best = file }
                }
                if (most == 0) exit
                print best
                for (i = 1; i <= count[best]; ++i) seen[of[best, i]] = 1
            }
        }'
    # Highway without its targets, for what is inline in other headers.
    echo core/predicates.cpp
}
sources=$(sapphire)
[ "$(echo "$sources" | wc -l)" -ge 5 ] || { echo "FAULT: only these sources include Highway: $sources"; status=1; }
for file in $sources; do
    # shellcheck disable=SC2086
    g++ $flags -march=sapphirerapids $(core_includes "$source") -fsyntax-only "$source/src/$file" ||
        { echo "FAULT: $file does not compile with -march=sapphirerapids"; status=1; }
done

for processor in "$@"; do
    targets=
    case $processor in x86-64-v4 | native) targets=-DHWY_COMPILE_ONLY_STATIC ;; esac
    objects=
    for file in $(core_sources "$source" "$build"); do
        object=$build/$processor-$(basename "$file" .cpp).o
        rm -f "$object"
        # shellcheck disable=SC2086
        $launcher g++ $flags $targets -O1 -march="$processor" -DBARYCERT_VERSION='"x"' $(core_includes "$source") \
            -c "$file" -o "$object" &
        objects="$objects $object"
    done
    wait
    # shellcheck disable=SC2086
    g++ -pthread $objects -lhwy -o "$build/same_bytes-$processor" || { status=1; continue; }
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
