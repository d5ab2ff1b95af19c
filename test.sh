#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# ./test.sh         every test on the release build, and what reads foreign files once more under ASan and UBSan
# ./test.sh --tsan  the threaded parts under TSan
# Installs what is missing and builds only what has changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

jobs=$(nproc)

# configure PRESET [SETTING...]: where the build is not configured so yet; building does it again where it must.
configure() {
    local preset=$1 setting
    shift
    [ -f "build/$preset/build.ninja" ] || { cmake --preset "$preset" "${@/#/-D}" && return; }
    for setting in "$@"; do
        grep -q "^${setting/=/:BOOL=}\$" "build/$preset/CMakeCache.txt" || cmake --preset "$preset" "${@/#/-D}"
    done
}

# Tests make thousands of small repositories and throw them away: in memory that takes two thirds of the processor time
# that it takes on a disk. Not where /dev/shm is small or runs no programs, as in many containers.
keep_files_in_memory() {
    local room folder
    room=$(df --output=avail -BM /dev/shm 2>/dev/null | tr -dc 0-9) || return 0
    [ "${room:-0}" -ge 1024 ] || return 0
    folder=$(mktemp -d /dev/shm/t.XXXXXX)
    trap "rm -rf '$folder'" EXIT
    cp "$(type -P true)" "$folder/true"
    if "$folder/true" 2>/dev/null; then export TMPDIR=$folder; fi
}

# GCC asks for memory all the time: with jemalloc it compiles in a fifteenth less processor time.
build_release() {
    local memory
    memory=$(c++ -print-file-name=libjemalloc.so.2 2>/dev/null) || true
    [ ! -f "$memory" ] || local -x LD_PRELOAD="${LD_PRELOAD:+$LD_PRELOAD:}$memory"
    cmake --build --preset release --target all sanitized_tests
}

./setup.sh
case "${1:-}" in
    "")
        configure release PORTTOOL_SANITIZED_TESTS=ON
        build_release
        keep_files_in_memory
        # One more than there are processors: some tests wait, for a window, a page, an editor or a limit of time.
        ctest --preset release -j "$((jobs + 1))"
        ;;
    --tsan)
        configure tsan
        cmake --build --preset tsan --target threaded_tests
        ctest --preset tsan -j "$jobs" -L threaded
        ;;
    *)
        echo "usage: ./test.sh [--tsan]" >&2
        exit 2
        ;;
esac
