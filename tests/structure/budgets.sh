#!/bin/sh
# budgets.sh SOURCES: no room has more lines than budgets.txt allows it, and there are no more public headers than it
# says. Every file counts, comments and blank lines too. A room without a line in the table is an error, so that a new
# room cannot come in unseen; so is a line without a room. --print prints the table as it is now.
set -eu
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd)
cd "$1/src"
lines() { find "$@" -type f ! -name '*.pyc' -exec cat {} + | wc -l; }
{
    for room in barycert/*/ */; do
        room=${room%/}
        [ "$room" = barycert ] || echo "$room $(lines "$room")"
    done
    echo "public $(cat barycert/*.hpp barycert/*.h | wc -l)"
    echo "headers $(ls barycert/*.hpp barycert/*.h | wc -l)"
    echo "src $(lines .)"
} >"${TMPDIR:-/tmp}/barycert-budgets.$$"
trap 'rm -f "${TMPDIR:-/tmp}/barycert-budgets.$$"' EXIT
[ "${2-}" != --print ] || { cat "${TMPDIR:-/tmp}/barycert-budgets.$$"; exit 0; }
awk 'NR == FNR { if ($0 !~ /^#/ && NF) budget[$1] = $2; next }
     !($1 in budget) { print $1 ": no budget"; bad = 1; next }
     $2 > budget[$1] { print $1 ": " $2 ", budget " budget[$1]; bad = 1 }
     { delete budget[$1] }
     END { for (room in budget) { print room ": in the table, not in src"; bad = 1 } exit bad }' \
    "$here/budgets.txt" "${TMPDIR:-/tmp}/barycert-budgets.$$"
