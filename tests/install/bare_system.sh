# A bare Debian 12 in a folder of its own, for the scripts beside this one, which read it with `.` after they have set
# `name` (how they call themselves) and `root` (this repository).
#   bare_system [MIRROR]  makes it, as $system in $place, with a fresh clone of the repository in /barycert
#   inside COMMAND        runs a shell's command in that clone
#   timed WORDS... -- COMMAND...  runs it and says how long it took
# SUITE=trixie: Debian 13 instead. When the script ends, the system and the logs go, unless KEEP=1. SYSTEM=FOLDER takes a
# system that was kept, with what is built in it, and leaves it.

say() { printf '%s\n' "$name: $*"; }
die() { say "error: $*" >&2; exit 2; }

timed() {
    words=
    while [ "$1" != -- ]; do words="$words $1"; shift; done
    shift
    started=$(date +%s)
    "$@" || return
    say "$(($(date +%s) - started)) s:$words"
}

inside() {
    chroot "$system" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
        ${no_proxy:+no_proxy="$no_proxy"} /bin/sh -c "cd /barycert && $1"
}

bare_system() {
    [ "$(id -u)" = 0 ] || die "debootstrap and chroot need root"
    for tool in debootstrap git chroot mount; do
        command -v $tool >/dev/null || die "$tool is not installed"
    done
    mirror=${1-}
    suite=${SUITE-bookworm}
    if [ -z "$mirror" ] && command -v apt-get >/dev/null; then
        # An archive has all suites of its system.
        mirror=$(apt-get indextargets --format '$(RELEASE) $(SITE)' | awk '$1 == "bookworm" { print $2; exit }')
    fi
    [ -n "$mirror" ] || die "this machine's apt knows no archive of bookworm; name a mirror"
    [ -z "${SYSTEM-}" ] || [ -x "$SYSTEM/bin/sh" ] || die "SYSTEM=$SYSTEM is no system"

    place=$(mktemp -d)
    system=${SYSTEM:-$place/system}
    trap leave_bare_system EXIT
    trap 'exit 130' INT
    trap 'exit 143' TERM HUP

    say "mirror $mirror, suite $suite, commit $(git -C "$root" rev-parse --short HEAD)"
    [ -n "${SYSTEM-}" ] || make_bare_system "${1-}"
    mount --bind /dev "$system/dev"
    mount --make-private "$system/dev"  # else the next mount would show up in this machine's own /dev
    mount -t devpts devpts "$system/dev/pts"
    mount -t proc proc "$system/proc"
    mount -t sysfs -o ro sysfs "$system/sys"

    [ -d "$system/barycert" ] || git clone -q --no-hardlinks "$root" "$system/barycert"
    git -C "$system/barycert" fetch -q "$root" HEAD
    git -C "$system/barycert" checkout -q --force --detach FETCH_HEAD
}

make_bare_system() {
    timed debootstrap -- debootstrap --variant=minbase "$suite" "$system" "$mirror" >"$place/debootstrap.log" 2>&1 ||
        { tail -n 20 "$place/debootstrap.log" >&2; die "debootstrap failed"; }
    tail -n 1 "$place/debootstrap.log"
    # The bare system reaches the archive as this machine does: by its names, sources, proxies, certificates.
    share_with_system /etc/resolv.conf /etc/hosts /etc/ssl/certs/ca-certificates.crt /etc/apt/apt.conf
    if [ -z "$1" ] && [ "$suite" = bookworm ]; then
        # The mirror may be this machine's own mix of files; where none was named, take them as they are.
        rm -f "$system/etc/apt/sources.list"
        share_with_system /etc/apt/sources.list /etc/apt/sources.list.d /usr/share/keyrings /etc/apt/trusted.gpg.d
        share_with_system /etc/apt/keyrings
    fi
    share_with_system /etc/apt/apt.conf.d /etc/apt/auth.conf /etc/apt/auth.conf.d
}

share_with_system() {
    for from in "$@"; do
        [ -e "$from" ] || continue
        mkdir -p "$system$(dirname "$from")"
        cp -aL "$from" "$system$(dirname "$from")/"
    done
}

leave_bare_system() {
    status=$?
    trap - EXIT INT TERM HUP
    ! command -v unmount_more >/dev/null || unmount_more  # what a script mounted on top
    # What is still mounted below must not be removed with the rest: it is this machine's.
    for mounted in dev/pts dev proc sys; do
        ! mountpoint -q "$system/$mounted" || umount -l "$system/$mounted" || { say "still mounted: $system/$mounted"; exit 2; }
    done
    [ -n "${KEEP-}" ] || rm -rf --one-file-system "$place"
    [ ! -d "$system" ] || say "kept: $system"
    exit $status
}
