#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs the Debian packages that the project needs: ./setup.sh
# Looks first and does nothing where all are there, so it also works with the network off. Needs root or sudo only to
# install.
set -euo pipefail

packages=(
    # Building
    build-essential cmake ninja-build ccache pkg-config git python3
    # The source core: Vulkan with Mesa's software device, kernels compiled in process
    mesa-vulkan-drivers libvulkan-dev vulkan-validationlayers glslang-dev glslang-tools spirv-tools spirv-headers
    # The target core
    libembree-dev libtbb-dev
    # Scenes, pictures and the command line
    libglm-dev libtinygltf-dev libopenimageio-dev libstb-dev libcli11-dev nlohmann-json3-dev libfmt-dev
    # The tool
    libgit2-dev libtomlplusplus-dev
    # Tests and style
    libgtest-dev libgmock-dev universal-ctags similarity-tester clang-format
)

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
    exit 0
fi

echo "setup: missing: ${missing[*]}" >&2
if ! command -v apt-get >/dev/null; then
    echo "setup: no apt-get here; install these packages, or what your system calls them, by hand" >&2
    exit 2
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "setup: neither root nor sudo; let somebody run: apt-get install ${missing[*]}" >&2
        exit 2
    fi
    as_root=(sudo)
fi

install() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
}

"${as_root[@]}" apt-get update -q || echo "setup: the package lists could not be renewed; trying with those here" >&2
if ! install; then
    echo "setup: could not install: ${missing[*]}; is the network on, and is this Debian 12 or later?" >&2
    exit 2
fi
