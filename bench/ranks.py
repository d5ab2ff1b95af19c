#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Where the time of a team of ranks goes, and what binds first when there are many.

    bench/ranks.py PATHTRACER SCENE [--camera FILE] [--size WxH] [--spp N] [--repeats N] [--mca "NAME VALUE"...] [--keep FILE]
        [--slow FACTOR]
    bench/ranks.py --simulate FILE [--ranks 1,4,16,...] [--bandwidth MB_S] [--latency US] [--round S] [--slow FACTOR]

The first takes, in turn, one rank of two threads and two ranks of one thread, of the target core. Of both it tells the
time of the frame after loading, as the program says it, and the processor time (user and system, of all processes;
that of a run of one sample, which loads as much, is taken off); of the ranks also how long they were at samples, between
those of two tiles (the counter, the sums that come and go) and waiting at the ends of rounds. With --slow rank 1 gets one
part in FACTOR of the other's processor time, and what the other waited for it at the ends of rounds is told. --keep writes down where in the picture
the time goes, for the second, which renders 3840x2160 with ranks of one thread each, in rounds, with the tiles of
application/cluster/mpi_team.cpp, whose sums go through the one link of rank 0.
"""
import argparse
import heapq
import json
import math
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time

BYTES_PER_PIXEL = 48        # of a PixelSum
SMALL_TILE_COST = 1.10      # time a path in tiles of 256 paths, where 1 is that in tiles of 2,048


def finished(command, environment=None):
    """Seconds of the frame and of processors, and what was said."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=environment)
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(command)}: {said}")
    return float(re.search(r"([0-9.]+) s\n", said).group(1)), usage.ru_utime + usage.ru_stime


def read_tiles(folder, ranks):
    """Of each rank, its tiles: round, first pixel, pixels, and when it was given, asked for its sums, had its samples, was done."""
    files = [pathlib.Path(folder) / f"tiles.{rank}" for rank in range(ranks)]
    return [[tuple(map(float, line.split())) for line in file.read_text().splitlines()] for file in files]


def shares(tiles):
    """Seconds of all ranks at samples, at what lies between two tiles' samples, and waiting at a round's end."""
    at_samples = between = at_ends = 0.0
    for number in {tile[0] for of in tiles for tile in of}:
        mine = [[tile for tile in of if tile[0] == number] for of in tiles]
        begin, end = min(of[0][3] for of in mine if of), max(of[-1][6] for of in mine if of)
        for of in mine:
            work = sum(tile[5] - tile[4] for tile in of)
            last = of[-1][6] if of else begin
            at_samples, at_ends, between = at_samples + work, at_ends + end - last, between + last - begin - work
    return at_samples, between, at_ends


def cost_map(tiles, pixels, cells=512):
    """Relative cost of a pixel along the picture, row by row: mean 1."""
    cost, weight = [0.0] * cells, [0.0] * cells
    for _, first, count, _, begin, end, _ in (tile for of in tiles for tile in of):
        for cell in range(int(first * cells / pixels), min(cells, math.ceil((first + count) * cells / pixels))):
            overlap = min(first + count, (cell + 1) * pixels / cells) - max(first, cell * pixels / cells)
            cost[cell] += (end - begin) * overlap / count
            weight[cell] += overlap
    known = [c / w if w else 0.0 for c, w in zip(cost, weight)]
    mean = sum(known) / cells
    return [value / mean for value in known]


def on_processors(process):
    """Nanoseconds that all threads of a process have had."""
    return sum(int(file.read_text().split()[0]) for file in pathlib.Path(f"/proc/{process}/task").glob("*/schedstat"))


