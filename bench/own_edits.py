#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Holds `porttool sync` to what it promises, on edits of our own kernels.

Each edit of own_edit_list.py is made in one core of a clone; `sync --all --apply` ports it. As most kernels are twins,
the same edit made in the other core by hand is an independent answer: the port is exact where all files have its words
(comments and line breaks aside), and `check --strict` must be in step. With --build both cores are built with the edit
and its port, and must draw the same bits (own_edits_build.py). --history takes the commits that changed both cores'
kernels instead: the source's half at the commit before, held against the port that was written.

Prints one line an edit and the counts. Exit code 1 where a port is wrong, does not build or draws something else, or
where one of an edit of the list is left.
"""
import argparse
import collections
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from own_edit_list import LARGE, SMALL
from own_edits_build import Build

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = {"source": "source_core/kernels", "target": "target_core/kernels"}
WORD = re.compile(r"[A-Za-z_]\w*|\d[\w.]*(?:(?<=[eE])[-+]\d+\w*)?|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|\+\+|--|->|::|\S")
LITERAL = re.compile(r"\d+\.\d*(?:[eE][-+]?\d+)?f?\b|\.\d+f?\b")


def words(text):
    """The words of a text without comments; numbers by their value."""
    plain = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.S)
    return [str(float(w.rstrip("f"))) if LITERAL.fullmatch(w) else w for w in WORD.findall(plain)]


def path_on(side, file):
    """Where a file of the list lies in a core; None where it is the other core's alone."""
    if file.startswith("core:"):
        return f"{side}_core/{file[5:]}"
    if ":" in file:
        owner, file = file.split(":")
        return f"{FOLDERS[side]}/{file}" if owner == side else None
    return f"{FOLDERS[side]}/{file}{'.h' if side == 'target' or file == 'layout' else '.glsl'}"


def text_on(side, file, text):
    """A text of the list as a core writes it."""
    target = side == "target"
    guard = file.upper() + "_GLSL"
    top = f"// SPDX-FileCopyrightText: 2026 The porttool authors\n// SPDX-License-Identifier: Apache-2.0\n" \
          f"// Kind: twin of {path_on('source' if target else 'target', file)}.\n" if "#guard" in text else ""
    text = top + text.replace("#guard", "#pragma once" if target else f"#ifndef {guard}\n#define {guard}")
    text = text.replace("#open", "namespace target_core::kernels {\n\n" if target else "")
    text = text.replace("#close", "}  // namespace target_core::kernels" if target else "#endif")
    text = re.sub(r"#include <(\w+)>", r'#include "target_core/kernels/\1.h"' if target else r'#include "\1.glsl"', text)
    return text.replace("@", "inline " if target else "")


def edited(side, steps, read):
    """The files of a core after an edit, by path."""
    out = {}
    for file, old, new in steps:
        path = path_on(side, file)
        if path is None:
            continue
        if old is None:
            out[path] = text_on(side, file, new)
            continue
        text = out[path] if path in out else read(path)
        was = text_on(side, file, old)
        if text.count(was) != 1:
            sys.exit(f"own_edits.py: {path} has {text.count(was)} times: {was}; adapt own_edit_list.py")
        out[path] = text.replace(was, text_on(side, file, new))
    return out


