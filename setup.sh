#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs the Debian packages that the project needs, and what the report's browser test needs from npm: ./setup.sh
# Looks first and does nothing where all are there, so it also works with the network off. Needs root or sudo only to
# install packages.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

packages=(
    # Building
    build-essential cmake ninja-build ccache pkg-config git python3
    # The source core: Vulkan with Mesa's software device, kernels compiled in process
    mesa-vulkan-drivers libvulkan-dev vulkan-validationlayers glslang-dev glslang-tools spirv-tools spirv-headers
    # The target core
    libembree-dev libtbb-dev
    # Scenes, pictures and the command line
    libglm-dev libtinygltf-dev libmeshoptimizer-dev libdraco-dev libtinyobjloader-dev
    libassimp-dev libopenimageio-dev libopenexr-dev libspng-dev libxxhash-dev libstb-dev libcli11-dev
    nlohmann-json3-dev libfmt-dev
    # The window, which is left out where these are not there
    libglfw3-dev libimgui-dev libgl1-mesa-dri
    # The tool
    libgit2-dev zlib1g-dev libtomlplusplus-dev libjemalloc-dev
    # Tests and style
    libgtest-dev libgmock-dev universal-ctags similarity-tester clang-format
    python3-jsonschema python3-yaml python3-numpy cmark-gfm python3-pyte xvfb xdotool
)

# What may also come from elsewhere than Debian.
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm)
command -v chromium >/dev/null || packages+=(chromium)

# What tests take from npm. A test that cannot run says so, so nothing depends on this.
install_from_npm() {
    local folder=$1 package=$2 test=$3
    if [ ! -f "$folder/package.json" ] || [ -f "$folder/node_modules/$package/package.json" ]; then return; fi
    if ! npm ci --prefix "$folder" --prefer-offline --fetch-retries=0 --ignore-scripts --no-audit --no-fund --loglevel=error >&2; then
        echo "setup: could not get $package; $test will be skipped" >&2
    fi
}
install_node_modules() {
    install_from_npm tests/report playwright-core "the browser test of the report"
    install_from_npm tests/porttool @microsoft/jest-sarif "the test of SARIF against the schema of OASIS"
}

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
    install_node_modules
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
install_node_modules
