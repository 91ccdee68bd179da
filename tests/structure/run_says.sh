# ./run says that it builds where something is built, and nothing where all is there. A cmake of this test stands for the real one.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/bin" "$work/build/release/bin"
cp "$1/run" "$1/CMakePresets.json" "$work"
touch "$work/build/release/build.ninja"
echo 'BARYCERT_SIMD:STRING=THIS' >"$work/build/release/CMakeCache.txt"
printf '#!/bin/sh\necho "answer $*"\n' >"$work/build/release/bin/barycert"
# Every package counts as installed.
printf '#!/bin/sh\necho "install ok installed"\n' >"$work/bin/dpkg-query"
printf '#!/bin/sh\ncase "$*" in *" -n") cat "%s" ;; esac\n' "$work/plan" >"$work/bin/cmake"
chmod +x "$work/bin/"* "$work/build/release/bin/barycert"
says() {
    PATH="$work/bin:$PATH" "$work/run" barycert --version 2>"$work/err" >"$work/out"
    [ "$(cat "$work/out")" = "answer --version" ] || { echo "no answer: $(cat "$work/out" "$work/err")"; exit 1; }
    cat "$work/err"
}
echo 'ninja: no work to do.' >"$work/plan"
[ -z "$(says)" ] || { echo "something is said where nothing is built: $(says)"; exit 1; }
echo '[1/2] Building CXX object a.o' >"$work/plan"
[ "$(says)" = "run: building (preset release)" ] || { echo "nothing is said of a build: $(says)"; exit 1; }

# Which program is built: a part of barycert that can do it, as long as there is no whole one.
rm "$work/build/release/bin/barycert"
for program in barycert barycert-audit barycert-check; do
    printf '#!/bin/sh\necho "%s"\n' $program >"$work/build/release/bin/$program"
    chmod +x "$work/build/release/bin/$program"
done
mkdir -p "$work/data/meshes" "$work/own"
touch "$work/data/meshes/a.node" "$work/own/a.node" "$work/own/a.vtu"
builds() {
    expected=$1
    shift
    rm -f "$work/build/release/bin/barycert"
    # It appears when it is built.
    printf '#!/bin/sh\ncase "$*" in *" -n") cat "%s" ;; *barycert_cli*) cp "%s" "%s" ;; esac\n' "$work/plan" \
        "$work/build/release/bin/barycert-whole" "$work/build/release/bin/barycert" >"$work/bin/cmake"
    printf '#!/bin/sh\necho barycert\n' >"$work/build/release/bin/barycert-whole"
    chmod +x "$work/build/release/bin/barycert-whole"
    found=$(cd "$work" && PATH="$work/bin:$PATH" ./run "$@" 2>"$work/err")
    [ "$found" = "$expected" ] || { echo "./run $*: $found, not $expected"; cat "$work/err"; exit 1; }
    [ "$expected" != barycert ] || grep -q "building all of barycert" "$work/err" || { echo "./run $* does not say why"; exit 1; }
}
builds barycert-audit audit --count 10
builds barycert-audit audit data/meshes/a --html a.html
builds barycert audit own/a
builds barycert-audit audit own/a --no-check
builds barycert audit own/a.vtu
builds barycert audit --surfaces
builds barycert-audit barycert gaps data/meshes/a
builds barycert barycert gaps own/a
builds barycert-check barycert check own/a
builds barycert-check barycert check own/a.node --json -
builds barycert barycert check own/a.vtu
builds barycert barycert check own/a --html a.html
builds barycert barycert check own/a --fix-orientation b

# The real one prints that line only where no folder is listed anew at each build.
cmake --preset release -S "$1" -B "$work/real" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
[ ! -f "$work/real/CMakeFiles/VerifyGlobs.cmake" ] || { echo "the preset release has a GLOB with CONFIGURE_DEPENDS"; exit 1; }
