#!/bin/sh
# The promise of `./run`, kept or not: on a bare Debian 12 with nothing but its base system, a fresh clone audits and
# passes its tests, and samples VTK's files without VTK. Run by hand, as root, where debootstrap is installed; it needs about 5 GB in TMPDIR.
#   tests/install/bare-debian.sh [MIRROR]
# MIRROR: a Debian archive; the first that this machine's apt uses for bookworm if left out.
# STEPS="sample audit test" by default; each can be had alone. sample: a .vtu by VTK's writer goes in, a .vtu with values comes out, without VTK. KEEP=1 leaves the system for a look inside.
set -eu
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd)
steps=${STEPS-sample audit test}

say() { printf '%s\n' "bare-debian: $*"; }
die() { say "error: $*" >&2; exit 2; }

[ "$(id -u)" = 0 ] || die "debootstrap and chroot need root"
for tool in debootstrap git chroot mount; do
    command -v $tool >/dev/null || die "$tool is not installed"
done
mirror=${1-}
if [ -z "$mirror" ] && command -v apt-get >/dev/null; then
    mirror=$(apt-get indextargets --format '$(RELEASE) $(SITE)' | awk '$1 == "bookworm" { print $2; exit }')
fi
[ -n "$mirror" ] || die "this machine's apt knows no archive of bookworm; name a mirror"

place=$(mktemp -d)
system=$place/system
leave() {
    status=$?
    trap - EXIT INT TERM HUP
    # What is still mounted below must not be removed with the rest: it is this machine's.
    for mounted in dev/pts dev proc; do
        ! mountpoint -q "$system/$mounted" || umount -l "$system/$mounted" || { say "still mounted: $system/$mounted"; exit 2; }
    done
    if [ -n "${KEEP-}" ]; then say "kept: $system"; else rm -rf --one-file-system "$place"; fi
    exit $status
}
trap leave EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# timed WORDS... -- COMMAND...: runs it and says how long it took.
timed() {
    words=
    while [ "$1" != -- ]; do words="$words $1"; shift; done
    shift
    started=$(date +%s)
    "$@" || return
    say "$(($(date +%s) - started)) s:$words"
}

say "mirror $mirror, commit $(git -C "$root" rev-parse --short HEAD)"
timed debootstrap -- debootstrap --variant=minbase bookworm "$system" "$mirror" >"$place/debootstrap.log" 2>&1 ||
    { tail -n 20 "$place/debootstrap.log" >&2; die "debootstrap failed"; }
tail -n 1 "$place/debootstrap.log"

# What lets this machine reach the archive lets the bare one: names, sources, proxies, certificates.
share() {
    for from in "$@"; do
        [ -e "$from" ] || continue
        mkdir -p "$system$(dirname "$from")"
        cp -aL "$from" "$system$(dirname "$from")/"
    done
}
share /etc/resolv.conf /etc/hosts /etc/ssl/certs/ca-certificates.crt /etc/apt/apt.conf
if [ -z "${1-}" ]; then
    # The mirror may be this machine's own mix of files; where none was named, take them as they are.
    rm -f "$system/etc/apt/sources.list"
    share /etc/apt/sources.list /etc/apt/sources.list.d /usr/share/keyrings /etc/apt/trusted.gpg.d
    share /etc/apt/keyrings
fi
share /etc/apt/apt.conf.d /etc/apt/auth.conf /etc/apt/auth.conf.d
mount --bind /dev "$system/dev"
mount --make-private "$system/dev"  # else the next mount would show up in this machine's own /dev
mount -t devpts devpts "$system/dev/pts"
mount -t proc proc "$system/proc"

git clone -q --no-hardlinks "$root" "$system/barycert"

inside() {
    chroot "$system" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
        ${no_proxy:+no_proxy="$no_proxy"} /bin/sh -c "cd /barycert && $1"
}

for step in $steps; do
    words=$step
    [ $step != sample ] || words="barycert sample data/vtk/bracket.vtu --points data/meshes/bracket --output values.vtu"
    timed "./run $words" -- inside "./run $words" >"$place/$step.log" 2>&1 ||
        { tail -n 60 "$place/$step.log" >&2; die "./run $words failed"; }
    tail -n 1 "$place/$step.log"
    case $step in
        sample)
            ! inside "dpkg -s libvtk9-dev >/dev/null 2>&1" || die "VTK was installed"
            inside "./run barycert verify data/vtk/bracket.vtu --results values.vtu --exact" || die "values.vtu is not right"
            ;;
        audit)
            for file in audit.json witnesses.json; do
                [ -s "$system/barycert/$file" ] || die "./run audit left no $file"
            done
            # The reader of witnesses refuses what is not JSON, has another schema or lacks a member.
            inside "build/release/bin/barycert replay audit.json >/dev/null" || die "audit.json does not replay"
            say "audit.json: $(wc -c <"$system/barycert/audit.json") bytes, every witness reproduced"
            ;;
        test)
            grep -E 'tests passed|tests failed' "$place/test.log" || die "no verdict of ctest in its output"
            ;;
    esac
done
say "all of it holds"
