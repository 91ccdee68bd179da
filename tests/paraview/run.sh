#!/bin/sh
# All tests of the plug-in, where ParaView is: tests/install/paraview.sh runs this.
#   run.sh PROGRAMS PLUGIN FOLDER
# PROGRAMS: the folder with barycert; PLUGIN: Barycert.so; FOLDER: for files and pictures. Needs a screen: xvfb-run has one.
set -eu
programs=$1 plugin=$2 folder=$3
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
mkdir -p "$folder"

pvpython "$root/tests/paraview/plugin_test.py" "$programs/barycert" "$plugin" "$folder/plugin" 2>&1

PV_PLUGIN_PATH=$(dirname "$plugin") sh "$root/tests/documents/run_blocks.sh" doc/paraview.md "$root" "$programs" /nowhere "$folder/document" /nowhere

# The values of one process, with the mesh whole or in pieces, are those of several.
for processes in 1 2 3; do
    mpirun --allow-run-as-root --oversubscribe -n $processes pvbatch "$root/tests/paraview/processes.py" "$plugin" "$folder/values.csv" \
        >"$folder/processes" 2>&1 || { cat "$folder/processes"; exit 1; }
    grep "^$processes processes" "$folder/processes"
    [ $processes != 1 ] || first=$(sed -n 's/^1 processes: //p' "$folder/processes")
    [ "$(grep -c "^$processes processes.*: $first\$" "$folder/processes")" = 2 ] ||
        { cat "$folder/processes"; echo "values depend on the number of processes"; exit 1; }
done
