#!/bin/sh
# packages.sh SOURCES: README.md's "Install" names the packages of build_packages and mesh_packages in ./run, no other.
set -eu
cd "$1"
in_run=$(sed -n 's/^\(build\|mesh\)_packages="\([^"]*\)".*/\2/p' run | tr ' ' '\n' | sort)
in_readme=$(sed -n '/^sudo apt-get install/,/[^\\]$/p' README.md | tr -d '\\' | tr ' ' '\n' | grep -vx 'sudo\|apt-get\|install\|' | sort)
[ -n "$in_run" ]
[ "$in_run" = "$in_readme" ] || { printf './run installs:\n%s\nREADME.md:\n%s\n' "$in_run" "$in_readme"; exit 1; }
