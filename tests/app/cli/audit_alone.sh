#!/bin/sh
# audit_alone.sh BARYCERT BARYCERT_AUDIT: both say the same of the catalogue, and find the same in an audit.
set -eu
ask() {
    "$1" families && "$1" kernels && "$1" help audit && "$1" audit --count 20 --quiet --sarif -
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ask "$1" >"$folder/whole"
ask "$2" >"$folder/alone"
cmp "$folder/whole" "$folder/alone"
