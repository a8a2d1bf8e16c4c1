#!/usr/bin/env bash
# Installs what tools/packages.txt names and this machine lacks (Debian 12, as root or with sudo).
# With nothing missing it only asks dpkg, and takes well under a second.
set -euo pipefail
list=$(dirname "$0")/packages.txt

names=$(sed -n 's/^\([a-z0-9][a-z0-9.+-]*\) .*/\1/p' "$list")
if ! command -v apt-get >/dev/null; then
    echo "setup.sh: this machine has no apt-get; install what $list names in its own way" >&2
    exit 1
fi
# shellcheck disable=SC2086 # names are words
installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $names 2>/dev/null |
    sed -n 's/^installed //p' || true)
missing=$(comm -23 <(sort <<<"$names") <(sort <<<"$installed"))
if [ -z "$missing" ]; then
    echo "setup: all $(wc -w <<<"$names") packages are here"
    exit 0
fi

as_root=""
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "setup.sh: not root and no sudo; as root: apt-get install" $missing >&2
        exit 1
    fi
    as_root=sudo
fi
echo "setup: installing" $missing
apt() {
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 \
        -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 "$@"
}
apt update
# shellcheck disable=SC2086
apt install -y --no-install-recommends $missing >/dev/null
echo "setup: installed $(wc -w <<<"$missing") packages"
