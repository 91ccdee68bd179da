#!/bin/sh
# Runs what a document shows: every command of its ```sh blocks, in the order of the document, in a copy of the sources.
#
#   run_blocks.sh DOCUMENT SOURCES PROGRAMS EXAMPLES FOLDER AUDIT
#
# DOCUMENT   relative to SOURCES, such as doc/audit.md
# PROGRAMS   the folder with barycert and, if it was built, barycert-tetgen; `./run` in the copy calls them
# EXAMPLES   the folder with the programs built from doc/examples
# FOLDER     is replaced: holds the copy and what the commands print
# AUDIT      the folder of standard_audit.sh: what `./run audit` writes and prints, which takes long, made once for all
#
# Rules of a document:
# - A command must exit with 0, or with N if its line ends in `# exits N`.
# - A ```text block right after a ```sh block is what its commands print, stdout and stderr together. A line `...` stands
#   for any number of lines, and ` ...` at the end of a line for the rest of it. Seconds, counts of threads and the last
#   column of the table of kernels (nanoseconds) may be any.
# - Each paragraph of a ```c or ```cpp block stands in one program of doc/examples, in the same order. The program must
#   exit with 0; a ```text block right after the block is what it prints.
# - Relative links lead to files that exist.
#
# With UPDATE=1 in the environment a ```text block that differs, and leaves nothing out, is replaced by what is printed.
# - Commands that install packages, build or take long are in `not_run` below, and nowhere else.
set -eu
document=$1 sources=$2 programs=$3 examples=$4 folder=$5 audit=$6

not_run() {
    case $1 in
        "./run test"* | *" ./run test"* | "./run bench"* | "./run asan"* | "./run tsan"* | "./run pages"* | "./run lint"* | "./run flags"* | "./run package"* | "./run fuzz"*) why="takes minutes" ;;
        "./run findings"* | "./run systems"* | "./run libraries"*) why="needs other systems" ;;
        "./run python"* | "python3 -m venv "*) why="needs the package for Python; tests/python does that" ;;
        "sudo "* | "apt-get "*) why="installs packages" ;;
        "g++ "*"pkg-config"*) why="needs an installation; tests/install does that" ;;
        *"tests/install/"*) why="needs root and an archive of Debian" ;;
        "cmake "* | "git clone "* | "cd "*) why="builds; tests/install does that" ;;
        "mpirun "*)
            [ ! -x "$examples/example_mpi_probe" ] || return 1
            why="this build has no example with MPI"
            ;;
        "pvpython "*)
            ! command -v pvpython >/dev/null || return 1
            why="needs ParaView; tests/install/paraview.sh does that"
            ;;
        "./run barycert mesh "*)
            [ ! -x "$programs/barycert-tetgen" ] || return 1
            why="this build has no barycert-tetgen"
            ;;
        *) return 1 ;;
    esac
}

rm -rf "$folder"
mkdir -p "$folder/copy" "$folder/blocks"
for part in data doc src; do cp -R "$sources/$part" "$folder/copy/$part"; done
cat >"$folder/copy/run" <<EOF
#!/bin/sh
# Stands in for ./run, without its packages and its build.
BARYCERT_COMMAND="./run barycert"
export BARYCERT_COMMAND
command=\$1
shift
case \$command:\${1-} in
    audit:) cp "$audit/audit.html" "$audit/audit.json" "$audit/witnesses.json" . && cat "$audit/printed" && exit \$(cat "$audit/exit") ;;
    audit:*) exec "$programs/barycert" audit "\$@" ;;
    barycert:mesh) shift; exec "$programs/barycert-tetgen" "\$@" ;;
    barycert:*) exec "$programs/barycert" "\$@" ;;
    *) echo "no such command: ./run \$command" >&2; exit 2 ;;
esac
EOF
chmod +x "$folder/copy/run"

[ ! -x "$examples/example_mpi_probe" ] || ln -s "$examples/example_mpi_probe" "$folder/copy/mpi_probe"

# Blocks as files NNN.LANGUAGE; NNN.follows where nothing but blank lines stands between a block and the one before it.
# Commands that go over several lines are joined.
awk -v folder="$folder/blocks" '
    /^```/ && !inside {
        inside = 1; language = substr($0, 4); if (language == "") language = "none"
        file = sprintf("%s/%03d.%s", folder, ++count, language)
        printf "" > file
        if (adjacent) { follows = sprintf("%s/%03d.follows", folder, count); print "" > follows; close(follows) }
        next
    }
    /^```/ { inside = 0; adjacent = 1; close(file); next }
    inside && language == "sh" && /\\$/ { printf "%s ", substr($0, 1, length($0) - 1) > file; next }
    inside { print > file; next }
    NF { adjacent = 0 }
' "$sources/$document"

