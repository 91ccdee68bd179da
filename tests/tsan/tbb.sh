#!/bin/sh
# tbb.sh DIR: oneTBB under ThreadSanitizer, installed into DIR, from the source of the Debian package that is installed.
#
# ThreadSanitizer sees only what is compiled for it. TBB hands work from thread to thread by atomic operations within libtbb: unseen,
# each of them looks like a race of the code that TBB calls. Source packages are listed apart, so that the system's own
# lists stay as they are.
set -eu
[ $# -eq 1 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
mkdir -p "$1"
place=$(cd "$1" && pwd)
version=$(dpkg-query -W -f '${source:Version}' libtbb-dev)
[ "$(cat "$place/version" 2>/dev/null)" != "$version" ] || exit 0

say() { printf '%s\n' "tbb.sh: $*" >&2; }
die() { say "error: $*"; exit 2; }

work=$place/work
rm -rf "$work"
mkdir -p "$work/lists/partial" "$work/parts"
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ ! -f "$list" ] || sed -n 's/^deb /deb-src /p' "$list" >>"$work/parts/sources.list"
done
for list in /etc/apt/sources.list.d/*.sources; do
    [ ! -f "$list" ] || sed 's/^Types:.*/Types: deb-src/' "$list" >"$work/parts/$(basename "$list")"
done
set -- -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$work/parts" -o Dir::State::lists="$work/lists"
cd "$work"
{ apt-get "$@" update && apt-get "$@" source --download-only onetbb="$version"; } >log 2>&1 ||
    { tail -n 20 log >&2; die "no source of onetbb $version"; }
say "building oneTBB $version under ThreadSanitizer"
{
    dpkg-source -x onetbb_*.dsc source &&
        cmake -G Ninja -S source -B build -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_INSTALL_PREFIX="$place" -DCMAKE_INSTALL_LIBDIR=lib \
            -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF &&
        cmake --build build && cmake --install build
} >>log 2>&1 || { tail -n 40 log >&2; die "oneTBB could not be built"; }
cd "$place"
rm -rf "$work"
echo "$version" >version
