#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Plants one-token edits in the kernels of one core and asks `pathtracer compare --locate --exact` where they part.

An answer is right if the kernel named is one that the edit can reach: by a call graph of names made here from the
texts and, where several kernels reach it, by rendering once more with the edit in that kernel alone (source side).
The source side needs no building (--kernels); for the target side the kernels of one lane are compiled, with the
commands of the build folder, and linked in front of the library into a core module of their own, which the program
loads from PATHTRACER_MODULES. Edits that do not compile, or never end, are left out.

--difftest: of each edit that changes a picture it is also asked whether `porttool difftest` names the function that was
edited; of a constant, a struct or a macro, a function that uses it. What it cannot run is counted by the reason.

--journal FILE: each answer is written there at once, and a run of the same texts and seed goes on where the last ended;
after a change of the programs take another file. At the end stands a table of the files that were edited.
"""
import argparse
import collections
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
KERNELS = ["generate", "extend", "shade", "connect", "finalize"]
SWAPS = {"+": "-", "-": "+", "*": "/", "/": "*", "<": ">=", ">": "<=", "<=": "<", ">=": ">", "==": "!=", "!=": "==",
         "&&": "||", "||": "&&", "min": "max", "max": "min", "true": "false", "false": "true", ".x": ".y", ".y": ".x",
         ".z": ".x", ".w": ".x"}
PROCESSOR_SECONDS = 60  # of a comparison; 2 to 5 are usual, on a machine with other work, too
TOKEN = re.compile(r"\.[xyzw]\b|[A-Za-z_]\w*|\d[\w.]*(?:[eE][-+]\d+\w*)?|"
                   r"<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%]=|\+\+|--|->|::|.", re.S)

# Errors whose kernel is known, and edits that change nothing: file, text that stands there once, text in its place.
PLANTED = [
    ("generate", "generate.glsl", "vec3(settings.screen_down) * y", "vec3(settings.screen_down) * x"),
    ("generate", "generate.glsl", "path_ray.cone_spread = settings.eye.w", "path_ray.cone_spread = 0.0f"),
    ("extend", "extend.glsl", "throughput.weight * sky.radiance", "sky.radiance"),
    ("extend", "trace.glsl", "walk_tree(ray, NO_HIT, ray_key(path, RAY_EXTENSION), false)",
     "walk_tree(ray, 2.0f, ray_key(path, RAY_EXTENSION), false)"),
    ("shade", "shade.glsl", "pass.segment >= 3u", "pass.segment >= 2u"),
    ("shade", "bsdf.glsl", "vec3 wi = select(reflects, reflected, passed);",
     "vec3 wi = select(reflects, passed, reflected);"),
    ("connect", "connect.glsl", "trace_any(ray, origin.w, path)", "trace_any(ray, 1.0e30f, path)"),
    ("connect", "connect.glsl", "radiance, !blocked", "radiance, true"),
    ("finalize", "finalize.glsl", "sum * pass.sample_scale", "radiance * pass.sample_scale"),
    ("finalize", "finalize.glsl", "load_accumulator(pixel)) + radiance", "load_accumulator(pixel)) - radiance"),
]
NEUTRAL = [
    (None, "math.glsl", "#ifndef MATH_GLSL", "// Nothing new.\n#ifndef MATH_GLSL"),
    (None, "generate.glsl", "Float(column) + jitter.x", "jitter.x + Float(column)"),
    (None, "generate.glsl", "throughput.pdf = 0.0f", "throughput.pdf = 0.00f"),
    (None, "extend.glsl", "hit.instance == NONE", "NONE == hit.instance"),
    (None, "shade.glsl", "pass.segment >= 3u", "pass.segment > 2u"),
    (None, "shade.glsl", "0.25f * max(bsdf.pick_diffuse, bsdf.alpha)", "max(bsdf.pick_diffuse, bsdf.alpha) * 0.25f"),
    (None, "bsdf.glsl", "wi = select(bsdf.is_smooth && wrong_side, mirrored(wi, bsdf.side), wi);",
     "wi = select(!(bsdf.is_smooth && wrong_side), wi, mirrored(wi, bsdf.side));"),
    (None, "bsdf.glsl", "Mask reflects = lobe < reflecting;", "Mask reflects = reflecting > lobe;"),
    (None, "connect.glsl", "load_path_radiance(rows_from(path)) + load_shadow_contribution(job)",
     "load_shadow_contribution(job) + load_path_radiance(rows_from(path))"),
    (None, "finalize.glsl", "vec3(load_accumulator(pixel)) + radiance", "radiance + vec3(load_accumulator(pixel))"),
]


def blanked(text):
    """The text with comments and preprocessor lines as blanks."""
    blank = lambda m: re.sub(r"[^\n]", " ", m.group(0))
    text = re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)


def declarations(text):
    """(name, start, end) of all that stands at the top level of a file."""
    plain = re.sub(r"^(namespace [\w:]+ \{|\}.*// namespace.*)", lambda m: " " * len(m.group(0)), text, flags=re.M)
    plain = blanked(plain)
    found, depth, start = [], 0, 0
    for at, c in enumerate(plain):
        depth += (c == "{") - (c == "}")
        if depth == 0 and c in ";}":
            piece = plain[start:at + 1]
            head = re.match(r"[^(={;]*", piece).group(0)
            names = re.findall(r"[A-Za-z_]\w*", head)
            if names:
                found.append((names[-1], start, at + 1))
            start = at + 1
    return found


def mutation(token, before):
    if re.fullmatch(r"\d+\.\d*(e-?\d+)?f", token):
        value = float(token[:-1])
        return {0.0: "1.0f", 1.0: "0.5f"}.get(value, repr(value * 1.1) + "f")
    if re.fullmatch(r"\d+u", token):
        return f"{int(token[:-1]) + 1}u"
    if token in "+-*/" and not re.match(r"[\w)\]]", before):
        return None  # a sign
    return SWAPS.get(token)


class Side:
    def __init__(self, name):
        self.name = name
        self.folder = ROOT / f"{name}_core" / "kernels"
        self.entry = ".comp" if name == "source" else ".cpp"
        self.files = {p.name: p.read_text() for p in sorted(self.folder.iterdir())}
        self.uses = {}
        for file, text in self.files.items():
            for unit, start, end in declarations(text):
                node = f"{file}:main" if unit == "main" else unit
                self.uses.setdefault(node, set()).update(re.findall(r"[A-Za-z_]\w*", blanked(text)[start:end]))

        if name == "target":  # Embree calls back what both kinds of rays need
            called = blanked((ROOT / "target_core/device/embree_callbacks.cpp").read_text())
            for trace in ("trace_closest", "trace_any"):
                self.uses[trace].update(re.findall(r"[A-Za-z_]\w*", called))

    def reach(self, kernel):
        todo, seen = [kernel + ".comp:main" if self.name == "source" else kernel], set()
        while todo:
            node = todo.pop()
            if node not in seen and node in self.uses:
                seen.add(node)
                todo.extend(self.uses[node])
        return seen

    def edits(self):
        """All one-token edits of what a kernel of KERNELS uses: (file, unit, start, end, new text)."""
        result, used = [], set().union(*map(self.reach, KERNELS))
        for file, text in self.files.items():
            if file in ("schedule.comp", "kernels.h", "bindings.h"):
                continue
            plain = blanked(text)
            for unit, start, end in declarations(text):
                if (f"{file}:main" if unit == "main" else unit) not in used:
                    continue  # of the filter, which no comparison runs
                before = ""
                angle = plain[start:end].lstrip().startswith("template")
                for token in TOKEN.finditer(plain, start, end):
                    new = mutation(token.group(0), before)
                    if new and not (angle and token.group(0) in "<>"):
                        result.append((file, unit, token.start(), token.end(), new))
                    if not token.group(0).isspace():
                        before = token.group(0)[-1]
        return result


def compare(program, scene, size, kernels=None, modules=None):
    """What `compare --locate` prints as JSON, or why it prints nothing."""
    command = [program, "compare", *scene, "--size", size, "--spp", "3", "--exact", "--locate", "--format", "json"]
    command += ["--kernels", str(kernels)] if kernels else []
    environment = {**os.environ, "PATHTRACER_MODULES": str(modules)} if modules else None
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=600, env=environment,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, ) * 2))
    except subprocess.TimeoutExpired:
        return "it stalls"
    if done.returncode == 0:
        return json.loads(done.stdout)
    never_ends = done.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
    return "it never ends" if never_ends else (done.stderr.strip().splitlines() or [f"ends with {done.returncode}"])[-1]


class SourceTrial:
    def __init__(self, side, program, folder):
        self.side, self.program, self.folder = side, program, folder

    def write(self, files):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir()
        for name, text in files.items():
            (self.folder / name).write_text(text)

    def prepare(self, file, text):
        self.write({**self.side.files, file: text})
        return True  # the program compiles it

    def prepare_alone(self, file, text, kernel):
        """The edit in one kernel; the others include files of other names, which are as they were."""
        as_was = {"was_" + name: body.replace('#include "', '#include "was_') for name, body in self.side.files.items()}
        files = {**self.side.files, **as_was, file: text}
        for other in KERNELS + ["schedule"]:
            if other != kernel:
                files[other + ".comp"] = as_was["was_" + other + ".comp"]
        self.write(files)

    def run(self, scene, size):
        return compare(self.program, scene, size, self.folder)


class TargetTrial:
    def __init__(self, side, program, folder):
        self.side, self.folder, self.program = side, folder, program
        self.build = pathlib.Path(program).resolve().parent.parent
        commands = json.loads((self.build / "compile_commands.json").read_text())
        self.compile = {pathlib.Path(c["file"]).name: c for c in commands if "/target_core/" in c["file"]}
        module = next(self.build.glob("lib*/**/pathtracer-core-target.so"))
        self.modules = folder / "modules"
        self.modules.mkdir(parents=True)
        for other in module.parent.glob("*.so"):
            if other.name != module.name:
                shutil.copy(other, self.modules)
        link = subprocess.run(["ninja", "-C", str(self.build), "-t", "commands", "-s",
                               str(module.relative_to(self.build))],
                              capture_output=True, text=True, check=True).stdout.strip().splitlines()[-1]
        self.link = re.search(r"&& (.*?) && :", link).group(1)
        self.tree = folder / "tree"
        self.tree.mkdir(parents=True)
        for part in ("render_system", "source_core"):
            (self.tree / part).symlink_to(ROOT / part)
        shutil.copytree(ROOT / "target_core", self.tree / "target_core")
        self.module = str(self.modules / module.name)

    def closure(self, file):
        text = (self.tree / file).read_text() if (self.tree / file).is_file() else ""
        return {file}.union(*map(self.closure, re.findall(r'#include "(target_core/[^"]+)"', text)))

    def prepare(self, file, text):
        for name, body in self.side.files.items():
            (self.tree / "target_core/kernels" / name).write_text(text if name == file else body)
        units = [f"target_core/kernels/{k}.cpp" for k in KERNELS] + ["target_core/device/embree_callbacks.cpp"]
        objects = []
        for unit in units:
            if f"target_core/kernels/{file}" not in self.closure(unit):
                continue
            words = shlex.split(self.compile[pathlib.Path(unit).name]["command"])
            words = [w for w in words if w not in ("-O3", "-O2") and not w.endswith("ccache") and w != f"-I{ROOT}"]
            words = words[words.index(next(w for w in words if w.endswith("c++"))):]
            output = str(self.folder / (pathlib.Path(unit).stem + ".o"))
            words[words.index("-o") + 1] = output
            words[-1] = str(self.tree / unit)
            done = subprocess.run(words[:1] + ["-O1", f"-I{self.tree}"] + words[1:], capture_output=True, text=True,
                                  cwd=self.build)
            if done.returncode:
                return False
            objects.append(output)
        link = re.sub(r"-o \S+", f"{' '.join(objects)} -o {self.module}", self.link, count=1)
        return subprocess.run(link, shell=True, cwd=self.build, capture_output=True).returncode == 0

    def run(self, scene, size):
        return compare(self.program, scene, size, modules=self.modules)


class Difftest:
    """A copy of the tree, in which one file at a time is edited."""

    MOST_USERS = 12

    def __init__(self, side, program, folder):
        self.side, self.program, self.folder = side, str(pathlib.Path(program).resolve()), folder
        for part in ("source_core", "target_core", "render_system"):
            shutil.copytree(ROOT / part, folder / part)
        for part in ("portmap.toml", "portmap.lock"):
            shutil.copy(ROOT / part, folder)
        shutil.copytree(ROOT / "portmap.base", folder / "portmap.base")
        with open(ROOT / "portmap.toml", "rb") as file:
            told = [pair[side.name] for pair in tomllib.load(file)["pair"]]  # a pair may have several targets
        self.ids = {one for ids in told for one in ([ids] if isinstance(ids, str) else ids)}

    def units(self, file, unit):
        """The ids to ask: that of the function, or those of what uses what is none."""
        prefix = f"{self.side.name}_core/kernels/"
        own = [i for i in self.ids if i.startswith(f"{prefix}{file}:") and re.sub(r"#\d+$", "", i).endswith(":" + unit)]
        users = [name for name, used in self.side.uses.items() if unit in used and name != unit]
        return sorted(own), sorted(i for i in self.ids if i.startswith(prefix) and
                                   re.split(r"[:#]+", i.split("/")[-1], maxsplit=1)[-1].split("::")[-1].split("#")[0]
                                   in users)[:self.MOST_USERS]

    def ask(self, ids):
        if not ids:
            return []  # the command would take all pairs
        command = [self.program, "-C", str(self.folder), "difftest", *ids, "--ulps", "0", "--inputs", "20000",
                   "--format", "json"]
        done = subprocess.run(command, capture_output=True, text=True)
        return [(pair["state"], pair.get("reason") or "") for pair in json.loads(done.stdout)["pairs"]]

    def judge(self, edit, text):
        """Whether it names the function, and why not: "named", "same" or the reason why it is not run."""
        file, unit, *_ = edit
        place = self.folder / f"{self.side.name}_core/kernels" / file
        as_it_was = place.read_text()
        place.write_text(text)
        own, users = self.units(file, unit)
        said = self.ask(own)
        if all(state == "not_run" and "is no function" in reason for state, reason in said):
            said = []
            for user in users:
                said += self.ask([user])
                if said[-1][0] == "differs":
                    break
            said = said or [("not_run", "nothing that is paired uses it")]
        place.write_text(as_it_was)
        if any(state == "differs" for state, _ in said):
            return "named"
        return "same" if any(state == "same" for state, _ in said) else said[0][1]


class Journal:
    """What is known of each edit, kept in a file of one JSON object a line. It holds for the texts that it was made of."""

    def __init__(self, path, side):
        texts = [p.read_bytes() for name in ("source", "target")
                 for p in sorted((ROOT / f"{name}_core" / "kernels").iterdir())]
        self.texts = hashlib.sha256(b"\0".join(texts)).hexdigest()[:16]
        self.path, self.side, self.known = path, side, {}
        for line in pathlib.Path(path).read_text().splitlines() if path and pathlib.Path(path).exists() else []:
            entry = json.loads(line)
            if entry["texts"] == self.texts and entry["side"] == side:
                self.known[tuple(entry["edit"])] = entry["answer"]

    def get(self, edit):
        return self.known.get(tuple(edit))

    def put(self, edit, answer):
        if self.path:
            with open(self.path, "a") as file:
                print(json.dumps({"side": self.side, "texts": self.texts, "edit": edit, "answer": answer}), file=file)


def table(answers, with_difftest):
    """What became of the edits, by the file that was edited."""
    rows = collections.defaultdict(collections.Counter)
    for edit, answer in answers:
        row = rows[edit[0]]
        row[answer["verdict"]] += 1
        row["named"] += answer.get("difftest") == "named"
    rows["all"] = sum(rows.values(), collections.Counter())
    print(f"{'file':<20} {'changed':>8} {'kernel':>8}" + (f" {'function':>9}" if with_difftest else "") +
          f" {'no change':>10} {'left out':>9}")
    for file, row in sorted(rows.items(), key=lambda item: (item[0] == "all", item[0])):
        changed = row["right"] + row["wrong"]
        same = row["no difference"] + row["state alone, right"] + row["state alone, wrong"]
        print(f"{file:<20} {changed:>8} {row['right']:>8}" + (f" {row['named']:>9}" if with_difftest else "") +
              f" {same:>10} {row['does not compile'] + row['does not run']:>9}")


def judge(trial, side, scenes, edit, text):
    """One of: left out, no difference (with or without an alarm), right, wrong; and what was said."""
    file, unit, *_ = edit
    if not trial.prepare(file, text):
        return "does not compile", None
    for name, (scene, size) in scenes.items():
        result = trial.run(scene, size)
        if isinstance(result, str):
            return "does not run", result
        changed = any(r["identical_pixels"] < 1.0 for r in result["results"])
        first = result["locate"]["first"]
        if not changed and first is None:
            continue
        if first is None:
            return "wrong", "nothing"
        said = f"{name}: segment {first['segment']}, {first['kernel']}, {first['field']}"
        node = f"{file}:main" if unit == "main" else unit
        reaching = [k for k in KERNELS if node in side.reach(k)]
        right = first["kernel"] in reaching
        if right and len(reaching) > 1 and isinstance(trial, SourceTrial):
            trial.prepare_alone(file, text, first["kernel"])
            alone = trial.run(scene, size)
            right = not isinstance(alone, str) and alone["locate"]["first"] is not None
            trial.prepare(file, text)
        if not changed:
            return "state alone, " + ("right" if right else "wrong"), said
        return ("right" if right else "wrong"), said
    return "no difference", None


def known_edits(trial, side, scenes, difftest):
    """Tries PLANTED and NEUTRAL; the number of wrong answers."""
    wrong = 0
    units = {file: declarations(text) for file, text in side.files.items()}
    for kernel, file, old, new in PLANTED + NEUTRAL:
        text = side.files[file]
        assert text.count(old) == 1, (file, old)
        at = text.index(old)
        unit = next((name for name, start, end in units[file] if start <= at < end), None)
        trial.prepare(file, text.replace(old, new))
        results = [trial.run(scene, size) for scene, size in scenes.values()]
        failed = [result for result in results if isinstance(result, str)]
        if failed:
            sys.exit(f"{file}: {old} -> {new}: {failed[0]}; are {' and '.join(scenes)} there?")
        firsts = [result["locate"]["first"] for result in results]
        said = [first and first["kernel"] for first in firsts]
        right = set(said) - {None} == ({kernel} if kernel else set())
        if difftest and unit:
            answer = difftest.judge((file, unit), text.replace(old, new))
            right = right and answer == ("named" if kernel else "same")
            said = f"{said}; difftest, {unit}: {answer}"
        wrong += not right
        print(f"{'right' if right else 'wrong'}: {file}: {old} -> {new}; {kernel}: {said}", flush=True)
    return wrong


def random_edits(arguments, trial, side, scenes, difftest):
    """Tries edits until as many as asked for changed a picture; (edit, answer) of each."""
    edits = side.edits()
    random.Random(arguments.seed).shuffle(edits)
    journal, answers, changed = Journal(arguments.journal, arguments.side), [], 0
    for edit in edits:
        if changed == arguments.edits:
            break
        file, unit, start, end, new = edit
        text = side.files[file]
        edited = text[:start] + new + text[end:]
        answer = journal.get(edit)
        if not answer:
            verdict, said = judge(trial, side, scenes, edit, edited)
            answer = {"verdict": verdict, "said": said}
        does_change = answer["verdict"] in ("right", "wrong")
        if difftest and does_change and "difftest" not in answer:
            answer["difftest"] = difftest.judge(edit, edited)
        if answer != journal.get(edit):
            journal.put(edit, answer)
        answers.append((edit, answer))
        changed += does_change
        line = text.count("\n", 0, start) + 1
        print(f"{answer['verdict']}: {file}:{line} {unit}: {text[start:end]} -> {new}; {answer['said'] or '-'}" +
              (f"; difftest: {answer['difftest']}" if "difftest" in answer else ""), flush=True)
    return answers


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--side", choices=["source", "target"], default="source")
    parser.add_argument("--edits", type=int, default=120, help="how many edits that change a picture")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/pathtracer"))
    parser.add_argument("--parity", default=str(ROOT / "build/release/tests/application/parity"),
                        help="folder of the parity scene, rendered where the built-in scene shows no difference")
    parser.add_argument("--difftest", action="store_true", help="ask `porttool difftest`, beside the program, as well")
    parser.add_argument("--journal", help="file that keeps the answers, for a run that goes on where another ended")
    parser.add_argument("--known", action="store_true", help="ten errors and ten edits that change nothing instead")
    arguments = parser.parse_args()
    scenes = {"still_life": (["still_life"], "64x36"),
              "parity": ([arguments.parity + "/parity.gltf", "--sky", arguments.parity + "/sky.hdr"], "96x54")}
    side = Side(arguments.side)
    with tempfile.TemporaryDirectory() as folder:
        make = SourceTrial if arguments.side == "source" else TargetTrial
        trial = make(side, arguments.program, pathlib.Path(folder) / "edited")
        difftest = None
        if arguments.difftest:
            difftest = Difftest(side, pathlib.Path(arguments.program).parent / "porttool", pathlib.Path(folder) / "tested")
        if arguments.known:
            return min(known_edits(trial, side, scenes, difftest), 1)
        answers = random_edits(arguments, trial, side, scenes, difftest)
    table(answers, difftest)
    reasons = collections.Counter(answer["difftest"] for _, answer in answers if answer.get("difftest"))
    if reasons:
        print(f"difftest: {reasons['named']} of {sum(reasons.values())} named;", dict(reasons.most_common()))
    wrong = sum(answer["verdict"] == "wrong" for _, answer in answers)
    return 0 if wrong <= 0.05 * arguments.edits else 1


if __name__ == "__main__":
    sys.exit(main())
