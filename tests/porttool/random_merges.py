#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""The long run of TwentyBranchesThatAcceptTwentyPairsMergeInAnyOrder:

    tests/porttool/random_merges.py PORTTOOL [MERGES [SEED]]

Branches of one repository accept pairs, each its own, a random few, with and without reasons; MERGES (200) merges bring them
together in random order, also branches into branches. No merge may conflict, and in the end each verdict must stand and the gate
must be in step. Prints counts; exits 1 at the first loss. (New pairs are not tried: two that are neighbours in portmap.toml
are two insertions at one place, which git asks about.)
"""
import pathlib
import random
import subprocess
import sys
import tempfile

PORTTOOL = str(pathlib.Path(sys.argv[1]).resolve())
MERGES = int(sys.argv[2]) if len(sys.argv) > 2 else 200
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1
FILES, FUNCTIONS, BRANCHES = 12, 40, 10


def fail(what):
    print("random_merges:", what, file=sys.stderr)
    sys.exit(1)


class Repository:
    def __init__(self, root):
        self.root = root
        self.factor = {(f, n): 1 for f in range(FILES) for n in range(FUNCTIONS)}
        self.run("git", "init", "-q", "-b", "main", ".")
        self.run("git", "config", "user.email", "a@b")
        self.run("git", "config", "user.name", "a")
        for f in range(FILES):
            self.write(f, self.factor)
        self.porttool("init", "--source", "src/*", "--target", "port/*")
        self.commit("start")

    def run(self, *words, may_fail=False):
        done = subprocess.run(words, cwd=self.root, capture_output=True, text=True)
        if done.returncode != 0 and not may_fail:
            fail(" ".join(words) + "\n" + done.stdout + done.stderr)
        return done

    def porttool(self, *words):
        return self.run(PORTTOOL, *words)

    def commit(self, subject):
        self.run("git", "add", "-A")
        self.run("git", "commit", "-qm", subject)

    def write(self, f, factor):
        """Functions far enough apart that git's merge of the code itself has nothing to ask."""
        for folder, suffix, head in (("src", "cu", "__device__ "), ("port", "cpp", "")):
            text = "".join(f"{head}float work_{f}_{n}(float x, float y) {{\n    float sum = x * {n}.5f;\n"
                           f"    sum += y * {factor[f, n]}.0f;\n    return sum;\n}}\n\n\n\n" for n in range(FUNCTIONS))
            (self.root / folder).mkdir(exist_ok=True)
            (self.root / folder / f"a{f}.{suffix}").write_text(text)


def source_id(f, n):
    return f"src/a{f}.cu:work_{f}_{n}"


def branch_work(repository, rng, name, mine, number):
    """On a branch of its own: edits its pairs on both sides and records each; returns the verdicts that must last."""
    lasting = []
    for f, n in mine:
        repository.factor[f, n] = number + 2
    for f in {f for f, _ in mine}:
        # What other branches changed is not here.
        there = {key: value if key in mine else repository.at_main[key] for key, value in repository.factor.items()}
        repository.write(f, there)
    for f, n in mine:
        if rng.random() < 0.4:
            reason = f"branch {number} looked at {n}"
            repository.porttool("accept", source_id(f, n), "--reason", reason)
            lasting.append((source_id(f, n), reason))
        else:
            repository.porttool("accept", source_id(f, n))
    repository.commit(name)
    return lasting


def main():
    rng = random.Random(SEED)
    merges = verdicts = accepted = 0
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(pathlib.Path(folder))
        lasting = []
        number = 0
        while merges < MERGES:
            repository.at_main = dict(repository.factor)
            pairs = sorted(repository.factor)
            rng.shuffle(pairs)
            names = []
            for _ in range(BRANCHES):
                number += 1
                mine = {pairs.pop() for _ in range(rng.randint(1, 6))}
                names.append(f"b{number}")
                repository.run("git", "checkout", "-q", "-b", names[-1], "main")
                # A pair that is accepted anew has its last reason, or none.
                lasting = [entry for entry in lasting if entry[0] not in {source_id(f, n) for f, n in mine}]
                lasting += branch_work(repository, rng, names[-1], mine, number)
                accepted += len(mine)
            rng.shuffle(names)
            while names:
                into = "main"
                name = names.pop()
                if names and rng.random() < 0.3:  # first into another branch
                    into = names[rng.randrange(len(names))]
                repository.run("git", "checkout", "-q", into)
                merged = repository.run("git", "merge", "-q", "--no-edit", name, may_fail=True)
                if merged.returncode != 0:
                    fail(f"merge {merges}: {name} into {into}: {merged.stdout}{merged.stderr}")
                merges += 1
            repository.run("git", "checkout", "-q", "main")
            checked = repository.run(PORTTOOL, "check", "--strict", may_fail=True)
            if checked.returncode != 0:
                fail(f"after {merges} merges: {checked.stdout}{checked.stderr}")
            lock = (repository.root / "portmap.lock").read_text()
            for identity, reason in lasting:
                if reason not in lock:
                    fail(f"after {merges} merges the verdict on {identity} is lost ({reason})")
            verdicts = len(lasting)
    print(f"{merges} merges of {number} branches, {accepted} acceptances; none conflicted, all {verdicts} lasting verdicts "
          "stand, the gate is in step")


main()
