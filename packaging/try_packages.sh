#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# packaging/try_packages.sh PACKAGE.deb...: installs each Debian package in a bare root of bookworm, with what it depends on
# and nothing else, runs its programs there as a user without a name, looks for man pages and completion, and removes it again.
# Needs root, debootstrap and a package mirror (DEBIAN_MIRROR names another); keeps the bare root in build/roots.
# Where podman or docker is there, the container of packaging/Containerfile is built and run, too.
set -euo pipefail
packages=()
for package in "$@"; do packages+=("$(realpath "$package")"); done
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [ $# -eq 0 ] || [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
    echo "try_packages: needs root, debootstrap and packages: cmake --build --preset porttool && cpack --preset porttool" >&2
    exit 2
fi
mirror=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Component: main' | head -n 1)}
bare=$PWD/build/roots/bookworm
if [ ! -f "$bare/.whole" ]; then
    rm -rf "$bare"
    mkdir -p "$(dirname "$bare")"
    debootstrap --variant=minbase bookworm "$bare" "$mirror" >"$bare.log" 2>&1
    touch "$bare/.whole"
fi

work=$(mktemp -d)
root=$work/root
trap 'rm -rf "$work"' EXIT
inside() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/nonexistent LC_ALL=C.UTF-8 chroot "$root" "$@"; }
# With /proc, as every system and container has it: pathtracer finds its modules and scenes beside itself. It is mounted
# for this command alone.
as_nobody() {
    env -i PATH=/usr/bin:/bin:/usr/sbin HOME=/nonexistent LC_ALL=C.UTF-8 ROOT="$root" unshare --mount sh -c \
        'mount -t proc proc "$ROOT/proc" && exec chroot --userspec=12345:12345 "$ROOT" "$@"' sh "$@"
}
wrong() { echo "try_packages: $name: $1" >&2; exit 1; }

for package in "${packages[@]}"; do
    name=$(dpkg-deb -f "$package" Package)
    rm -rf "$root"
    cp -a "$bare" "$root"
    cp "$package" "$root/tmp/package.deb"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    for file in /etc/apt/apt.conf.d/*proxy*; do [ ! -f "$file" ] || cp "$file" "$root/etc/apt/apt.conf.d/"; done
    inside apt-get update -qq
    inside apt-get install -qq -y --no-install-recommends /tmp/package.deb >"$work/log" 2>&1 || { tail -5 "$work/log" >&2; wrong "does not install"; }
    mkdir -p "$root/trial/gpu" "$root/trial/cpu"
    printf 'float scale(float x, float y) {\n    float sum = x * 2.5;\n    return sum + y;\n}\n' >"$root/trial/gpu/a.glsl"
    printf 'float scale(float x, float y) {\n    float sum = x * 2.5f;\n    return sum + y;\n}\n' >"$root/trial/cpu/a.cpp"
    chmod -R a+rwX "$root/trial"
    as_nobody porttool -C /trial init --source 'gpu/*' --target 'cpu/*' >/dev/null || wrong "init fails"
    as_nobody porttool -C /trial check >"$work/out" || wrong "check finds something"
    sed -i 's/2\.5/3.5/' "$root/trial/gpu/a.glsl"
    as_nobody porttool -C /trial check >"$work/out" && wrong "check misses an edit"
    grep -q source-changed "$work/out" || wrong "the finding is not there"
    dpkg-deb -c "$package" >"$work/list"
    for file in man/man1/porttool.1.gz man/man1/porttool-check.1.gz bash-completion/completions/porttool \
        zsh/vendor-completions/_porttool fish/vendor_completions.d/porttool.fish "doc/$name/copyright"; do
        # Bare roots of containers leave documentation out; what the package holds counts.
        grep -q "\./usr/share/$file\$" "$work/list" || wrong "/usr/share/$file is missing"
    done
    if [ "$name" != porttool ]; then
        as_nobody pathtracer render still_life --core target --size 64x36 --spp 2 -o /trial/a.png 2>"$work/err" ||
            { cat "$work/err" >&2; wrong "the target core does not render"; }
        [ -s "$root/trial/a.png" ] || wrong "no picture"
        # What reads and writes EXR is a module of its own, and the source core one that says why it cannot run here.
        as_nobody pathtracer render still_life --core target --size 64x36 --spp 2 -o /trial/a.exr 2>"$work/err" &&
            as_nobody pathtracer compare /trial/a.exr /trial/a.exr >"$work/out" 2>>"$work/err" ||
            { cat "$work/err" >&2; wrong "EXR does not work"; }
        as_nobody pathtracer info >"$work/out" 2>&1 || { cat "$work/out" >&2; wrong "info fails"; }
        for core in source target; do
            grep -q "pathtracer-core-$core.so" "$work/out" || { cat "$work/out" >&2; wrong "the $core core is not listed"; }
        done
    fi
    inside apt-get remove -qq -y "$name" >/dev/null 2>&1
    [ ! -e "$root/usr/bin/porttool" ] || wrong "stays when removed"
    echo "$name: installs, runs and goes; $(du -h "$package" | cut -f1) packed"
done
for engine in podman docker; do
    command -v "$engine" >/dev/null && "$engine" info >/dev/null 2>&1 || continue
    for package in "${packages[@]}"; do
        [ "$(dpkg-deb -f "$package" Package)" = porttool ] || continue
        "$engine" build -q -f packaging/Containerfile -t porttool-trial "$(dirname "$package")" >/dev/null
        "$engine" run --rm --network none -v "$PWD:/work:ro" porttool-trial check --strict
        echo "container: builds and checks this repository"
    done
    exit 0
done
echo "try_packages: neither podman nor docker runs here: packaging/Containerfile was not tried"
