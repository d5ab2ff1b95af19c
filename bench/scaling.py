#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""What texts that were written to hurt cost porttool: its time and memory at one size and at twice that.

    bench/scaling.py [--porttool build/release/bin/porttool] [--bytes 2097152] [--only PART] [--all]
                     [--journal FILE]

Makes each text of bench/constructs.json in a temporary folder (in memory where that can be) as both sides of a
repository, edits one side and both, and runs scan, map, init, check, check --base, compare and effort. Prints a Markdown table of the
worst constructs of each command (--all: of all); exits 1 if twice the size takes more than 2.3 times as long, or more
than 1 GiB. Times are the processor's; below 0.5 s they count as that: they are the start of the program. A time of the
smaller size that could not matter is not taken, and shown as -.

--journal FILE: notes what each construct took in FILE, and goes on from what is noted there: all take hours.

What is filled in up to a bound that docs/porttool.md names grows faster below it. So what grows too fast is doubled again,
up to 4 MiB, and must grow in line with the text by then; the table has the sizes of which that was seen.

What grows faster than the text is told from what a larger text does to the caches, and from what a busy machine does, by
`ninja -C build/release porttool_growth && build/release/bin/porttool_growth`, which counts in place of timing.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

# `init` writes a file for each text that it records: where a disk is slow with a hundred thousand of them in a folder, or
# with those of the construct before that were just removed, its time would be in the table, not porttool's.
MEMORY = "/dev/shm"
MOST_GROWTH, LEAST_SECONDS = 2.3, 0.5
MOST_BYTES, LARGEST, LONGEST = 1 << 30, 4 << 20, 120
SIDES = ["--source", "s/**", "--target", "t/**"]


def filled(pattern, number, edited):
    return pattern.replace("{i}", str(number)).replace("{e}", "2" if edited else "1")


def repetitions(construct, size):
    return max(1, size // max(1, len(filled(construct["open"], 1234, False)) + len(filled(construct["close"], 1234, False))))


def text(construct, count, edit):
    """The construct `count` times; `edit` is none, one (in one place) or all."""
    edited = [edit == "all" or (edit == "one" and k == count // 2) for k in range(count)]
    opening = "".join(filled(construct["open"], k, edited[k]) for k in range(count))
    closing = "".join(filled(construct["close"], k, edited[k]) for k in reversed(range(count)))
    parts = [filled(construct[name], 0, edit != "none") for name in ("before", "middle", "after")]
    return parts[0] + opening + parts[1] + closing + parts[2]


class Repository:
    def __init__(self, tool, folder):
        self.tool, self.folder, self.rows = tool, pathlib.Path(folder), {}
        for side in "st":
            (self.folder / side).mkdir()

    def write(self, source, target):
        for name, content in (("s/a.cu", source), ("t/a.cpp", target)):
            (self.folder / name).write_text(content, encoding="utf-8")

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *arguments], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def run(self, name, *arguments):
        """Runs a command and notes its processor time and peak memory."""
        with open(os.devnull, "wb") as sink:
            process = subprocess.Popen([self.tool, *arguments], cwd=self.folder, stdout=sink, stderr=sink,
                                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST)))
            _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.rows[name] = (usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, process.returncode)


def measure(tool, construct, size, wanted=None):
    """The rows of the commands at a size; of those that are wanted alone, with the `init` that they need."""
    count = repetitions(construct, size)
    old, one, other = (text(construct, count, edit) for edit in ("none", "one", "all"))
    with tempfile.TemporaryDirectory(dir=MEMORY if os.access(MEMORY, os.W_OK) else None) as folder:
        repository = Repository(tool, folder)

        def run(name, *arguments):
            if wanted is None or name in wanted or (name == "init" and not wanted <= {"scan", "map"}):
                repository.run(name, *arguments)

        repository.write(old, old)
        run("scan", "scan", "s", "--format", "json")
        run("map", "map", *SIDES, "--format", "json")
        run("init", "init", *SIDES)
        for command in (["init", "-q"], ["add", "-A"], ["commit", "-qm", "before"]):
            repository.git(*command)
        repository.write(one, old)
        run("check, one side", "check")
        repository.write(other, one)
        run("check, both sides", "check")
        run("check --base", "check", "--base", "HEAD")
        run("compare", "compare", "s/a.cu", "t/a.cpp")
        for command in (["add", "s", "t"], ["commit", "-qm", "now"]):
            repository.git(*command)
        run("effort", "effort", "--from", "HEAD~1", "--to", "HEAD")
        return repository.rows


def growth(once, twice):
    return max(twice[0], LEAST_SECONDS) / max(once[0] or 0, LEAST_SECONDS)


def too_fast(once, twice):
    """The commands that take too much more for twice the size."""
    return {command for command in twice if growth(once[command], twice[command]) > MOST_GROWTH}


