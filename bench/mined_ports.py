#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Records of ports from the public history of a collection of programs that each exist in several languages.

    git clone https://github.com/zjin-lcf/HeCBench
    bench/mined_ports.py HeCBench                  the records, as [[effort]] of portmap.toml
    bench/mined_ports.py HeCBench --each 1000      every port that the rules let in

A port is a commit that adds files to NAME-hip, NAME-sycl or NAME-omp and to no other folder, where NAME-cuda is there
already. Its lines are those that `porttool effort` counts. Its hours are the time from its author's commit before, of
which nobody knows how much was work on it: pauses count, what was prepared before does not. So only those are taken that
lie in one sitting, from --least to --most; what is committed within minutes of another commit was made earlier. Of each
kind --each are taken, in the order of their commits' names: a choice that nobody made by their hours or lines.
"""
import argparse
import datetime
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Impediments by one scale for all: `H` is 1 from a GPU to a processor; `E` is 0 where the words change and no construct
# does, 0.5 where the launch and the memory are written otherwise around kernels that stay, 1 where another model of
# parallel programs takes the kernels' place.
ENVIRONMENT = {"hip": 0.0, "sycl": 0.5, "omp": 1.0}
FOLDER = re.compile(r"(?P<above>(?:src/)?)(?P<name>[^/]+)-(?P<kind>cuda|hip|sycl|omp)/")


def fail(message):
    print(f"mined_ports.py: {message}", file=sys.stderr)
    sys.exit(2)


def git(clone, *words):
    done = subprocess.run(["git", "-C", str(clone), *words], capture_output=True, check=False)
    if done.returncode:
        fail(f"{clone}: git {words[0]}: {' '.join(done.stderr.decode(errors='replace').split())}")
    return done.stdout.decode(errors="replace")


def commits_by_time(clone):
    """Each commit with its author, the author's time and what became of its files; merges are left out."""
    log = git(clone, "log", "--no-merges", "--no-renames", "--name-status", "--format=%x01%H%x00%P%x00%an%x00%at")
    found = []
    for part in log.split("\x01")[1:]:
        head, _, files = part.partition("\n")
        commit, parents, author, time = head.split("\x00")
        found.append({"commit": commit, "parent": parents.split()[0] if parents else None, "author": author, "time": int(time),
                      "files": [line.split("\t") for line in files.strip().splitlines()]})
    return sorted(found, key=lambda commit: (commit["time"], commit["commit"]))


def port_folder(commit):
    """The one folder of a port that the commit adds files to; None where it does anything else."""
    folders = {FOLDER.match(file[-1]) and FOLDER.match(file[-1])[0] for file in commit["files"]}
    if len(folders) != 1 or None in folders or any(file[0] != "A" for file in commit["files"]):
        return None
    folder = FOLDER.match(folders.pop())
    return folder if folder["kind"] in ENVIRONMENT else None


def candidates(clone, least, most):
    """Commits that add a port, with the hours since their author's commit before."""
    before, found = {}, []
    for commit in commits_by_time(clone):
        hours = (commit["time"] - before.get(commit["author"], 0)) / 3600
        before[commit["author"]] = commit["time"]
        folder = port_folder(commit)
        if folder is not None and commit["parent"] and least <= hours <= most:
            found.append({**commit, "hours": hours, "folder": folder})
    return sorted(found, key=lambda port: port["commit"])


def counted(porttool, clone, port):
    """Lines and novel lines by `porttool effort`; None where the source was not there or no line was counted."""
    folder = port["folder"]
    source = f"{folder['above']}{folder['name']}-cuda"
    if not git(clone, "ls-tree", "-d", port["commit"], source):
        return None
    with tempfile.TemporaryDirectory() as name:
        config = pathlib.Path(name) / "map.toml"
        config.write_text(f'version = 1\n[sides]\nsource = ["{source}/**"]\ntarget = ["{folder[0]}**"]\n')
        done = subprocess.run([porttool, "-C", str(clone), "--config", str(config), "effort", "--from", port["parent"], "--to",
                               port["commit"], "--format", "json"], capture_output=True, text=True, check=False)
    if done.returncode:
        fail(f"{port['commit']}: {' '.join(done.stderr.split())}")
    totals = json.loads(done.stdout)["totals"]
    return (totals["target_added"], totals["novel_lines"]) if totals["target_added"] > 0 else None


def record(port, collection, lines, novel):
    folder = port["folder"]
    day = datetime.datetime.fromtimestamp(port["time"], datetime.timezone.utc).date()
    what = json.dumps(f"{folder['name']} from CUDA to {folder['kind'].upper()}, {collection}, {day}", ensure_ascii=False)
    return (f'[[effort]]\nwhat = {what}\n'
            f'from = "{port["parent"]}"\nto = "{port["commit"]}"\nlines = {lines}\nnovel = {novel}\n'
            f'port = {{ coding = {port["hours"]:.3f} }}\nimpediments = {{ H = 0, E = {ENVIRONMENT[folder["kind"]]:g} }}\nmined = true\n')


def whole_number(text):
    if not re.fullmatch(r"[0-9]{1,6}", text):
        raise argparse.ArgumentTypeError(f"{text}: expected a whole number")
    return int(text)


def hours_in(text):
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 <= number < math.inf:
        raise argparse.ArgumentTypeError(f"{text}: expected hours, e.g. 0.5")
    return number


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("clone", type=pathlib.Path)
    parser.add_argument("--name", help="of the collection (the folder's)")
    parser.add_argument("--each", type=whole_number, default=8, help="ports of each kind (8)")
    parser.add_argument("--least", type=hours_in, default=0.05, help="hours (0.05)")
    parser.add_argument("--most", type=hours_in, default=2.0, help="hours (2)")
    parser.add_argument("--porttool", default=str(ROOT / "build/release/bin/porttool"))
    arguments = parser.parse_args()
    if arguments.least > arguments.most:
        fail(f"--least {arguments.least:g} is above --most {arguments.most:g}; no port takes such hours")
    if not os.path.isfile(arguments.porttool) or not os.access(arguments.porttool, os.X_OK):
        fail(f"there is no program {arguments.porttool}; build it, or name it with --porttool")
    return arguments


def main():
    arguments = read_options()
    taken = dict.fromkeys(ENVIRONMENT, 0)
    for port in candidates(arguments.clone, arguments.least, arguments.most):
        kind = port["folder"]["kind"]
        if taken[kind] >= arguments.each:
            continue
        lines = counted(arguments.porttool, arguments.clone, port)
        if lines is not None:
            taken[kind] += 1
            print(record(port, arguments.name or arguments.clone.resolve().name, *lines))
    if arguments.each > 0 and not any(taken.values()):
        print(f"mined_ports.py: {arguments.clone} has no commit that adds one NAME-hip, NAME-sycl or NAME-omp beside a NAME-cuda within "
              f"{arguments.least:g} to {arguments.most:g} hours of its author's commit before", file=sys.stderr)


if __name__ == "__main__":
    main()
