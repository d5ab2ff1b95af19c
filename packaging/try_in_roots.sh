#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# packaging/try_in_roots.sh [SUITE...]: tries the release archive where nothing else is installed.
# In a minimal root of each suite (bullseye, bookworm, jammy, noble) and in an empty one that holds the program and a
# repository alone (no shell, /etc/passwd, /proc or /tmp), as a user that nobody knows and without HOME, it runs what a
# gate runs and holds each exit code to what it must be. In the suites it then runs the steps of action.yml and of
# templates/porttool.yml on a clone of this repository, with the archive and with one that has a flipped bit. A maintainer runs it as root before a release; needs debootstrap
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
    shader '(0.25 + 0.25)' >"$root/trial/glsl/k.comp"
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

# steps NAME FILE: the shell steps of a gate (github, gitlab) as one script.
steps() {
    python3 - "$1" >"$2" <<'END'
import sys, yaml
if sys.argv[1] == "github":
    print("\n".join(step["run"] for step in yaml.safe_load(open("action.yml"))["runs"]["steps"])
          .replace("# got", "PORTTOOL_PROGRAM=$program"))
else:
    print("\n".join(list(yaml.safe_load_all(open("templates/porttool.yml")))[1]["port-drift"]["script"]))
END
}

# gate WANTED-EXIT SERVICE SHA256: runs the steps of a service in the root, on the clone in it.
gate() {
    local got=0
    steps "$2" "$root/gate/steps.sh"
    env -i PATH=/usr/bin:/bin PORTTOOL_ARCHIVE_URL="file:///gate/${archive##*/}" PORTTOOL_SHA256="$3" \
        PORTTOOL_DIRECTORY=. PORTTOOL_BASE=HEAD~1 PORTTOOL_FORMAT=github PORTTOOL_ARGS=--trusted-map \
        RUNNER_TEMP=/gate/temp PORTTOOL_TEMP=/gate/temp GITHUB_OUTPUT=/gate/temp/output GITHUB_PATH=/gate/temp/path \
        CI_PROJECT_DIR=/gate/clone "$(command -v chroot)" --userspec=12345:12345 "$root" \
        sh -e -c 'cd /gate/clone && . /gate/steps.sh' >"$work/out" 2>"$work/err" </dev/null || got=$?
    [ "$got" -eq "$1" ] || wrong "the steps for $2: exit $got, not $1"
}

try_gates() {
    name=$1 root=$2
    local start=$SECONDS sum
    sum=$(sha256sum <"$archive")
    rm -rf "$root/gate"
    mkdir -p "$root/gate/temp"
    git clone -q --no-local --depth 20 "file://$PWD" "$root/gate/clone"
    cp "$archive" "${archive%/*}/SHA256SUMS" "$root/gate"
    chown -R 12345:12345 "$root/gate"
    gate 0 github "${sum%% *}"
    local took=$((SECONDS - start))
    [ "$took" -lt 15 ] || wrong "the job took $took s from nothing to the verdict"
    gate 0 github ""
    gate 0 gitlab "${sum%% *}"
    [ -s "$root/gate/clone/gl-code-quality-report.json" ] || wrong "no report"
    python3 - "$root/gate/${archive##*/}" <<'END'
import sys
with open(sys.argv[1], "r+b") as file:
    file.seek(100_000)
    byte = file.read(1)[0]
    file.seek(100_000)
    file.write(bytes([byte ^ 1]))
END
    for sum in "${sum%% *}" ""; do
        for service in github gitlab; do
            gate 2 "$service" "$sum"
            grep -q 'is not what it should be and was not unpacked' "$work/err" || wrong "another reason than the bit"
        done
    done
    rm -rf "$root/gate"
    echo "$name: the steps of both services work, and refuse a flipped bit; from nothing to the verdict in $took s"
}

failed=0
mkdir -p "$work/empty"
(try_root empty "$work/empty") || failed=1
[ $# -gt 0 ] || set -- bullseye bookworm jammy noble
for suite; do
    if make_root "$suite"; then
        (try_root "$suite" "$roots/$suite" && try_gates "$suite" "$roots/$suite") || failed=1
    else
        echo "$suite: no root from the mirror, see $roots/$suite.log" >&2
        failed=1
    fi
done
exit $failed
