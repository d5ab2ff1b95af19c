#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Random edits of a repository; after each, `porttool check` must answer with its cache, byte for byte, what it answers
without: cache_random.py PORTTOOL [EDITS] [SEED]

Edited are units, macros, includes, comments that settle findings, names and numbers of files, the map, the lock, the texts
behind it and, now and then, the cache itself. Ends with the number of edits and of different answers seen.
"""
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
EDITS = int(sys.argv[2]) if len(sys.argv) > 2 else 60
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1
FIXTURES = pathlib.Path(__file__).parent / "fixtures"
FORMATS = ("text", "json", "junit", "markdown", "github", "gitlab", "html", "sarif")

HEADER = """#pragma once
#define SCALE 2
#define sinf __sinf
#define LIMIT(x) ((x) < SCALE ? (x) : SCALE)
"""
KERNEL = """#include "common.h"

float fold_{n}(float x, float y) {{
    float sum = {k}.5f * sinf(x) + LIMIT(y);
    if (sum > {k}.0f) sum -= y * 0.25f;
    return sum;
}}

float spread_{n}(float x) {{
    float sum = 0.0f;
    for (int i = 0; i < {k}; ++i) sum += fold_{n}(x, i) * SCALE;
    return sum;
}}
"""


class Project:
    def __init__(self, folder, rng):
        self.rng, self.root, self.home = rng, folder / "root", folder / "cache"
        self.serial = 0
        for side in ("source", "target"):
            (self.root / side).mkdir(parents=True)
            for fixture in sorted(FIXTURES.iterdir()):
                if fixture.suffix != ".units" and fixture.stat().st_size < 20000:
                    shutil.copy(fixture, self.root / side)
            (self.root / side / "common.h").write_text(HEADER)
            for n in range(6):
                (self.root / side / f"part{n}.cpp").write_text(KERNEL.format(n=n, k=n + 2))
        self.git("init", "-q")
        self.run("init", "--source", "source/**", "--target", "target/**")
        self.commit()
        self.first = subprocess.run(["git", "-C", str(self.root), "rev-parse", "HEAD"], capture_output=True, text=True,
                                    check=True).stdout.strip()

    def git(self, *arguments):
        subprocess.run(["git", "-C", str(self.root), "-c", "user.name=a", "-c", "user.email=a@b", *arguments], check=True,
                       capture_output=True)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "as it stands", "--allow-empty")

    def run(self, *arguments):
        ran = subprocess.run([PROGRAM, "-C", str(self.root), *arguments], capture_output=True,
                             env={**os.environ, "XDG_CACHE_HOME": str(self.home), "PORTTOOL_CACHE_FROM": "0"})
        return ran.returncode, ran.stdout, ran.stderr

    def files(self, pattern="*/**/*"):
        return sorted(path for path in self.root.glob(pattern)
                      if path.is_file() and path.relative_to(self.root).parts[0] in ("source", "target"))

    def edit(self):
        """Changes something; returns what."""
        choices = [self.number, self.number, self.number, self.word, self.macro, self.include, self.unit, self.unit,
                   self.no_unit, self.comment, self.file_moves, self.file_gone, self.file_torn, self.both, self.settle,
                   self.map, self.lock, self.texts, self.back, self.cache, self.whole_file]
        chosen = self.rng.choice(choices)
        chosen()
        return chosen.__name__

    def some_file(self):
        return self.rng.choice(self.files())

    def change(self, file, function):
        data = file.read_bytes()
        file.write_bytes(function(data))

    def number(self, file=None):
        def change(data):
            found = list(re.finditer(rb"\b[1-9][0-9]*\b", data))
            if not found:
                return data
            at = self.rng.choice(found)
            return data[:at.start()] + str(self.rng.randrange(1, 99)).encode() + data[at.end():]
        self.change(file or self.some_file(), change)

    def word(self):
        def change(data):
            found = list(re.finditer(rb"\b[a-z]\w*\b", data))
            at = self.rng.choice(found) if found else None
            return data if at is None else data[:at.start()] + self.rng.choice(found).group() + data[at.end():]
        self.change(self.some_file(), change)

    def macro(self):
        name = self.rng.choice(["sinf", "SCALE", "LIMIT", "sum", "restrict", "fold_1", "x"])
        line = self.rng.choice([f"#define {name} {self.rng.randrange(9)}\n", f"#define {name}\n", f"#undef {name}\n",
                                f"#define {name}(a) a * {self.rng.randrange(9)}\n"]).encode()
        file = self.root / self.rng.choice(["source", "target"]) / "common.h"
        if file.exists() and self.rng.random() < 0.7:
            lines = file.read_bytes().splitlines(True)
            at = self.rng.randrange(len(lines) + 1)
            lines[at:at + self.rng.randrange(2)] = [line]
            file.write_bytes(b"".join(lines))
        else:
            self.change(self.some_file(), lambda data: line + data)

    def include(self):
        line = self.rng.choice([b'#include "common.h"\n', b'#include "part1.cpp"\n', b"#include <hard.cu>\n"])
        def change(data):
            return data.replace(line, b"", 1) if line in data else line + data
        self.change(self.some_file(), change)

    def unit(self):
        self.serial += 1
        text = self.rng.choice([KERNEL, "#define NEW_{n} {k}\n", "struct New{n} {{ float a, b{k}; }};\n",
                                "int lone_{n}(int a) {{ return a * {k} + spread_1(a); }}\n"])
        text = text.format(n=self.rng.choice([self.serial, 1]), k=self.rng.randrange(9)).encode()
        self.change(self.some_file(), lambda data: data + text)

    def no_unit(self):
        def change(data):
            found = list(re.finditer(rb"^\w[^;{}#]*\([^;{}]*\)\s*\{.*?^\}\n", data, re.M | re.S))
            at = self.rng.choice(found) if found else None
            return data if at is None else data[:at.start()] + data[at.end():]
        self.change(self.some_file(), change)

    def comment(self):
        rule = self.rng.choice(["source-changed", "target-changed", "unported", "port-differs"])
        line = f"// porttool: ignore({rule}) because {self.rng.randrange(9)}\n".encode()
        def change(data):
            if b"porttool: ignore" in data and self.rng.random() < 0.5:
                return re.sub(rb"// porttool: ignore.*\n", b"", data, count=1)
            lines = data.splitlines(True)
            lines.insert(self.rng.randrange(len(lines) + 1), line)
            return b"".join(lines)
        self.change(self.some_file(), change)

    def file_moves(self):
        file = self.some_file()
        self.serial += 1
        there = file.with_name(f"moved{self.serial}{file.suffix}")
        shutil.copy(file, there) if self.rng.random() < 0.3 else file.rename(there)

    def file_gone(self):
        if len(self.files()) > 20:
            self.some_file().unlink()

    def file_torn(self):
        """No text, the ends of lines of another system, marks of a merge, a link, or nothing."""
        file = self.some_file()
        kind = self.rng.randrange(5)
        if kind == 0:
            self.change(file, lambda data: data[:40] + b"\0" + data[40:])
        elif kind == 1:
            self.change(file, lambda data: data.replace(b"\n", b"\r\n"))
        elif kind == 2:
            self.change(file, lambda data: data + b"<<<<<<< a\n1\n=======\n2\n>>>>>>> b\n")
        elif kind == 3:
            file.unlink()
            file.symlink_to(self.rng.choice([self.some_file(), pathlib.Path("/etc/passwd"), pathlib.Path("nowhere.cpp")]))
        else:
            file.write_bytes(b"")

    def both(self):
        number = self.rng.randrange(1, 99)
        name = f"part{self.rng.randrange(6)}.cpp"
        for side in ("source", "target"):
            file = self.root / side / name
            if file.exists():
                self.change(file, lambda data: re.sub(rb"\b[1-9]\b", str(number).encode(), data, count=1))

    def settle(self):
        self.run(*self.rng.choice([("accept", "--all"), ("accept", "--all", "--force"),
                                   ("ignore", "source/part1.cpp:fold_1", "--reason", "so"),
                                   ("defer", "source/part2.cpp:fold_2", "--owner", "me", "--until", "2999-01-01", "--reason", "later"),
                                   ("accept", "source/part3.cpp:fold_3")]))

    def map(self):
        file = self.root / "portmap.toml"
        if not file.exists():
            return self.back()
        text = file.read_text(errors="replace")
        kind = self.rng.randrange(5)
        if kind == 0:
            text += f'[[ignore]]\nid = "source/part{self.rng.randrange(6)}.cpp:*"\nreason = "so"\n'
        elif kind == 1:
            pairs = text.split("[[pair]]")
            if len(pairs) > 2:
                del pairs[self.rng.randrange(1, len(pairs))]
            text = "[[pair]]".join(pairs)
        elif kind == 2:
            text = text.replace("[[pair]]", '[[pair]]\nsource = "source/common.h:SCALE"\ntarget = "target/part1.cpp:fold_1"\n[[pair]]', 1)
        elif kind == 3 and "[rules]" not in text:
            text += '[rules]\n"target-changed" = "error"\nqualifiers = "note"\n'
        else:
            text = re.sub(r'reference = .*\n', "", text) if "reference" in text else text.replace("[sides]", '[sides]\nreference = "both"', 1)
        file.write_text(text)

    def whole_file(self):
        file = self.root / "portmap.toml"
        if file.exists():
            name = self.rng.randrange(6)
            file.write_text(file.read_text(errors="replace") + f'[[pair]]\nsource = "source/part{name}.cpp:@file"\ntarget = "target/part{name}.cpp:@file"\n')

    def lock(self):
        file = self.root / "portmap.lock"
        if file.exists():
            lines = file.read_bytes().splitlines(True)
            del lines[self.rng.randrange(len(lines))]
            file.write_bytes(b"".join(lines))

    def texts(self):
        files = sorted((self.root / "portmap.base").glob("*"))
        for file in self.rng.sample(files, min(5, len(files))):
            file.unlink()

    def back(self):
        """As it was committed, now or at first, or a commit of what is there."""
        kind = self.rng.randrange(4)
        if kind == 0 and self.run("check", "--no-cache")[0] != 2:
            return self.commit()
        self.git("read-tree", "-u", "--reset", self.first if kind == 1 else "HEAD")
        self.git("clean", "-q", "-f", "-d")

    def cache(self):
        files = sorted((self.home / "porttool").glob("*/*"))
        if not files:
            return
        file = self.rng.choice(files)
        data = bytearray(file.read_bytes())
        kind = self.rng.randrange(4)
        if kind == 0:
            file.unlink()
        elif kind == 1:
            file.write_bytes(data[:self.rng.randrange(len(data) + 1)])
        elif kind == 2 and data:
            data[self.rng.randrange(len(data))] ^= 1 << self.rng.randrange(8)
            file.write_bytes(data)
        else:
            file.write_bytes(self.rng.choice(files).read_bytes())  # another's


def main():
    rng = random.Random(SEED)
    answers, kinds, codes = set(), {}, {}
    with tempfile.TemporaryDirectory() as folder:
        project = Project(pathlib.Path(folder), rng)
        for number in range(EDITS):
            edits = [project.edit() for _ in range(rng.choice([1, 1, 1, 2, 4]))]
            asked = ["--format", rng.choice(FORMATS)]
            if rng.random() < 0.4:
                asked += rng.choice([["--base", "HEAD"], ["--staged"], ["--strict"], ["--base", "HEAD", "--trusted-map"], ["--spirv"]])
            without = project.run("check", "--no-cache", *asked)
            assert without[0] in (0, 1, 2), without
            for _ in range(rng.choice([1, 1, 2])):
                answer = project.run("check", *asked)
                if answer != without:
                    kept = pathlib.Path(tempfile.mkdtemp(prefix="porttool_cache_"))
                    shutil.copytree(folder, kept / "copy", symlinks=True)
                    sys.exit(f"edit {number} (seed {SEED}): {edits}, check {asked}: not what it is without the cache; see {kept}\n"
                             f"{without}\n{answer}"[:6000])
            answers.add(without)
            codes[without[0]] = codes.get(without[0], 0) + 1
            for edit in edits:
                kinds[edit] = kinds.get(edit, 0) + 1
            if without[0] == 2 and rng.random() < 0.7:
                project.back()
    assert len(answers) > EDITS / 4, "the edits change too little"
    print(f"{EDITS} edits, {len(answers)} different answers, all the same with the cache; exit codes {codes}; {kinds}")


if __name__ == "__main__":
    main()