def slowed(command, environment, factor, folder):
    """Runs two ranks. Once both have a tile the second is stopped whenever it has had more than one part in `factor` of the
    processor time of the first."""
    first_tile = pathlib.Path(folder) / "tiles.1"
    first_tile.unlink(missing_ok=True)
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
    while process.poll() is None and not (first_tile.exists() and first_tile.stat().st_size):
        time.sleep(0.01)
    first, second = sorted(map(int, subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True).stdout.split()))
    try:
        began = on_processors(first), on_processors(second)
        last, moved = 0, time.monotonic()
        while process.poll() is None:
            now = on_processors(first) - began[0]
            if now > last:
                last, moved = now, time.monotonic()
            waits = time.monotonic() > moved + 0.5  # as at the very end
            ahead = (on_processors(second) - began[1]) * factor > now
            os.kill(second, signal.SIGSTOP if ahead and not waits else signal.SIGCONT)
            time.sleep(0.002)
    except (ProcessLookupError, FileNotFoundError):
        pass
    if process.wait() != 0:
        sys.exit(f"{' '.join(command)}: ended with {process.returncode}")
    fast, slow = read_tiles(folder, 2)
    waited = longest = span = 0.0
    rounds = sorted({tile[0] for tile in fast + slow})
    for number in rounds:
        mine, others = ([tile for tile in of if tile[0] == number] for of in (fast, slow))
        if mine and others:
            wait = max(0.0, others[-1][6] - mine[-1][6])
            waited, longest = waited + wait, max(longest, wait - (others[-1][6] - others[-1][3]))
            span += max(mine[-1][6], others[-1][6]) - min(mine[0][3], others[0][3])
    print(f"rank 1 slower by {factor:g}: it took {sum(t[2] for t in slow) / sum(t[2] for t in fast + slow):.1%} of the pixels; in "
          f"{len(rounds)} rounds the other waited {waited:.2f} s of {span:.2f} s for it at the end, never more than its last tile took "
          f"and {max(0.0, longest) * 1e3:.0f} ms")


def measure(options):
    width, height = map(int, options.size.split("x"))
    program = os.path.abspath(options.pathtracer)
    camera = ["--camera", options.camera] if options.camera else []
    mpirun = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none"]
    for setting in options.mca:
        mpirun += ["--mca", *setting.split()]
    with tempfile.TemporaryDirectory() as folder:
        render = [program, "render", options.scene, *camera, "--core", "target", "--size", options.size, "-o", folder + "/a.exr"]
        ways = {"1 rank of 2 threads": [*render, "--threads", "2"],
                "2 ranks of 1 thread": [*mpirun, "-n", "2", *render, "--threads", "1"]}
        environment = {**os.environ, "PATHTRACER_TILE_TIMES": folder + "/tiles"}
        found = {way: [] for way in ways}
        waits = []
        for _ in range(options.repeats):
            for way, command in ways.items():
                loading = finished([*command, "--spp", "1"])
                seconds, processors = finished([*command, "--spp", str(1 + options.spp)], environment)
                found[way].append((seconds - loading[0], processors - loading[1]))
            tiles = read_tiles(folder, 2)
            waits.append(shares(tiles))
        for way, values in found.items():
            frame, processors = zip(*values)
            print(f"{way}: frame {min(frame):.2f} s at least, {statistics.median(frame):.2f} s in the middle; processors "
                  f"{min(processors):.2f} s, {statistics.median(processors):.2f} s")
        one, two = found.values()
        for name, pick in (("least", min), ("middle", statistics.median)):
            ratios = [pick(v[i] for v in one) / pick(v[i] for v in two) for i in (0, 1)]
            print(f"two ranks reach, by the {name}: {ratios[0]:.3f} in frame time, {ratios[1]:.3f} in processor time")
        at_samples, between, at_ends = (sum(w[i] for w in waits) for i in range(3))
        all_of_it = at_samples + between + at_ends
        print(f"two ranks: {at_samples / all_of_it:.2%} at samples, {between / all_of_it:.2%} between them, "
              f"{at_ends / all_of_it:.2%} at the ends of rounds")
        if options.slow > 1:
            slowed([*ways["2 ranks of 1 thread"], "--spp", str(options.spp)], environment, options.slow, folder)
        if options.keep:
            path_us = statistics.median(v[1] for v in one) / (options.spp * width * height) * 1e6
            kept = {"scene": options.scene, "path_us": path_us, "cost": cost_map(tiles, width * height)}
            pathlib.Path(options.keep).write_text(json.dumps(kept))


def tile_starts(pixels, ranks, smallest=256):
    """As in application/cluster/mpi_team.cpp."""
    starts, start = [], 0
    while start < pixels:
        starts.append(start)
        even = (pixels - start) // (ranks * 8) // smallest * smallest
        start += min(max(even, smallest), 1 << 18)
    return [*starts, pixels]