def measure_pair(tool, construct, size):
    """The rows of a size and of twice that. The larger comes first: what takes so little there that it cannot be too much
    is not asked at the smaller size, and has no time there. What else a machine does only adds to a time: what is beyond
    the bound is measured again, up to twice, and the least time of each size counts."""
    twice = measure(tool, construct, 2 * size)
    once = {command: (None, peak, code) for command, (_, peak, code) in twice.items()}
    asked = {command for command, row in twice.items() if row[0] > MOST_GROWTH * LEAST_SECONDS}
    if asked:
        once.update(measure(tool, construct, size, asked))
    for _ in range(2):
        if not (fast := too_fast(once, twice)):
            break
        for rows, part in ((once, size), (twice, 2 * size)):
            for command, (seconds, peak, code) in measure(tool, construct, part, fast).items():
                if command in fast:
                    rows[command] = (min(seconds, rows[command][0]), max(peak, rows[command][1]), code)
    return once, twice


def measure_twice(tool, construct, size):
    """The rows of each command at a size and at twice that, with the size: for what grows too fast the largest."""
    once, twice = measure_pair(tool, construct, size)
    found = {command: (once[command], twice[command], size) for command in twice}
    while (fast := too_fast(once, twice)) and 4 * size <= LARGEST:
        size *= 2
        once, twice = measure_pair(tool, construct, size)
        found.update({command: (once[command], twice[command], size) for command in fast})
        once, twice = ({command: rows[command] for command in fast} for rows in (once, twice))
    return found


def noted(journal, key):
    """The rows that a run before this one noted under the key; None where it noted none."""
    if journal is not None and journal.exists():
        for line in journal.read_text(encoding="utf-8").splitlines():
            if (entry := json.loads(line))["key"] == key:
                return entry["rows"]
    return None


def measured(tool, construct, size, journal):
    """The rows of a construct, out of the journal where they are noted, else measured, and then noted."""
    key = [construct["name"], size]
    rows = noted(journal, key)
    if rows is None:
        rows = measure_twice(tool, construct, size)
        if journal is not None:
            with journal.open("a", encoding="utf-8") as file:
                file.write(json.dumps({"key": key, "rows": rows}) + "\n")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--porttool", default="build/release/bin/porttool")
    parser.add_argument("--bytes", type=int, default=2 << 20, help="the smaller size of each text")
    parser.add_argument("--only", action="append", default=[], help="constructs whose name holds this; may be given again")
    parser.add_argument("--all", action="store_true", help="a row for every construct")
    parser.add_argument("--journal", type=pathlib.Path, help="note what each construct took in this file, and go on from it")
    options = parser.parse_args()
    if not os.path.exists(options.porttool):
        sys.exit(f"no {options.porttool} here; build it, or name it with --porttool")
    tool = os.path.abspath(options.porttool)
    constructs = json.loads((pathlib.Path(__file__).parent / "constructs.json").read_text(encoding="utf-8"))
    rows, failed = {}, 0
    for construct in constructs:
        if options.only and not any(part in construct["name"] for part in options.only):
            continue
        for command, (once, twice, size) in measured(tool, construct, options.bytes, options.journal).items():
            (seconds, peak, code), times = twice, growth(once, twice)
            bad = bool(too_fast({command: once}, {command: twice})) or peak > MOST_BYTES or code not in (0, 1)
            failed += bad
            rows.setdefault(command, []).append((times, seconds, once[0], peak, construct["name"], code, bad, size))
        # A long run that is cut off has said what it found.
        worst = max((row[-1] for row in rows.values()), key=lambda row: row[:2])
        print(f"{construct['name']}: at most {worst[0]:.2f} times{', TOO MUCH' if any(row[-1][6] for row in rows.values()) else ''}", file=sys.stderr, flush=True)
    print("| command | construct | bytes | | twice that | growth | peak | |\n| --- | --- | --- | --- | --- | --- | --- | --- |")
    for command, found in rows.items():
        worst = {max(found, key=lambda row: row[:2])[4], max(found, key=lambda row: row[1])[4], max(found, key=lambda row: row[3])[4]}
        for times, seconds, before, peak, name, code, bad, size in sorted(found, key=lambda row: row[:2], reverse=True):
            if options.all or bad or name in worst:
                smaller = "-" if before is None else f"{before:.2f} s"
                print(f"| {command} | {name} | {size} | {smaller} | {seconds:.2f} s | {times:.2f} | {peak / 2**20:.0f} MiB |"
                      f" {'exit ' + str(code) if code not in (0, 1) else 'TOO MUCH' if bad else ''} |")
    print(f"\n{sum(len(found) for found in rows.values())} runs of twice the size, {failed} beyond the bounds")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
