#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# From a fresh clone to two pictures: installs what is missing, builds, renders the built-in scene on both cores, tells
# how much the pictures differ, whether the kernels drifted, and leaves everything in out/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

samples=6
./setup.sh
[ -f build/release/build.ninja ] || cmake --preset release
cmake --build --preset release --target pathtracer porttool

echo "Rendering scenes/still_life on the source core (Vulkan) and on the target core (Embree)"
build/release/bin/pathtracer compare still_life --size 640x360 --spp "$samples" --progress -o out

echo "Port drift of the project's own cores:"
drift=0
build/release/bin/porttool check || drift=$?
build/release/bin/porttool report --format html -o out/portability.html

echo "Written:"
for picture in source target difference; do
    echo "  out/${picture}_${samples}spp.png"
done
echo "  out/portability.html"
exit "$drift"