class Link:
    """One way of rank 0's link: first come, first served."""

    def __init__(self, bytes_per_second):
        self.rate, self.free = bytes_per_second, 0.0

    def pass_on(self, now, size):
        self.free = max(self.free, now) + size / self.rate
        return self.free


def simulate_round(kept, ranks, options, pixels=3840 * 2160):
    """Efficiency of a round, and what of the rest goes where."""
    path = kept["path_us"] * 1e-6
    cells = kept["cost"]
    samples = max(1, round(options.round * ranks / (path * pixels)))
    latency = options.latency * 1e-6
    out, back = Link(options.bandwidth * 1e6), Link(options.bandwidth * 1e6)
    sums = [0.0]
    for cell in cells:
        sums.append(sums[-1] + cell * pixels / len(cells))

    def cost_up_to(pixel):
        place = pixel * len(cells) / pixels
        cell = min(int(place), len(cells) - 1)
        return sums[cell] + (place - cell) * cells[cell] * pixels / len(cells)

    starts = tile_starts(pixels, ranks)
    spans = iter(list(zip(starts, starts[1:])))
    events = [(0.0, rank, None) for rank in range(ranks)]  # a rank is free (None), or has a tile of so many bytes done
    work = moved = extra = 0.0
    ends = [0.0] * ranks
    while events:
        now, rank, size = heapq.heappop(events)
        if size is not None:  # rank 0 has its sums in its own memory
            ends[rank] = back.pass_on(now + latency, size) + latency if rank else now
            moved += ends[rank] - now
            heapq.heappush(events, (ends[rank], rank, None))
            continue
        first, last = next(spans, (0, 0))
        if first == last:
            continue
        size = (last - first) * BYTES_PER_PIXEL
        arrived = out.pass_on(now + 2 * latency, size) + 2 * latency if rank else now
        plain = (cost_up_to(last) - cost_up_to(first)) * path * samples
        small = 1.0 + (SMALL_TILE_COST - 1.0) * max(0.0, min(1.0, math.log2(2048 / (last - first)) / 3))
        slow = options.slow if rank == 1 else 1.0
        work, extra, moved = work + plain, extra + plain * (small * slow - 1.0), moved + arrived - now
        heapq.heappush(events, (arrived + plain * small * slow, rank, size))
    end = max(ends)
    barrier = 2 * latency * math.ceil(math.log2(max(2, ranks)))
    total = ranks * (end + barrier)
    waiting = sum(end - own for own in ends)
    return samples, len(starts) - 1, work / total, extra / total, moved / total, waiting / total, ranks * barrier / total


def simulate(options):
    kept = json.loads(pathlib.Path(options.simulate).read_text())
    print(f"{kept['scene']}, {kept['path_us']:.2f} us a path; 3840x2160, link of rank 0 {options.bandwidth} MB/s each way, "
          f"{options.latency} us, rounds of {options.round} s" + (f", rank 1 {options.slow} times slower" if options.slow > 1 else ""))
    print("| ranks | samples a round | tiles | work | small tiles, slow rank | sums on the way | end of round | barrier |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for ranks in map(int, options.ranks.split(",")):
        samples, tiles, *parts = simulate_round(kept, ranks, options)
        print(f"| {ranks:,} | {samples} | {tiles:,} | " + " | ".join(f"{part:.1%}" for part in parts) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pathtracer", nargs="?")
    parser.add_argument("scene", nargs="?")
    parser.add_argument("--camera")
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--mca", action="append", default=[])
    parser.add_argument("--keep")
    parser.add_argument("--simulate")
    parser.add_argument("--ranks", default="1,4,16,64,256,1024")
    parser.add_argument("--bandwidth", type=float, default=1100.0)
    parser.add_argument("--latency", type=float, default=20.0)
    parser.add_argument("--round", type=float, default=2.0)
    parser.add_argument("--slow", type=float, default=1.0)
    options = parser.parse_args()
    if options.simulate:
        simulate(options)
    elif options.scene:
        measure(options)
    else:
        parser.error("give PATHTRACER and SCENE, or --simulate FILE")


if __name__ == "__main__":
    main()
