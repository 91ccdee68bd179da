#!/bin/sh
# Each library builds, passes its tests and is linked alone on a bare Debian 12, with the packages that the README.md of its folder
# names and no other. `./run alone`, as root, where debootstrap is installed; it needs about 4 GB in TMPDIR.
#   tests/install/alone.sh [FOLDER...]
# FOLDER: core, files, mesh, io, draw, audit or app; all if left out. What the README says is run as it stands. MIRROR: a Debian archive. A
# compiler's cache in the bare system keeps what several of them build.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
name=alone
. "$root/tests/install/bare_system.sh"
folders=${*:-core files mesh io draw audit app}
bare_system ${MIRROR-}
bare=$system

# What leave_bare_system calls before it takes the system away.
unmount_more() {
    [ "$system" != "$bare" ] || return 0
    umount -l "$system/root/.cache" "$system/sys" "$system/proc" "$system/dev" "$system" 2>/dev/null || true
    system=$bare
}

# commands_of FOLDER: the first block of its README.md, for a user who is root.
commands_of() {
    sed -n '/^```sh skip/,/^```$/p' "$root/src/$1/README.md" | sed '1d;/^```$/,$d' |
        sed 's/^sudo apt-get install \([^#]*\).*/DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \1/'
}

# linked FOLDER: a library of it, and a program that find_package gives that library.
linked() {
    case $1 in
        core) echo "core exact_values.cpp" ;;
        mesh) echo "sample arrays.cpp" ;;
        draw) echo "draw draw_scene.cpp" ;;
        audit) echo "audit oracle.cpp" ;;
        app) echo "report nothing.cpp" ;;
        *) echo "$1 nothing.cpp" ;;
    esac
}

inside "apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends ccache" >"$place/base.log" 2>&1 ||
    { tail -n 20 "$place/base.log" >&2; die "the bare system has no packages"; }
for folder in $folders; do
    # Each begins with the bare system: packages of others are not there.
    mkdir -p "$place/$folder/upper" "$place/$folder/work" "$place/$folder/system"
    mount -t overlay overlay -o "lowerdir=$bare,upperdir=$place/$folder/upper,workdir=$place/$folder/work" "$place/$folder/system"
    system=$place/$folder/system
    for part in dev proc sys root/.cache; do
        mkdir -p "$bare/$part" "$system/$part"
        mount --bind "$bare/$part" "$system/$part"
    done
    commands_of "$folder" >"$system/barycert/commands.sh"
    grep -q BARYCERT_LIBRARIES "$system/barycert/commands.sh" || die "src/$folder/README.md does not say how to build it alone"
    timed "$folder: built, tested, installed" -- inside "sh -ex commands.sh" >"$place/$folder.log" 2>&1 ||
        { tail -n 60 "$place/$folder.log" >&2; die "$folder does not stand alone"; }
    tail -n 1 "$place/$folder.log"
    set -- $(linked "$folder")
    inside "mkdir -p /part && cd /part && echo 'int main() {}' >nothing.cpp && cp /barycert/doc/examples/*.cpp . &&
        printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(part LANGUAGES CXX)' 'find_package(barycert CONFIG REQUIRED)' \
            'add_executable(part $2)' 'target_link_libraries(part PRIVATE barycert::$1)' >CMakeLists.txt &&
        cmake -G Ninja -B build -DCMAKE_PREFIX_PATH=/root/.local && cmake --build build && build/part" >"$place/$folder.log" 2>&1 ||
        { tail -n 40 "$place/$folder.log" >&2; die "$folder is not linked: $1, $2"; }
    say "$folder: linked by find_package"
    for part in root/.cache sys proc dev; do umount "$system/$part"; done
    umount "$system"
    system=$bare
    rm -rf "$place/$folder"
done
say "all of it holds"