class Clone:
    def __init__(self, folder, porttool, revision):
        self.folder, self.porttool = folder, porttool
        self.git("clone", "-q", "-s", str(ROOT), ".")
        self.git("checkout", "-q", "--detach", revision)
        self.revision = self.git("rev-parse", "HEAD").strip()

    def git(self, *words_):
        return subprocess.run(["git", *words_], cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def read(self, path):
        return (self.folder / path).read_text() if (self.folder / path).is_file() else ""

    def write(self, files):
        for path, text in files.items():
            (self.folder / path).write_text(text)

    def changed_code(self):
        """The texts of both cores' files that differ from the commit, by path."""
        lines = self.git("status", "--porcelain", "-uall", "source_core", "target_core").splitlines()
        return {line[3:]: self.read(line[3:]) for line in lines}

    def reset(self, revision=None):
        self.git("checkout", "-q", "--force", "--detach", revision or self.revision)
        self.git("clean", "-q", "-f", "-d")

    def run(self, *words_):
        done = subprocess.run([self.porttool, *words_], cwd=self.folder, capture_output=True, text=True)
        if done.returncode not in (0, 1):
            raise RuntimeError(done.stderr.strip() or f"exit code {done.returncode}")
        return done

    def sync(self, to):
        """What `sync` proposes, after it was written; the run that writes must say the same."""
        asked = json.loads(self.run("sync", "--all", "--to", to, "--format", "json").stdout)
        self.run("sync", "--all", "--to", to, "--apply")
        return asked["proposals"]


def in_step(clone):
    done = clone.run("check", "--strict", "--no-cache")
    return done.returncode == 0, done.stdout


def judged(clone, to, wanted, proposals):
    """How the port came out, by name; and what there is to say."""
    said = [f"{p['state']}: {p['source'].split(':')[-1]}: {item['message']}"
            for p in proposals for item in p["left"]]
    differs = [path for path in wanted if words(clone.read(path)) != words(wanted[path])]
    fine, report = in_step(clone)
    touched = clone.git("status", "--porcelain", FOLDERS[to]).strip()
    if not differs:
        if said or not fine:
            return "exact, unsaid", said or [report.strip()[:2000]]
        return ("exact" if touched else "nothing due"), []
    if said:
        return ("partial" if any(p["state"] == "partial" or p["patch"] for p in proposals) else "left"), said
    # A unit that has another name or place with the same text is known again: the port stands as it did.
    verdict = "different" if touched else "in step as it is" if fine else "nothing"
    return verdict, differs + ([] if fine else [report.strip()[:2000]])


def build_all(arguments, revision, ported):
    """Builds what was ported, and draws with it. An edit and its port that have the same words are built once, whichever
    side was edited. Returns how many do not build or draw something else."""
    build = Build(pathlib.Path(arguments.build).absolute(), revision)
    ways = collections.defaultdict(list)
    for to, name, files in ported:
        ways[tuple(sorted((path, *words(text)) for path, text in files.items()))].append((to, name, files))
    found = build.try_all([same[0][2] for same in ways.values()], arguments.group)
    counts = collections.defaultdict(collections.Counter)
    for same, (result, said) in zip(ways.values(), found):
        for to, name, _ in same:
            counts[to][result] += 1
            print(f"to {to}: {result}: {name}")
        for line in said.splitlines():
            print("    " + line)
    for to, results in counts.items():
        print(f"to {to}, built: " + ", ".join(f"{n} {result}" for result, n in sorted(results.items())))
    return sum(len(same) for same, (result, _) in zip(ways.values(), found) if not result.startswith("identical"))


def difference(clone, wanted):
    with tempfile.TemporaryDirectory() as folder:
        out = ""
        for path, text in wanted.items():
            if words(clone.read(path)) == words(text):
                continue
            file = pathlib.Path(folder) / "wanted"
            file.write_text(text)
            out += subprocess.run(["diff", "-u", "--label", "by hand", "--label", path, str(file), str(clone.folder / path)],
                                  capture_output=True, text=True).stdout
        return out


def try_list(arguments, clone):
    counts, wrong = collections.defaultdict(collections.Counter), 0
    ported = []
    for to in arguments.to:
        side = "target" if to == "source" else "source"
        for edit in SMALL + LARGE:
            name, kind, steps = edit[:3]
            if arguments.only and arguments.only not in (name, kind):
                continue
            clone.reset()
            done, wanted = edited(side, steps, clone.read), edited(to, steps, clone.read)
            if kind == "nothing":
                wanted = {path: clone.read(path) for path in wanted}
            clone.write(done)
            try:
                verdict, said = judged(clone, to, wanted, clone.sync(to))
            except RuntimeError as error:
                verdict, said = "failed", [str(error)]
            shown = difference(clone, wanted) if arguments.verbose else ""
            due = "nothing due" if kind == "nothing" else "exact"
            wrong += verdict not in (due, "in step as it is")
            counts[to][verdict] += 1
            if verdict in (due, "in step as it is"):
                ported.append((to, name, clone.changed_code()))
            print(f"to {to}: {verdict}: {name}", flush=True)
            for line in [line for text in said for line in text.splitlines()] + shown.splitlines():
                print("    " + line, flush=True)
    for to, found in counts.items():
        print(f"to {to}: " + ", ".join(f"{n} {verdict}" for verdict, n in sorted(found.items())))
    return wrong + (build_all(arguments, clone.revision, ported) if arguments.build else 0)


def units_of(clone, files):
    """The words of the units of files of the clone, by id; what stands between them under the file's name."""
    there = [f for f in files if (clone.folder / f).is_file()]
    found = json.loads(clone.run("scan", *there, "--format", "json").stdout)["units"] if there else []
    units, rests = {}, {f: clone.read(f).splitlines() for f in there}
    for unit in found:
        lines = rests[unit["file"]]
        first, last = unit["start_line"] - 1, unit["end_line"]
        units[unit["id"]] = words("\n".join(clone.read(unit["file"]).splitlines()[first:last]))
        lines[first:last] = [""] * (last - first)
    return units | {f: words("\n".join(lines)) for f, lines in rests.items()}


def sort_units(proposals, before, got, wanted):
    """How each unit that was changed, by hand or by sync, came out: lists of ids by name of the result."""
    states = {p["target"]: p["state"] for p in proposals}
    left = {i for i, state in states.items() if state in ("partial", "refused")}
    out = collections.defaultdict(list)
    for i in sorted(before.keys() | got.keys() | wanted.keys()):
        if got.get(i) == wanted.get(i):
            if got.get(i) != before.get(i):
                out["exact"].append(i)
        elif got.get(i) != before.get(i):
            out["other"].append(i)
        elif i in left:
            out["left"].append(i)
        else:
            out["not there" if i not in before else "gone by hand" if i not in wanted else "by hand alone"].append(i)
    return out


def try_history(arguments, clone):
    """Commits of both cores' kernels: the source's half, ported, and what was written."""
    counts = collections.Counter()
    listed = clone.git("log", "--reverse", "--no-merges", "--format=%h", "--", *FOLDERS.values()).split()
    for commit in listed:
        if arguments.only and arguments.only != commit:
            continue
        files = clone.git("show", "--name-status", "--format=", "--no-renames", commit).splitlines()
        modified = [f.split("\t")[1] for f in files if f.startswith(("M", "A"))]
        halves = [[f for f in modified if f.startswith(folder)] for folder in FOLDERS.values()]
        if not all(halves):
            continue
        if not clone.git("rev-list", "--parents", "-n1", commit).split()[1:]:
            continue
        clone.reset(commit + "^")
        if not (clone.folder / "portmap.lock").is_file():
            continue
        try:
            clone.run("init", "--force", "--source", "source_core/kernels/**", "--target", "target_core/kernels/**")
            clone.git("add", "-A")
            clone.git("-c", "user.name=bench", "-c", "user.email=bench@localhost", "commit", "-q", "-m", "In step")
            clone.write({f: clone.git("show", f"{commit}:{f}") for f in halves[0]})
            before = units_of(clone, halves[1])
            proposals = clone.sync("target")
            got, kept = units_of(clone, halves[1]), {f: clone.read(f) for f in halves[1]}
            clone.write({f: clone.git("show", f"{commit}:{f}") for f in halves[1]})
            wanted, by_hand = units_of(clone, halves[1]), {f: clone.read(f) for f in halves[1]}
            clone.write(kept)
        except RuntimeError as error:
            counts["failed"] += 1
            print(f"{commit}: failed: {error}", flush=True)
            continue
        sorted_ = sort_units(proposals, before, got, wanted)
        counts.update({f"units {name}": len(ids) for name, ids in sorted_.items()})
        print(f"{commit}: " + ", ".join(f"{len(ids)} {name}" for name, ids in sorted_.items()), flush=True)
        for i in sorted_["other"]:
            print(f"    other: {i}")
        if arguments.verbose:
            for name in ("left", "not there", "gone by hand", "by hand alone"):
                print("".join(f"    {name}: {i}\n" for i in sorted_[name]), end="")
            for p in proposals:
                for item in p["left"]:
                    print(f"    {p['state']}: {p['source']}: {item['message']}")
            print(difference(clone, by_hand))
    print(dict(counts))
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--porttool", default=str(ROOT / "build/release/bin/porttool"))
    parser.add_argument("--revision", default="HEAD", help="what to edit")
    parser.add_argument("--to", action="append", choices=["source", "target"], help="the side that is written; both unless given")
    parser.add_argument("--only", metavar="NAME", help="one edit, or one kind; with --history one commit")
    parser.add_argument("--history", action="store_true", help="commits of both cores instead of the list")
    parser.add_argument("--build", metavar="DIR", help="build and draw as well, in a work tree kept there")
    parser.add_argument("--group", type=int, default=8, help="with --build: how many edits are built together (8)")
    parser.add_argument("--verbose", action="store_true", help="show what differs")
    arguments = parser.parse_args()
    arguments.to = arguments.to or ["target", "source"]
    arguments.porttool = os.path.abspath(arguments.porttool)
    with tempfile.TemporaryDirectory() as folder:
        clone = Clone(pathlib.Path(folder), arguments.porttool, arguments.revision)
        return int((try_history if arguments.history else try_list)(arguments, clone) > 0)


if __name__ == "__main__":
    sys.exit(main())
