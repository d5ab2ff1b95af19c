#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# tests/porttool/fuzz.sh [--runs N] [--seed FIRST] [KIND...]: the long run of the fuzzers under ASan and UBSan.
# 100,000 inputs of each of the kinds source, map, lock and base, unless told otherwise. Each follows from its seed
# alone: what a run that was ended said last (`next seed N`) is where `--seed N` goes on. A failure prints its seed and
# leaves its files in build/fuzz-failures/KIND-SEED.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

runs=100000
seed=0
kinds=()
while [ $# -gt 0 ]; do
    case $1 in
        --runs) runs=${2:?a number after --runs} && shift 2 ;;
        --seed) seed=${2:?a number after --seed} && shift 2 ;;
        source | map | lock | base) kinds+=("$1") && shift ;;
        *)
            echo "usage: tests/porttool/fuzz.sh [--runs N] [--seed FIRST] [source|map|lock|base]..." >&2
            exit 2
            ;;
    esac
done
[ ${#kinds[@]} -gt 0 ] || kinds=(source map lock base)

# The objects of the test run, but optimised: compiling them pays for itself within the first minutes.
[ -f build/fuzz/build.ninja ] ||
    cmake --preset release -B build/fuzz -DPORTTOOL_SANITIZED_TESTS=ON -DPORTTOOL_SANITIZED_LEVEL=-O2 -DPORTTOOL_WITH_RENDERER=OFF
cmake --build build/fuzz --target porttool_fuzz_sanitized
# Where each of a million blocks was allocated need not be noted: the seed that failed is run again.
export ASAN_OPTIONS=hard_rss_limit_mb=4096:detect_stack_use_after_return=0:malloc_context_size=1:quarantine_size_mb=64:${ASAN_OPTIONS:-}
# One kind on each processor; xargs ends with an error where one of them did.
printf '%s\n' "${kinds[@]}" | xargs -P "$(nproc)" -I KIND \
    build/fuzz/bin/sanitized/porttool_fuzz KIND --seed "$seed" --runs "$runs" --save build/fuzz-failures
