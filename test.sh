#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# ./test.sh         every test on the release build; then what reads foreign files, under ASan and UBSan
# ./test.sh --tsan  the threaded parts under TSan
# Installs what is missing and builds only what has changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

jobs=$(nproc)

# build PRESET [TARGET...]: configures at the first time only; the build does it again where it must.
build() {
    local preset=$1
    shift
    [ -f "build/$preset/build.ninja" ] || cmake --preset "$preset"
    cmake --build --preset "$preset" ${1:+--target "$@"}
}

./setup.sh
case "${1:-}" in
    "")
        build release
        ctest --preset release -j "$jobs"
        build dev sanitized_tests
        ctest --preset dev -j "$jobs" -L "sanitized|porttool"
        ;;
    --tsan)
        build tsan threaded_tests
        ctest --preset tsan -j "$jobs" -L threaded
        ;;
    *)
        echo "usage: ./test.sh [--tsan]" >&2
        exit 2
        ;;
esac
