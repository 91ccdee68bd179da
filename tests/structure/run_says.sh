# ./run says that it builds where something is built, and nothing where all is there. A cmake of this test stands for the real one.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/bin" "$work/build/release/bin"
cp "$1/run" "$1/CMakePresets.json" "$work"
touch "$work/build/release/build.ninja"
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

# The real one prints that line only where no folder is listed anew at each build.
cmake --preset release -S "$1" -B "$work/real" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
[ ! -f "$work/real/CMakeFiles/VerifyGlobs.cmake" ] || { echo "the preset release has a GLOB with CONFIGURE_DEPENDS"; exit 1; }
