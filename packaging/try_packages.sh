#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# packaging/try_packages.sh PACKAGE.deb...: installs each Debian package in a bare root of bookworm, with what it depends on
# and nothing else, runs its programs there as a user without a name, asks man and the shells for what the command tables say,
# and removes it again. pathtracer-mpi comes with porttool-suite, which must be among the packages.
# Needs root, debootstrap and a package mirror (DEBIAN_MIRROR names another); keeps the bare root in build/roots.
# Where podman or docker is there, the container of packaging/Containerfile is built, upon that bare root, and run, too. Within
# another container that may want CONTAINER_ENGINE='podman --runtime runc' BUILDAH_ISOLATION=chroot
# CONTAINER_OPTIONS='--ulimit nofile=1024:1024 --ulimit nproc=1024:1024'.
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
name_of() { dpkg-deb -f "$1" Package; }
install() {
    inside apt-get install -qq -y --no-install-recommends "$@" >"$work/log" 2>&1 ||
        { tail -5 "$work/log" >&2; wrong "$* does not install"; }
}
says() { grep -q -- "$1" "$work/out" || { cat "$work/out" >&2; wrong "$2"; }; }

fresh_root() {
    rm -rf "$root"
    cp -a "$bare" "$root"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    for file in /etc/apt/apt.conf.d/*proxy*; do [ ! -f "$file" ] || cp "$file" "$root/etc/apt/apt.conf.d/"; done
    inside apt-get update -qq
    for one in "${packages[@]}"; do cp "$one" "$root/tmp/$(name_of "$one").deb"; done
}

# What the command tables say, as man and three shells show it.
try_manuals() {
    install man-db zsh fish
    as_nobody man -P cat porttool-check >"$work/out" 2>&1 || wrong "man finds no page"
    says 'merge-base(REV' "the page of check lacks --base"
    as_nobody bash -c '. /usr/share/bash-completion/completions/porttool
        COMP_WORDS=(porttool check --) COMP_CWORD=2; _porttool; printf "%s\n" "${COMPREPLY[@]}"' >"$work/out" || wrong "bash cannot read its completion"
    says '^--staged$' "bash does not offer check --staged"
    as_nobody fish -c 'complete -C "porttool che"; complete -C "porttool check --sta"' >"$work/out" 2>/dev/null || wrong "fish cannot read its completion"
    says '^check' "fish does not offer check"
    says '^--staged' "fish does not offer check --staged"
    as_nobody zsh -fc 'autoload -Uz compinit && compinit -u -D && print ${_comps[porttool]} && zsh -n /usr/share/zsh/vendor-completions/_porttool' \
        >"$work/out" || wrong "zsh cannot read its completion"
    says '^_porttool$' "zsh does not find the completion"
}

# Two ranks give the file of one process; the program alone says what is missing.
try_ranks() {
    fresh_root
    install /tmp/porttool-suite.deb
    as_nobody dpkg-query -W >"$work/out"
    ! grep openmpi "$work/out" >&2 || wrong "porttool-suite brings MPI along"
    install "/tmp/$name.deb"
    mkdir -m 777 "$root/trial"
    render() { as_nobody "${@:2}" pathtracer render still_life --core target --size 64x36 --spp 2 --threads 1 -o "/trial/$1.png" 2>"$work/err" ||
        { cat "$work/err" >&2; wrong "$1: does not render"; }; }
    render alone env
    render team mpirun --oversubscribe --bind-to none -n 2
    cmp "$root/trial/alone.png" "$root/trial/team.png" || wrong "two ranks give another file"
    grep -q pathtracer-mpi "$root/var/lib/dpkg/info/$name.list" || wrong "no program"
    echo "$name: two ranks render the file of one process; $(du -h "$package" | cut -f1) packed"
}

for package in "${packages[@]}"; do
    name=$(name_of "$package")
    [ "$name" != pathtracer-mpi ] || { try_ranks; continue; }
    fresh_root
    install "/tmp/$name.deb"
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
    try_manuals
    inside apt-get remove -qq -y "$name" >/dev/null 2>&1
    [ ! -e "$root/usr/bin/porttool" ] || wrong "stays when removed"
    echo "$name: installs, runs and goes; $(du -h "$package" | cut -f1) packed"
done
read -ra options <<<"${CONTAINER_OPTIONS:-}"
for name in "${CONTAINER_ENGINE:-podman}" docker; do
    read -ra engine <<<"$name"
    command -v "${engine[0]}" >/dev/null && "${engine[@]}" info >/dev/null 2>&1 || continue
    for package in "${packages[@]}"; do
        [ "$(name_of "$package")" = porttool ] || continue
        tar -C "$bare" -c . | "${engine[@]}" import -q - porttool-trial-base >/dev/null
        "${engine[@]}" build -q --network host --build-arg BASE=porttool-trial-base -f packaging/Containerfile -t porttool-trial \
            "$(dirname "$package")" >/dev/null 2>"$work/err" || { cat "$work/err" >&2; wrong "the container is not built"; }
        "${engine[@]}" run --rm --network none "${options[@]}" -v "$PWD:/work:ro" porttool-trial check --strict
        echo "container: builds and checks this repository"
    done
    exit 0
done
echo "try_packages: neither podman nor docker runs here: packaging/Containerfile was not tried"
