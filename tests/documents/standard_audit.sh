#!/bin/sh
# Does what `./run audit` does, once for all documents that show it: standard_audit.sh PROGRAMS FOLDER
#
# FOLDER is replaced: audit.html, audit.json, witnesses.json; printed, what the command prints, stdout and stderr together;
# exit, its exit code.
set -eu
programs=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
BARYCERT_COMMAND="./run barycert"
export BARYCERT_COMMAND
code=0
"$programs/barycert" audit --html audit.html --json audit.json --witnesses witnesses.json >printed 2>&1 </dev/null || code=$?
echo "$code" >exit
cat printed
exit "$code"
