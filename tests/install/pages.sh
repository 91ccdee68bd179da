#!/bin/sh
# pages.sh PREFIX: the manual pages and completions of an installation are found where man and shells look.
set -eu
prefix=$1
for file in man/man1/barycert.1 man/man1/barycert-sample.1 bash-completion/completions/barycert \
    zsh/vendor-completions/_barycert fish/vendor_completions.d/barycert.fish; do
    [ -s "$prefix/share/$file" ] || { echo "$prefix/share/$file is missing"; exit 1; }
done
command -v man >/dev/null || { echo "man is not installed"; exit 77; }
MANPATH=$prefix/share/man MANWIDTH=80 man barycert-sample | grep -q -e --rounding
