#!/bin/sh
# Jobs in which one rank goes wrong end by themselves, and soon, with an error.
#   ended.sh PROGRAM FOLDER LAUNCHER...    the launcher of 4 ranks
set -u
program=$1
folder=$2
shift 2
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder" || exit 1
failures=0
# job COMMAND...: sets `status`, `late` if it had to be ended, and `output` to what it printed
job() {
    started=$(date +%s)
    rm -f said-*
    timeout -k 5 120 "$@" >output 2>&1
    status=$?
    cat said-* >>output
    late=no
    [ $(($(date +%s) - started)) -lt 120 ] || late=yes
}
fails() {
    echo "FAILS: $*: exit code $status"
    tail -n 40 output
    failures=$((failures + 1))
}

job "$@" "$program" none 0
[ "$status" = 0 ] && [ "$(grep -c ': done, 20000 valid$' output)" = 4 ] || fails "nothing goes wrong"
for rank in 0 2; do
    job "$@" "$program" killed $rank
    [ "$status" != 0 ] && [ $late = no ] && ! grep -q ': done' output || fails "rank $rank killed"
    job "$@" "$program" broken $rank
    [ "$status" = 1 ] && [ "$(grep -c ': error, 0 valid$' output)" = 4 ] &&
        [ "$(grep -c "): rank $rank: what comes before this filter failed: vtkXMLUnstructuredGridReader" output)" = 4 ] || fails "file of rank $rank broken"
    job "$@" "$program" memory $rank
    [ "$status" = 1 ] && [ "$(grep -c ': error, 0 valid$' output)" = 4 ] &&
        [ "$(grep -c "): rank $rank: .*memory" output)" = 4 ] || fails "rank $rank without memory"
done
[ "$failures" = 0 ]
