#!/bin/sh
# run_one.sh BARYCERT MODULE FINDING: compiles all programs of this folder, and runs one that needs the Python module. Exits
# with 77 if there is no python3 that has it.
set -eu
here=$(dirname "$0")
for python in python3 /usr/bin/python3; do
    if "$python" -c "import $2" 2>/dev/null; then
        for program in "$here"/*.py; do
            "$python" -c 'import ast, sys; ast.parse(open(sys.argv[1]).read(), sys.argv[1])' "$program"
        done
        exec "$python" "$here/run.py" --barycert "$1" "$3"
    fi
done
echo "no python3 has $2"
exit 77
