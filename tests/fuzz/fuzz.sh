#!/bin/sh
# fuzz.sh BUILD SECONDS [TARGET...]: runs libFuzzer's executables in BUILD/fuzz, all of them or the ones named, one after the
# other, SECONDS in all, and prints the table of what has been done so far in BUILD.
#
# Each begins with what it found before (BUILD/fuzz/inputs/TARGET), what the builds beside BUILD found (with and without
# sanitizers: ../fuzz, ../fuzz-fast), corpus/TARGET and found/TARGET. What ends it is kept as
# BUILD/fuzz/findings/TARGET-*; then the exit code is 1. BUILD/fuzz/totals has a line a run: target, executions, seconds,
# coverage, edges. FUZZ_OPTIONS: further options of libFuzzer.
set -eu
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd)
programs=$1/fuzz
builds=$(dirname -- "$1")
seconds=$2
shift 2
[ $# -gt 0 ] || set -- $(cd "$programs" && ls fuzz_* | sed 's/^fuzz_//')
mkdir -p "$programs/inputs" "$programs/findings" "$programs/logs"

# Files of inputs are kept in memory where there is room, and gone at the end.
memory=/dev/shm
[ -w "$memory" ] || memory=${TMPDIR:-/tmp}
TMPDIR=$(mktemp -d "$memory/barycert-fuzz-XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
trap 'exit 130' INT TERM
# Memory that was given back is used again sooner than the runtime would have it: less of it to fault in. Allocations keep
# short stacks, and libFuzzer no statistics of rare features: together a third of the time.
export ASAN_OPTIONS="quarantine_size_mb=16:malloc_context_size=3:${ASAN_OPTIONS-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS-}"

dictionary_of() {
    case $1 in
        vtk_* | verify | mesh_file) echo vtk ;;
        tetgen | node) echo numbers ;;
        csv | fields) echo csv ;;
        baselines | others | scenes | witnesses) echo json ;;
        *) echo "$1" ;;
    esac
}

longest_of() {
    case $1 in
        meshes | nearest | weights | expressions | rules) echo 256 ;;
        *) echo 8192 ;;
    esac
}

table() {
    awk '{ n[$1] += $2; s[$1] += $3; c[$1] = $4; e[$1] = $5; all += $2; time += $3 }
         END {
             printf "%-16s %13s %8s %12s %17s\n", "target", "executions", "seconds", "executions/s", "edges covered"
             for (t in n) printf "%-16s %13d %8d %12.0f %9d of %5d\n", t, n[t], s[t], n[t] / (s[t] > 0 ? s[t] : 1), c[t], e[t] | "sort"
             close("sort")
             printf "%-16s %13d %8d\n", "all", all, time
         }' "$programs/totals"
}

found=0
each=$((seconds / $#))
[ "$each" -gt 0 ] || each=1
for target in "$@"; do
    [ -x "$programs/fuzz_$target" ] || { echo "fuzz.sh: no such target: $target" >&2; exit 2; }
    mkdir -p "$programs/inputs/$target"
    seeds=$here/corpus/$target
    [ ! -d "$here/found/$target" ] || seeds="$seeds $here/found/$target"
    for build in fuzz fuzz-fast; do
        more=$builds/$build/fuzz/inputs/$target
        [ ! -d "$more" ] || [ "$more" = "$programs/inputs/$target" ] || seeds="$seeds $more"
    done
    log=$programs/logs/$target.log
    dictionary=$here/dictionaries/$(dictionary_of "$target").dict
    [ -f "$dictionary" ] && dictionary=-dict=$dictionary || dictionary=
    "$programs/fuzz_$target" -max_total_time="$each" -timeout=10 -rss_limit_mb=2048 -max_len="$(longest_of "$target")" \
        -print_final_stats=1 -entropic=0 -artifact_prefix="$programs/findings/$target-" $dictionary ${FUZZ_OPTIONS-} \
        "$programs/inputs/$target" $seeds >"$log" 2>&1 || {
        found=1
        echo "fuzz.sh: $target has found something; the end of $log:" >&2
        grep -E '^fuzz: |runtime error|ERROR: |Test unit written' "$log" | tail -n 5 >&2
    }
    executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    coverage=$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$log" | tail -n 1)
    edges=$(sed -n 's/.*(\([0-9]*\) inline 8-bit counters).*/\1/p' "$log" | head -n 1)
    spent=$(sed -n 's/^Done [0-9]* runs in \([0-9]*\) second.*/\1/p' "$log")
    echo "$target ${executions:-0} ${spent:-$each} ${coverage:-0} ${edges:-0}" >>"$programs/totals"
    find "$TMPDIR" -mindepth 1 -delete
done
table
exit $found