# Replaces what differs from run to run, in `expected` and `printed` alike.
settled() {
    sed -E -e 's/[0-9][0-9.e+-]* s([ ,;:]|$)/# s\1/g' -e 's/[0-9]+ threads?/# threads/g' \
        -e '/^(segment|triangle|triangle3d|tetrahedron)\.[^ :]+ .* [0-9.e+-]+$/s/ +[^ ]+$/ #/' -e 's/ +$//' "$1"
}

# compare EXPECTED PRINTED
compare() {
    settled "$1" >"$folder/expected"
    settled "$2" >"$folder/printed"
    awk -v printed="$folder/printed" '
        function same(want, have) {
            if (want ~ / \.\.\.$/) { want = substr(want, 1, length(want) - 4); have = substr(have, 1, length(want)) }
            return want == have
        }
        BEGIN { while ((getline line < printed) > 0) have[++last] = line; next_line = 1 }
        $0 == "..." { skip = 1; next }
        {
            at = next_line
            while (skip && at <= last && !same($0, have[at])) ++at
            if (at > last || !same($0, have[at])) {
                print "the document has: " $0
                print "the program has:  " (next_line > last ? "(nothing more)" : have[next_line])
                failed = 1; exit 1
            }
            next_line = at + 1; skip = 0
        }
        END { if (!failed && !skip && next_line <= last) { print "the program goes on: " have[next_line]; exit 1 } }
    ' "$folder/expected"
}

failures=0
fails() {
    echo "FAILS: $document: $*"
    failures=$((failures + 1))
}

output=$folder/output
printed=no
run_commands() {
    : >"$output"
    printed=yes
    while IFS= read -r line || [ -n "$line" ]; do
        case $line in "" | "#"*) continue ;; esac
        expected=0
        case $line in *"# exits "*) expected=${line##*"# exits "} ;; esac
        command=$(printf '%s\n' "$line" | sed -E 's/ +# .*$//')
        if not_run "$command"; then
            echo "not run ($why): $command"
            printed=no
            continue
        fi
        printf "%s\n" "$command"
        status=0
        (cd "$folder/copy" && sh -c "$command") >"$folder/one" 2>&1 </dev/null || status=$?
        cat "$folder/one" >>"$output"
        if [ "$status" != "$expected" ]; then
            fails "exit code $status, not $expected: $command"
            tail -n 20 "$folder/one"
        fi
    done <"$1"
}

# The example that has every paragraph of a block, in order.
example_with() {
    for example in "$sources"/doc/examples/*.c "$sources"/doc/examples/*.cpp; do
        if awk '
            { gsub(/^[ \t]+|[ \t]+$/, "") }
            FNR == NR { text = text $0 "\n"; next }
            function look() {
                if (paragraph == "") return
                at = index(text, paragraph)
                if (!at) { missing = 1; exit 1 }
                text = substr(text, at + length(paragraph)); paragraph = ""
            }
            $0 == "" { look(); next }
            { paragraph = paragraph $0 "\n" }
            END { if (!missing) look(); exit missing }
        ' "$example" "$1"; then
            basename "${example%.*}"
            return 0
        fi
    done
    return 1
}

for block in "$folder"/blocks/*; do
    number=$(basename "$block" | cut -c1-3)
    case $block in
        *.sh) run_commands "$block" ;;
        *.c | *.cpp)
            printed=no
            if ! example=$(example_with "$block"); then
                fails "no program in doc/examples has this block:"
                cat "$block"
            elif [ -x "$examples/example_$example" ]; then
                echo "doc/examples/$example.cpp"
                printed=yes
                (cd "$folder/copy" && "$examples/example_$example") >"$output" 2>&1 || fails "$example exits with $?"
            fi
            ;;
        *.text)
            if [ -e "$folder/blocks/$number.follows" ] && [ "$printed" = yes ]; then
                cp "$output" "$folder/blocks/$number.printed"
                if ! compare "$block" "$output"; then
                    fails "not what the block above it prints (block $number)"
                    grep -q '\.\.\.$' "$block" || : >"$folder/blocks/$number.update"
                fi
            fi
            printed=no
            ;;
        *.follows | *.printed | *.update) ;;
        *) printed=no ;;
    esac
done
for link in $(awk '/^```/ { code = !code } !code' "$sources/$document" | grep -oE '(\]\(|src=")[^)"#: ]+' | sed -E 's/^(\]\(|src=")//'); do
    [ "$link" = https ] || [ -e "$(dirname "$sources/$document")/$link" ] || fails "no such file: $link"
done
if [ "${UPDATE:-0}" = 1 ]; then
    awk -v folder="$folder/blocks" '
        /^```/ && !inside { inside = 1; file = sprintf("%s/%03d", folder, ++count); updated = (getline line < (file ".update")) >= 0
                            print; if (updated) while ((getline line < (file ".printed")) > 0) print line; next }
        /^```/ { inside = 0 }
        !(inside && updated)
    ' "$sources/$document" >"$folder/updated" && cp "$folder/updated" "$sources/$document"
fi
[ "$failures" = 0 ] || { echo "$failures failures"; exit 1; }
