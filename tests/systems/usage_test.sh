#!/bin/sh
# usage_test.sh LEAGUE: exit code 2, a message that helps, no table and no file where nothing can be asked.
league=$1
folder=$(mktemp -d) || exit 1
trap 'rm -r "$folder"' EXIT
failed=0

# refused TEXT ARGUMENTS...
refused() {
    text=$1
    shift
    "$league" "$@" --json "$folder/league.json" >"$folder/out" 2>"$folder/err"
    code=$?
    if [ $code -ne 2 ] || [ -s "$folder/out" ] || [ -e "$folder/league.json" ] || ! grep -qF -- "$text" "$folder/err"; then
        echo "league $*: code $code"
        cat "$folder/out" "$folder/err"
        failed=1
    fi
}

refused "no mesh is called 'nowhere'; there are: lattice; tenths;" --system barycert --mesh nowhere
refused "no system is called 'nobody'; there are: barycert;" --system barycert --system nobody
refused "no system has answered for any point" --system "matplotlib TrapezoidMapTriFinder" --mesh lattice
refused "Value 0 not in range" --count 0
refused "--counts" --counts 5
exit $failed
