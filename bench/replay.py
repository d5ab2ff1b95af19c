#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Replays commits of public repositories through the gate, and counts what a reader said of its findings.

    bench/replay.py LIST --clones DIR -o OUT.json        the gate on each commit of LIST
    bench/replay.py --show OUT.json --template L.json    findings with the edits of both sides; labels to fill in
    bench/replay.py --labels L.json OUT.json             true, harmless and false ones by rule and level

A line of LIST is `owner/name TAB commit TAB source globs TAB target globs`, globs with spaces between them; `#` begins a
comment. DIR holds the clones as owner/name, name or name.git; bare ones do. Of each commit only what the globs name is
taken: at its first parent, where `porttool init` makes the map, and at the commit, where `porttool check --base` is
asked, both in a fresh repository. Nothing of a clone is run.

A label is `true` (whoever looks after the other side has to know), `harmless` (right, but nothing is left to do) or
`false`. It belongs to commit, rule and unit, so that it holds for the findings of another porttool, too.
"""
import argparse
import collections
import concurrent.futures
import difflib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LABELS = ("true", "harmless", "false")
MOST_LINES = 400  # shown of a side
KEY = ("commit", "rule", "unit")


def fail(message):
    print(f"replay.py: {message}", file=sys.stderr)
    sys.exit(2)


class Failed(Exception):
    """A commit that could not be replayed; the others can."""


def run(*words, **more):
    return subprocess.run([str(word) for word in words], capture_output=True, check=False, **more)


def git(folder, *words, **more):
    done = run("git", "-C", folder, *words, **more)
    if done.returncode:
        raise Failed(f"git {words[0]}: {' '.join(done.stderr.decode(errors='replace').split())}")
    return done.stdout


def without_braces(glob):
    found = re.search(r"\{([^{}]*)\}", glob)
    if not found:
        return [glob]
    return [each for part in found[1].split(",") for each in without_braces(glob[:found.start()] + part + glob[found.end():])]


def as_expression(globs):
    """A regular expression for the paths that the globs name, as porttool reads them."""
    spelled = {"**/": r"(?:.*/)?", "**": r".*", "*": r"[^/]*", "?": r"[^/]"}
    parts = []
    for glob in (each for glob in globs for each in without_braces(glob)):
        words = re.findall(r"\*\*/|\*\*|\*|\?|\[[^\]/]+\]|.", glob)
        parts.append("".join(spelled.get(w) or (w.replace("[!", "[^") if len(w) > 2 else re.escape(w)) for w in words))
    return re.compile("|".join(f"(?:{part})" for part in parts))


def read_list(path):
    commits = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        words = line.split("\t")
        if len(words) != 4 or not all(word.strip() for word in words) or words[1].startswith("-"):
            fail(f"{path}:{number}: expected owner/name, commit, source globs and target globs with tabs between them")
        commits.append({"repository": words[0], "commit": words[1], "source": words[2].split(), "target": words[3].split()})
    return commits


def clone_of(folder, repository):
    name = repository.rsplit("/", 1)[-1]
    for candidate in (repository, f"{repository}.git", name, f"{name}.git"):
        if (folder / candidate).is_dir():
            return folder / candidate
    return fail(f"{folder} has no {repository}, {name} or {name}.git; clone it there")


def put_files(clone, commit, named, folder):
    """The files of the commit that the globs name, and no others; links and submodules are left out."""
    for old in (path for path in folder.rglob("*") if path.is_file() and named.fullmatch(path.relative_to(folder).as_posix())):
        old.unlink()
    wanted = []
    for line in git(clone, "ls-tree", "-r", "-z", commit).decode(errors="surrogateescape").split("\0")[:-1]:
        (mode, _, blob), name = line.split("\t")[0].split(), line.split("\t", 1)[1]
        if mode.startswith("100") and named.fullmatch(name):
            wanted.append((blob, name))
    answer = git(clone, "cat-file", "--batch", input="".join(f"{blob}\n" for blob, _ in wanted).encode())
    at = 0
    for _, name in wanted:
        end = answer.index(b"\n", at)
        head = answer[at:end].split()
        if head[-1] == b"missing":  # a large file that a partial copy lacks
            at = end + 1
            continue
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(answer[end + 1:end + 1 + int(head[2])])
        at = end + 2 + int(head[2])


def texts_of(porttool, folder):
    """The text of each unit by its id."""
    done = run(porttool, "-C", folder, "scan", ".", "--format", "json")
    if done.returncode:
        raise Failed(done.stderr.decode(errors="replace").strip())
    lines = {}
    texts = {}
    for unit in json.loads(done.stdout)["units"]:
        if unit["file"] not in lines:
            lines[unit["file"]] = (folder / unit["file"]).read_text(errors="replace").split("\n")
        texts[unit["id"]] = "\n".join(lines[unit["file"]][unit["start_line"] - 1:unit["end_line"]])
    return texts


def record(folder, message):
    git(folder, "add", "--all", "--force")
    git(folder, "-c", "user.name=replay", "-c", "user.email=replay@localhost", "-c", "commit.gpgsign=false", "commit", "-q",
        "--allow-empty", "--no-verify", "-m", message)


def replay_in(folder, entry, clone, porttool):
    commit = git(clone, "rev-parse", "--verify", f"{entry['commit']}^{{commit}}").decode().strip()
    parent = git(clone, "rev-parse", "--verify", f"{commit}^1").decode().strip()
    named = as_expression(entry["source"] + entry["target"])
    git(folder, "init", "-q")
    put_files(clone, parent, named, folder)
    done = run(porttool, "-C", folder, "init", "--source", *entry["source"], "--target", *entry["target"])
    if done.returncode:
        raise Failed(done.stderr.decode(errors="replace").strip())
    record(folder, "before")
    before = texts_of(porttool, folder)
    put_files(clone, commit, named, folder)
    record(folder, "after")
    started = time.monotonic()
    done = run(porttool, "-C", folder, "check", "--base", "HEAD~1", "--no-cache", "--format", "json")
    if done.returncode not in (0, 1):
        raise Failed(done.stderr.decode(errors="replace").strip())
    seconds = round(time.monotonic() - started, 3)
    answer, after = json.loads(done.stdout), texts_of(porttool, folder)
    for finding in answer["findings"]:
        for side in (finding[side] for side in ("source", "target") if finding[side]):
            side.update(before=before.get(side["id"]), after=after.get(side["id"]))
    return {"commit": commit, "parent": parent, "exit_code": done.returncode, "check_seconds": seconds, "verdict": answer["verdict"],
            "summary": answer["summary"], "findings": answer["findings"]}


def replay(entry, clone, porttool):
    with tempfile.TemporaryDirectory() as name:
        try:
            result = {**entry, **replay_in(pathlib.Path(name), entry, clone, porttool)}
        except Failed as error:
            result = {**entry, "failed": str(error), "exit_code": None, "findings": []}
    told = result.get("failed") or f"{result['verdict']}, {len(result['findings'])} findings"
    print(f"{entry['repository']} {entry['commit'][:10]}: {told}", file=sys.stderr, flush=True)
    return result


def unit_of(finding):
    return "=".join(finding[side]["id"] for side in ("source", "target") if finding[side])


def findings_of(results):
    """Each error and warning with its commit, and the key that its label has; notes ask nothing of anybody."""
    for result in results:
        for finding in (finding for finding in result["findings"] if finding["level"] != "note"):
            yield result, finding, (result["commit"], finding["rule"], unit_of(finding))


def show_side(name, side):
    if side is None:
        return
    print(f"--- {name}: {side['id']}, {side['file']}:{side['line']}")
    before, after = ((side[when] or "").split("\n") for when in ("before", "after"))
    lines = list(difflib.unified_diff(before, after, lineterm="", n=MOST_LINES))[3:] or ["not edited:", *after]
    print("\n".join(lines[:MOST_LINES] + [f"... {len(lines) - MOST_LINES} lines more"] * (len(lines) > MOST_LINES)))


def show(results):
    for number, (result, finding, _) in enumerate(findings_of(results), 1):
        print(f"\n{'=' * 20} {number}: {result['repository']} {result['commit']}")
        print(f"{finding['rule']} ({finding['level']}, {finding['change']}): {finding['message']}\n{finding['remedy']}")
        for side in ("source", "target"):
            show_side(side, finding[side])


def template(results):
    """Labels to fill in, each key once."""
    found = {key: finding["message"] for _, finding, key in findings_of(results)}
    return [{**dict(zip(KEY, key)), "message": message, "label": "", "why": ""} for key, message in found.items()]


def read_labels(path):
    labels = {}
    for number, entry in enumerate(json.loads(path.read_text()), 1):
        if not all(isinstance(entry.get(word), str) for word in (*KEY, "label")) or entry["label"] not in ("", *LABELS):
            fail(f"{path}: entry {number}: expected commit, rule, unit and label, which is one of {', '.join(LABELS)}")
        labels[tuple(entry[word] for word in KEY)] = entry["label"]
    return labels


def count(results, labels):
    """Prints the table; labels of findings that are no more are counted beside it."""
    rows, said, red = collections.defaultdict(collections.Counter), set(), set()
    for result, finding, key in findings_of(results):
        label = labels.get(key) or "unlabelled"
        rows[finding["rule"], finding["level"]][label] += 1
        said.add(key)
        if label == "true" and finding["level"] == "error":
            red.add(result["commit"])
    rows["all", ""] = sum(rows.values(), collections.Counter())
    columns = (*LABELS, "unlabelled")
    print(f"{'rule':<24}{'level':<9}" + "".join(f"{column:>11}" for column in columns))
    for (rule, level), row in rows.items():
        print(f"{rule:<24}{level:<9}" + "".join(f"{row[column]:>11}" for column in columns))
    gone = collections.Counter(label for key, label in labels.items() if key not in said and label)
    print(f"red commits with a true error: {len(red)} of {sum(result['exit_code'] == 1 for result in results)}, of "
          f"{sum('failed' not in result for result in results)} replayed")
    print("labelled, and no finding now: " + (", ".join(f"{gone[label]} {label}" for label in LABELS if gone[label]) or "none"))


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("file", type=pathlib.Path, help="LIST; with one of the last three what -o wrote")
    parser.add_argument("--clones", type=pathlib.Path, metavar="DIR")
    parser.add_argument("--porttool", default=str(ROOT / "build/release/bin/porttool"))
    parser.add_argument("-o", dest="output", type=pathlib.Path, metavar="OUT.json")
    parser.add_argument("--jobs", type=int, default=1, choices=range(1, 65), metavar="N", help="commits at a time (1)")
    parser.add_argument("--show", action="store_true", help="print the findings with both sides' edits")
    parser.add_argument("--template", type=pathlib.Path, metavar="L.json", help="write labels to fill in")
    parser.add_argument("--labels", type=pathlib.Path, metavar="L.json", help="count what these labels say")
    arguments = parser.parse_args()
    arguments.replays = not (arguments.show or arguments.template or arguments.labels)
    if arguments.replays and not (arguments.clones and arguments.output):
        fail("a replay needs --clones DIR and -o OUT.json")
    if arguments.replays and not os.access(arguments.porttool, os.X_OK):
        fail(f"there is no program {arguments.porttool}; build it, or name it with --porttool")
    return arguments


def write_whole(path, data):
    part = path.with_name(path.name + ".part")
    part.write_text(json.dumps(data, indent=1) + "\n")
    part.replace(path)


def main():
    arguments = read_options()
    try:
        if arguments.replays:
            entries = [(entry, clone_of(arguments.clones, entry["repository"])) for entry in read_list(arguments.file)]
            with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
                results = list(pool.map(lambda each: replay(*each, arguments.porttool), entries))
            return write_whole(arguments.output, results)
        results = json.loads(arguments.file.read_text())
        if arguments.show:
            show(results)
        if arguments.template:
            write_whole(arguments.template, template(results))
        if arguments.labels:
            count(results, read_labels(arguments.labels))
    except (OSError, ValueError) as error:
        fail(error)
    return None


if __name__ == "__main__":
    main()
