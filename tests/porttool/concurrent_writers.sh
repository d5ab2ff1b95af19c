#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
#
# tests/porttool/concurrent_writers.sh [ROUNDS [PORTTOOL]]: the long run of AcceptancesAtOnceAreAllKept. In each round
# two to eight processes accept a pair each at once; one is killed now and then. No acceptance may be lost.
set -euo pipefail
rounds=${1:-500}
porttool=$(realpath "${2:-$(dirname "${BASH_SOURCE[0]}")/../../build/release/bin/porttool}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir gpu cpu

# side FOLDER NUMBER: eight functions with that number in them.
side() {
    for i in 0 1 2 3 4 5 6 7; do
        printf 'float work_%d(float x) {\n    float y = x + %d.5f;\n    return y * %d.0f;\n}\n' "$i" "$i" "$2"
    done > "$1"
}
side gpu/a.cu 1
side cpu/a.cpp 1
"$porttool" init --source 'gpu/*' --target 'cpu/*' > /dev/null

for round in $(seq "$rounds"); do
    side gpu/a.cu $((round + 1))
    side cpu/a.cpp $((round + 1))
    writers=$((2 + round % 7))
    if [ $((round % 10)) -eq 0 ]; then # a writer that does not come to its end, and holds what it holds
        "$porttool" accept --all > /dev/null &
        victim=$!
        sleep "0.00$((RANDOM % 9))"
        kill -9 "$victim" 2> /dev/null || true
        wait "$victim" 2> /dev/null || true
    fi
    pids=()
    for ((i = 0; i < writers; ++i)); do
        "$porttool" accept "gpu/a.cu:work_$i" --reason "round $round" > /dev/null &
        pids+=($!)
    done
    for pid in "${pids[@]}"; do wait "$pid" || { echo "round $round: a writer failed" >&2; exit 1; }; done
    for ((i = 0; i < writers; ++i)); do
        grep -q "accept	gpu/a.cu:work_$i	.*	round $round\$" portmap.lock || { echo "round $round: lost work_$i" >&2; exit 1; }
    done
    [ ! -e portmap.lock.busy ] || { echo "round $round: portmap.lock.busy is left" >&2; exit 1; }
done
"$porttool" accept --all > /dev/null
"$porttool" check
echo "$rounds rounds, nothing lost"
