#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# packaging/try_in_roots.sh [SUITE...]: tries the release archive where nothing else is installed.
# In a minimal root of each suite (bullseye, bookworm, jammy, noble) and in an empty one that holds the program and a
# repository alone (no shell, /etc/passwd, /proc or /tmp), as a user that nobody knows and without HOME, it runs what a
# gate runs and holds each exit code to what it must be. A maintainer runs it as root before a release; needs debootstrap
# and the package mirrors, and keeps the roots in build/roots. DEBIAN_MIRROR and UBUNTU_MIRROR name other mirrors.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

debian=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Component: main' | head -n 1)}
ubuntu=${UBUNTU_MIRROR:-}
roots=$PWD/build/roots
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
archives=(build/static/release/porttool-*-linux-"$(uname -m)".tar.gz)
archive=$PWD/${archives[0]}
if [ ${#archives[@]} -gt 1 ]; then
    echo "try_in_roots: several archives in build/static/release; leave the one to try" >&2
    exit 2
fi
if [ ! -f "$archive" ] || [ "$(id -u)" -ne 0 ]; then
    echo "try_in_roots: needs root, and the archive first: cmake --workflow --preset static" >&2
    exit 2
fi

# make_root SUITE: bootstraps it unless it is there, its packages held to the keys of their makers.
make_root() {
    [ ! -f "$roots/$1/.whole" ] || return 0
    local from=("$debian") keys=/usr/share/keyrings/debian-archive-keyring.gpg
    case $1 in
        jammy | noble) from=("$ubuntu" gutsy) keys=${UBUNTU_KEYRING:-/usr/share/keyrings/ubuntu-archive-keyring.gpg} ;;
    esac
    if [ -z "${from[0]}" ] || [ ! -f "$keys" ]; then
        echo "$1: needs its mirror (DEBIAN_MIRROR, UBUNTU_MIRROR) and $keys (UBUNTU_KEYRING; the package ubuntu-keyring)" >&2
        return 1
    fi
    rm -rf "${roots:?}/$1"
    mkdir -p "$roots"
    debootstrap --variant=minbase --keyring="$keys" "$1" "$roots/$1" "${from[@]}" \
        >"$roots/$1.log" 2>&1 || return 1
    touch "$roots/$1/.whole"
}

git_there() { git -c safe.directory='*' -c user.name=trial -c user.email=trial@example.org -C "$root/trial" "$@"; }

# wrong WHAT: ends the trial of this root (`set -e` is off in what stands before `||`).
wrong() {
    echo "$name: $1" >&2
    cat "$work/out" "$work/err" >&2
    exit 1
}

# expect CODE ARGUMENT...: runs porttool inside the root, as a user without a name, and compares the exit code.
expect() {
    local wanted=$1 got=0
    shift
    env -i "$(command -v chroot)" --userspec=12345:12345 "$root" /porttool/bin/porttool "$@" -C /trial \
        >"$work/out" 2>"$work/err" </dev/null || got=$?
    [ "$got" -eq "$wanted" ] || wrong "porttool $*: exit $got, not $wanted"
}
output_has() { grep -q "$1" "$work/out" || wrong "the output lacks $1"; }

shader() {
    echo '#version 450'
    echo 'layout(set = 0, binding = 0) buffer B { float v[]; };'
    echo "float half_of(float x) { return x * $1; }"
    echo 'void main() { v[0] = half_of(v[0]); }'
}
kernel() { echo "__device__ float half_of(float x) { return x * $1; }"; }
hand_over() { chown -R 12345:12345 "$root/trial"; }

try_root() {
    name=$1 root=$2
    rm -rf "$root/porttool" "$root/trial"
    mkdir -p "$root/porttool" "$root/trial/cuda" "$root/trial/glsl"
    tar -xzf "$archive" -C "$root/porttool" --strip-components=1
    kernel 0.5f >"$root/trial/cuda/k.cu"
    shader 0.5 >"$root/trial/glsl/k.comp"
    git_there init -q -b main
    hand_over
    expect 0 scan cuda glsl --format json
    output_has '"cuda/k.cu:half_of"'
    expect 0 compare cuda/k.cu glsl/k.comp
    expect 0 map --source 'cuda/*' --target 'glsl/*'
    expect 0 init --source 'cuda/*' --target 'glsl/*'
    expect 0 check --strict
    git_there add -A
    git_there commit -qm start
    hand_over
    shader '(0.5)' >"$root/trial/glsl/k.comp"
    expect 1 check --strict
    expect 0 check --strict --spirv
    shader 0.5 >"$root/trial/glsl/k.comp"
    kernel 0.25f >"$root/trial/cuda/k.cu"
    expect 1 check --format json
    output_has '"rule": *"source-changed"'
    expect 1 check --base HEAD --format sarif
    expect 0 explain cuda/k.cu:half_of
    shader 0.25 >"$root/trial/glsl/k.comp"
    expect 0 check --base HEAD
    expect 0 accept --all
    expect 0 check --strict
    git_there commit -qam both
    hand_over
    expect 0 check --base HEAD~1
    expect 0 report --format json
    expect 0 report --format html -o page.html
    expect 0 history --format json
    output_has "$(git_there rev-parse HEAD~1)"
    output_has "$(git_there rev-parse HEAD)"
    expect 2 check --base no-such-revision
    rm -rf "$root/porttool" "$root/trial"
    echo "$name: works"
}

failed=0
mkdir -p "$work/empty"
(try_root empty "$work/empty") || failed=1
[ $# -gt 0 ] || set -- bullseye bookworm jammy noble
for suite; do
    if make_root "$suite"; then
        (try_root "$suite" "$roots/$suite") || failed=1
    else
        echo "$suite: no root from the mirror, see $roots/$suite.log" >&2
        failed=1
    fi
done
exit $failed
