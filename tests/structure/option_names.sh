#!/bin/sh
# option_names.sh SOURCES: messages of the library name members of jobs ("job.points"), which the command line shows as
# its options: no string of the libraries has the name of an option. Not looked at: comments, and commands to repeat that
# stand between ` and `. option_names.txt lists how many lines of a room or header may have one, and why.
set -eu
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd)
cd "$1/src"
find core files mesh io draw audit app/jobs app/report app/include \( -name '*.hpp' -o -name '*.cpp' -o -name '*.h' \) -exec awk '
    { line = $0; sub(/^[ \t]*\/\/.*/, "", line); gsub(/`[^`]*`/, "", line) }
    line ~ /"([^"\\]|\\.)*--[a-z]/ {
        n = split(FILENAME, part, "/"); print part[2] == "include" ? part[n] : part[1] == "app" ? part[2] : part[1] }' {} + | sort | uniq -c |
    awk -v table="$here/option_names.txt" '
        BEGIN { while ((getline line < table) > 0) if (line !~ /^#/ && split(line, word, " ") > 1) may[word[1]] = word[2] }
        $1 > may[$2] + 0 { print $2 ": lines that name options: " $1 ", allowed " may[$2] + 0; bad = 1 }
        { delete may[$2] }
        END { for (file in may) { print file ": in the table, and has none"; bad = 1 } exit bad }'
# Below jobs, callers in C++ and Python have no job whose members could be named.
if grep -rnE '"[^"]*\bjob\.[a-z_]+' core io mesh draw/raster; then
    echo "these messages name members of a job, and the caller may have none"
    exit 1
fi
