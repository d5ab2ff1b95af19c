#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a git repository with two code bases and a long history: bench/make_history.py DIR [COMMITS] [LINES]

DIR holds GLSL-like kernels in gpu/ and their C++-like ports in cpu/, LINES lines in all (50,000), with a portmap.toml that
pairs their functions. Each of the COMMITS (1,000) edits one to three functions: most edits reach both sides, some the
ports only later, some never; files are added, renamed and deleted now and then. The same arguments give the same
repository. To measure: time porttool -C DIR history -o history.csv --format csv, twice.
"""
import pathlib
import random
import subprocess
import sys

FUNCTIONS_A_FILE = 16
STATEMENTS_A_FUNCTION = 12
START = 1_600_000_000  # seconds since 1970 of the first commit
BETWEEN = 9 * 3600
NAMES = "albedo weight normal sample pdf radiance cosine depth offset scale bias factor energy sum light angle".split()
CALLS = [("mix", "lerp"), ("inversesqrt", "rsqrtf"), ("max", "fmaxf"), ("min", "fminf"), ("abs", "fabsf"),
         ("floor", "floorf"), ("sqrt", "sqrtf")]


class Function:
    """One function in a form that both languages can be written from."""

    def __init__(self, name, rng):
        self.name = name
        self.body = [statement(i, rng) for i in range(rng.randint(8, STATEMENTS_A_FUNCTION + 8))]


def statement(number, rng):
    """(kind, variable, operands): `kind` numbers a shape of statement."""
    return (rng.randrange(4), f"{rng.choice(NAMES)}_{number}", rng.choice(NAMES), rng.choice(NAMES),
            round(rng.uniform(0.01, 9.0), 3), rng.randrange(len(CALLS)))


def write_statement(parts, cpp):
    kind, variable, a, b, number, call = parts
    literal = f"{number}f" if cpp else f"{number}"
    vector = "float3" if cpp else "vec3"
    function = CALLS[call][1 if cpp else 0]
    if kind == 0:
        return [f"    float {variable} = {a} * {literal} + {function}({b}, {literal});"]
    if kind == 1:
        return [f"    {vector} {variable} = {vector}({a}, {b}, {literal});"]
    if kind == 2:
        return [f"    if ({a} > {literal}) {{", f"        {b} -= {function}({a} - {b}, {literal});", "    }"]
    return [f"    {a} = {function}({a} * {b}, {literal});  // keeps {variable} in range"]


def write_function(function, body, cpp):
    head = "inline float" if cpp else "float"
    parameters = ", ".join(f"float {name}" for name in NAMES[:6])
    lines = [f"{head} {function.name}({parameters}) {{"]
    for parts in body:
        lines += write_statement(parts, cpp)
    return lines + [f"    return {NAMES[0]};", "}", ""]


class Repository:
    """Both sides as they stand; what a commit changed is written by `flush`."""

    def __init__(self, rng, lines):
        self.rng = rng
        self.files = {}  # stem -> functions
        self.ports = {}  # (stem, function) -> the port's body, where it lags behind
        self.dirty = set()
        self.gone = []
        self.map_changed = True
        self.next_file = 0
        count = 0
        while count < lines:
            stem = self.add_file()
            count += sum(text.count("\n") for text in (self.text(stem, False), self.text(stem, True)))

    def add_file(self):
        stem = f"block{self.next_file:04}"
        self.next_file += 1
        self.files[stem] = [Function(f"{stem}_f{i}", self.rng) for i in range(FUNCTIONS_A_FILE)]
        self.dirty |= {(stem, False), (stem, True)}
        self.map_changed = True
        return stem

    def drop_file(self, stem):
        del self.files[stem]
        self.gone += [path_of(stem, False), path_of(stem, True)]
        self.dirty = {(name, cpp) for name, cpp in self.dirty if name != stem}
        self.map_changed = True

    def rename_file(self, stem):
        functions = self.files[stem]
        self.drop_file(stem)
        self.files[stem + "r"] = functions
        self.dirty |= {(stem + "r", False), (stem + "r", True)}

    def edit(self):
        stem = self.rng.choice(sorted(self.files))
        function = self.rng.choice(self.files[stem])
        key = (stem, function.name)
        fate = self.rng.random()
        before = list(function.body)
        at = self.rng.randrange(len(function.body))
        if self.rng.random() < 0.6:
            function.body[at] = statement(at, self.rng)
        else:
            function.body.insert(at, statement(len(function.body), self.rng))
        self.dirty.add((stem, False))
        if fate < 0.7:  # ported at once
            self.ports.pop(key, None)
            self.dirty.add((stem, True))
        elif key not in self.ports:  # the port stays behind
            self.ports[key] = before

    def catch_up(self):
        """Ports what has waited."""
        if not self.ports:
            return
        stem, name = self.rng.choice(sorted(self.ports))
        del self.ports[(stem, name)]
        if stem in self.files:
            self.dirty.add((stem, True))

    def text(self, stem, cpp):
        lines = ["// Made by bench/make_history.py", ""]
        for function in self.files[stem]:
            body = self.ports.get((stem, function.name), function.body) if cpp else function.body
            lines += write_function(function, body, cpp)
        return "\n".join(lines)

    def map_text(self):
        lines = ["version = 1", "[sides]", 'source = ["gpu/*"]', 'target = ["cpu/*"]']
        for stem in sorted(self.files):
            for function in self.files[stem]:
                lines += ["[[pair]]", f'source = "{path_of(stem, False)}:{function.name}"',
                          f'target = "{path_of(stem, True)}:{function.name}"']
        return "\n".join(lines) + "\n"

    def flush(self, write, drop):
        for path in self.gone:
            drop(path)
        for stem, cpp in sorted(self.dirty):
            write(path_of(stem, cpp), self.text(stem, cpp))
        if self.map_changed:
            write("portmap.toml", self.map_text())
        self.gone, self.dirty, self.map_changed = [], set(), False


def path_of(stem, cpp):
    return f"cpu/{stem}.cpp" if cpp else f"gpu/{stem}.glsl"


def change(repository, rng):
    """What one commit does."""
    for _ in range(rng.randint(1, 3)):
        repository.edit()
    kind = rng.random()
    if kind < 0.15:
        repository.catch_up()
    elif kind < 0.16:
        repository.add_file()
    elif kind < 0.165:
        repository.drop_file(rng.choice(sorted(repository.files)))
    elif kind < 0.17:
        repository.rename_file(rng.choice(sorted(repository.files)))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    commits = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    lines = int(sys.argv[3]) if len(sys.argv) > 3 else 50_000
    folder.mkdir(parents=True)
    subprocess.run(["git", "init", "-q", "-b", "main", folder], check=True)
    rng = random.Random(1)
    repository = Repository(rng, lines)
    git = subprocess.Popen(["git", "-C", folder, "fast-import", "--quiet"], stdin=subprocess.PIPE)

    def say(text):
        git.stdin.write(text.encode())

    for number in range(commits):
        if number > 0:
            change(repository, rng)
        message = f"Commit {number}"
        say(f"commit refs/heads/main\ncommitter Bench <bench@localhost> {START + number * BETWEEN} +0000\n"
            f"data {len(message)}\n{message}\n")
        repository.flush(lambda path, text: say(f"M 644 inline {path}\ndata {len(text)}\n{text}\n"),
                         lambda path: say(f"D {path}\n"))
    git.stdin.close()
    if git.wait() != 0:
        sys.exit("git fast-import failed")
    subprocess.run(["git", "-C", folder, "reset", "-q", "--hard", "main"], check=True)


if __name__ == "__main__":
    main()
