#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""bench/thesis.py: thesis_test.py PATHTRACER PORTTOOL. Exit code 77 (skipped) where a core cannot run here."""
import copy
import hashlib
import html
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))
import equal_time  # noqa: E402
import thesis  # noqa: E402
import thesis_pack  # noqa: E402
import thesis_page  # noqa: E402
import thesis_sections  # noqa: E402
from thesis_measure import Measurements, Scene, measure_pictures  # noqa: E402
SCRIPT = ROOT / "bench/thesis.py"
STORED = ROOT / "docs/thesis-numbers.md"
PATHTRACER, PORTTOOL = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])


def run(*words):
    return subprocess.run([sys.executable, str(SCRIPT), *map(str, words)], capture_output=True, text=True, check=False)


def structure(page):
    """Titles, heads of tables, names of rows and captions of a Markdown page, in their order, without those of scenes other
    than the still life and without how many samples there are."""
    lines = []
    for section in re.split(r"^(?=## )", page, flags=re.M)[1:]:
        if re.match(r"## (Table 1|Figures).*[ ](?!still_life$)\w+$", section, re.M):
            continue
        for title, table, row, caption in re.findall(r"^(## .*)|^(\| .*)\n\| --- |^\| (?!\d+ \||---)(.*?) \||^!\[(.*?)\]\(", section, re.M):
            lines.append(re.sub(r"\d+ samples", "samples", title or table or row or caption))
    return lines


class QuickRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.first = cls.quick()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def quick(cls, *more):
        return run("--quick", "-o", cls.folder, "--program", PATHTRACER, "--porttool", PORTTOOL, *more)

    def times(self):
        return {file.name: file.stat().st_mtime_ns for file in (self.folder / "measured").iterdir()}

    def test_1_has_the_stored_structure(self):
        self.assertEqual(self.first.returncode, 0, self.first.stderr)
        self.assertEqual((self.folder / "outline.txt").read_text(), (ROOT / "bench/thesis_outline.txt").read_text(),
                         "bench/thesis_outline.txt is the outline.txt of a quick run")

    def test_1_has_the_structure_of_the_page_that_is_kept(self):
        quick = structure((self.folder / "thesis.md").read_text())
        self.assertGreater(len(quick), 70)
        self.assertEqual(quick, structure(STORED.read_text()), "make the page anew: bench/thesis.py --keep docs/thesis-numbers.md")

    def test_2_shows_what_was_measured(self):
        text = (self.folder / "thesis.md").read_text()
        same = json.loads((self.folder / "measured/still_life_same.json").read_text())["result"]["results"][0]
        self.assertIn(f"| 1 | {same['ssim']:.4f} | {same['rmse']:.2f} |", text)
        row = re.search(r"^\| 4 \|(.*)$", text, re.M)[1].split("|")
        for ours, itself, apart in zip(row[2:4], row[4:6], (0.002, 0.2)):
            self.assertAlmostEqual(float(ours), float(itself), delta=apart,
                                   msg="with a seed each the cores differ as the target core does from itself")
        device = next(core["device"] for core in json.loads((self.folder / "measured/info.json").read_text())["result"]["cores"]
                      if core["id"] == "source")
        self.assertEqual("This machine has no GPU" in text, "llvmpipe" in device)
        page = (self.folder / "thesis.html").read_text()
        self.assertIn("data:image/png;base64,", page)
        self.assertNotRegex(page, r'(src|href)="?(http|pictures)')
        for picture in re.findall(r"\]\((pictures/[^)]*)\)", text):
            self.assertTrue((self.folder / picture).is_file(), picture)

    def test_2_draws_what_the_tables_say(self):
        rays = json.loads((self.folder / "measured/still_life_diffuse_source.json").read_text())["result"]["rays"]
        chart = (self.folder / "pictures/charts/still_life_figure_13.svg").read_text()
        bars = chart[chart.index(">source core, diffuse<"):].split("<text")[0]
        widths = [float(width) for width in re.findall(r'width="([0-9.]+)"', bars)]
        for width, kind in zip(widths, ("primary", "extension", "shadow"), strict=True):
            self.assertAlmostEqual(width / sum(widths), rays[kind] / rays["total"], delta=0.001)

    def test_3_goes_on_after_an_interruption_and_says_what_is_missing(self):
        before = self.times()
        (self.folder / "measured/still_life_bias.json").write_text("")  # a machine that lost its power
        (self.folder / "measured/still_life_other_1.new").write_text("{")
        again = self.quick("--scene", "missing/town.gltf")
        self.assertEqual(again.returncode, 0, again.stderr)
        after = self.times()
        self.assertEqual({name for name in before if after[name] != before[name]}, {"still_life_bias.json"})
        self.assertRegex((self.folder / "thesis.md").read_text(), r"Left out: town, there is no \S*missing/town.gltf\.")

    def test_3_goes_on_where_it_was_killed(self):
        (self.folder / "measured/still_life_other_4.json").unlink()
        (self.folder / "measured/still_life_bias.json").unlink()
        before = self.times()
        first = self.folder / "measured/still_life_other_4.json"
        killed = subprocess.Popen([sys.executable, str(SCRIPT), "--quick", "-o", str(self.folder), "--program", PATHTRACER, "--porttool",
                                   PORTTOOL], start_new_session=True, stdout=subprocess.DEVNULL)
        while not first.is_file() and killed.poll() is None:
            time.sleep(0.01)
        os.killpg(killed.pid, signal.SIGKILL)
        killed.wait()
        self.assertFalse((self.folder / "measured/still_life_bias.json").is_file(), "killed before that was measured")
        taken = first.stat().st_mtime_ns
        again = self.quick()
        self.assertEqual(again.returncode, 0, again.stderr)
        after = self.times()
        self.assertEqual(after.pop("still_life_other_4.json"), taken, "not measured twice")
        self.assertEqual({name for name in after if after[name] != before.get(name)}, {"still_life_bias.json"})

    def test_4_scenes_are_told_apart_and_what_is_none_is_left_out(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for scene in ("a/town.gltf", "b/town.gltf", "city.gltf", "a b|c.gltf"):
                (folder / scene).parent.mkdir(exist_ok=True)
                (folder / scene).write_text("{}")
            (folder / "town.glb").write_bytes(b"glTF\xff")
            odd = ('{"materials": 3}', '{"materials": [{"pbrMetallicRoughness": null}]}', '{"materials": [{"extensions": []}]}',
                   '{"extensionsUsed": 3}', '{"extensionsUsed": [{}]}', "[" * 200000, '{"extras": ' + "[" * 900 + "]" * 900 + "}")
            for number, text in enumerate(odd):
                (folder / f"odd{number}.gltf").write_text(text)
            words = [word for file in ("a/town.gltf", "b/town.gltf", "city.gltf", "town.glb", "a b|c.gltf",
                                       *(f"odd{number}.gltf" for number in range(len(odd)))) for word in ("--scene", file)]
            done = subprocess.run([sys.executable, str(SCRIPT), "--quick", "-o", str(self.folder), "--program", PATHTRACER,
                                   "--porttool", PORTTOOL, *words], capture_output=True, text=True, check=False, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "thesis.md").read_text()
        self.assertIn("still_life; and town, town_2, city_2, a_b_c.", text)
        self.assertIn("left out: town_2_same: ", done.stderr)
        self.assertRegex(text, r"Left out: town_3, since \S*town.glb is no .gltf file")
        for number in range(len(odd)):
            self.assertRegex(text, rf"Left out: odd{number}, since \S*odd{number}.gltf is no .gltf file")
        self.assertRegex(text, r"Left out: town_2_same: .*b/town.gltf")

    def test_4_a_machine_that_renders_nothing_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run("--quick", "-o", folder, "--program", "/bin/false", "--porttool", PORTTOOL)
            self.assertEqual(done.returncode, 1)
            self.assertIn("nothing could be measured", done.stderr)
            self.assertIn("Left out: parts of still_life", (pathlib.Path(folder) / "thesis.md").read_text())

    def test_5_packs_are_read_back_or_refused(self):
        before = self.times()
        pack = self.folder / "gpu.zip"
        packed = self.quick("--self-test", pack, "--size", "64x36")
        self.assertEqual(packed.returncode, 0, packed.stderr)
        self.assertEqual(self.times(), before, "what is packed was measured before")
        added = self.quick("--with", pack)
        self.assertEqual(added.returncode, 0, added.stderr)
        speed = json.loads((self.folder / "measured/still_life_diffuse_target.json").read_text())["result"]["ms_per_frame"]["total"]
        text = (self.folder / "thesis.md").read_text()
        self.assertIn("## Another machine: ", text)
        self.assertIn(f"| target core, diffuse | {1000 / speed:.2f} | {speed:.2f} |", text[text.index("## Another machine: "):])
        self.shows_what_a_pack_says_and_no_more(pack)
        with zipfile.ZipFile(self.folder / "odd.zip", "w") as odd:
            odd.writestr("self-test.json", '{"devices": {}, "series": {"a": 3}, "ssim": {}}')
        with zipfile.ZipFile(self.folder / "deep.zip", "w") as deep:
            deep.writestr("self-test.json", "[" * 200000)
        with zipfile.ZipFile(self.folder / "large.zip", "w", zipfile.ZIP_DEFLATED) as large:
            large.writestr("self-test.json", " " * (1 << 25))
        for file in ("thesis.md", "odd.zip", "none.zip", "deep.zip", "large.zip"):
            refused = self.quick("--with", self.folder / file)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(f"{file}: is no file of --self-test", refused.stderr)
            self.assertNotIn("Traceback", refused.stderr)

    def shows_what_a_pack_says_and_no_more(self, pack):
        """Words of a stranger's in both pages: no tag, comment, line, row, cell, link or picture comes of them."""
        with zipfile.ZipFile(pack) as whole:
            said = json.loads(whole.read("self-test.json"))
        evil = "GPU|x\n\n## More\n<script>s()</script><!-- ![p](http://nowhere/p.png) [l](http://nowhere) \\| \ud800"
        said["devices"] = {"source": evil, "target": evil}
        said["series"] = {evil: next(iter(said["series"].values()))}
        with zipfile.ZipFile(self.folder / "evil.zip", "w") as evil_pack:
            evil_pack.writestr("self-test.json", json.dumps(said))
        done = self.quick("--with", self.folder / "evil.zip")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "thesis.md").read_text()
        text = text[text.index("## Another machine"):text.index("<!-- kernel ")]
        lines = [line for line in text.splitlines() if line]
        self.assertEqual([line[:4] for line in lines], ["## A", "| se", "| --", "| GP", "| th", "| th", "Size"])
        self.assertEqual({len(re.findall(r"(?<!\\)(?:\\\\)*\|", line)) for line in lines[1:6]}, {7})
        self.assertNotIn("<", text)
        self.assertNotRegex(text, r"(?<!\\)[][]")
        page = (self.folder / "thesis.html").read_text()
        for mark in ("<script", "<!--"):
            self.assertNotIn(mark, page)


def stand_in(folder):
    """A program in the place of pathtracer whose pictures are texts that tell how they were asked for. It fails on a picture
    that it did not write whole; each start is a line of `asked`."""
    file = folder / "program"
    file.write_text(f"""#!{sys.executable}
import json, pathlib, sys
words = sys.argv[1:]
with open({str(folder / 'asked')!r}, "a") as log:
    log.write(words[0] + "\\n")
value = lambda name: words[words.index(name) + 1]
row = {{"ssim": 1.0, "rmse": 0.5}}
if words[0] == "compare" and "--size" not in words:
    first, second = (pathlib.Path(word).read_text() for word in words[1:3])
    if not (first.endswith("end") and second.endswith("end")):
        sys.exit(2)
    print(json.dumps({{"results": [{{"ssim": 1.0, "rmse": float(first.split()[0].split("x")[0])}}]}}))
elif words[0] == "render":
    pathlib.Path(value("-o")).write_text(value("--size") + " end")
elif words[0] == "compare":
    folder = pathlib.Path(value("-o"))
    folder.mkdir(parents=True, exist_ok=True)
    if "--bias" in words:
        (folder / "bias.png").write_text(value("--size") + " end")
        print(json.dumps({{"bias": None}}))
    else:
        for spp in value("--spp").split(","):
            for core in ("source", "target", "difference"):
                (folder / f"{{core}}_{{spp}}spp.png").write_text(value("--size") + " end")
        print(json.dumps({{"results": [dict(row, spp=int(spp)) for spp in value("--spp").split(",")]}}))
else:
    sys.exit(2)
""")
    file.chmod(0o755)
    return file


class Kept(unittest.TestCase):
    """What one run leaves to the next: only answers about the files that are there."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.program = stand_in(self.folder)
        self.scene = Scene("still_life", "still_life", ours=True)

    def measured(self, size="64x36"):
        """The digits of Table 1, and how often the program was started."""
        (self.folder / "asked").write_text("")
        take = Measurements(self.folder, str(self.program), None)
        found = measure_pictures(take, self.scene, {"size": size, "counts": [1, 4], "bias": 16}, self.folder / "pictures")
        self.assertEqual(take.failures, [])
        return {row["own"]["rmse"] for row in found["rows"].values()}, len((self.folder / "asked").read_text().split())

    def test_answers_about_pictures_of_another_size_are_not_taken(self):
        self.assertEqual(self.measured(), ({64.0}, 8))
        self.assertEqual(self.measured(), ({64.0}, 0))
        self.assertEqual(self.measured("96x54"), ({96.0}, 8))
        self.assertEqual(self.measured(), ({64.0}, 8))

    def test_a_damaged_answer_is_asked_for_again(self):
        self.measured()
        for damaged in ('"result": {}', '"result": []', '"result": null'):
            kept = self.folder / "measured" / "still_life_same.json"
            answer = json.loads(kept.read_text())
            kept.write_text(json.dumps({**answer, **json.loads("{" + damaged + "}")}))
            self.assertEqual(self.measured(), ({64.0}, 1), damaged)

    def test_a_scene_of_our_own_is_never_a_file_of_its_name_where_one_stands(self):
        (self.folder / "still_life").write_text("{}")
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)
        self.assertEqual(self.scene.path().name, "still_life.gltf")

    def test_a_folder_has_one_run_at_a_time_and_what_a_killed_one_started_counts(self):
        command = [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(ROOT / 'bench')!r}); import pathlib, subprocess, "
                   "thesis; lock = thesis.lock_of(pathlib.Path(sys.argv[1])); print(subprocess.Popen(['sleep', sys.argv[2]], "
                   "pass_fds=(lock,), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).pid)", str(self.folder)]
        first = subprocess.run([*command, "300"], check=True, capture_output=True, text=True)
        refused = subprocess.run([*command, "0"], check=False, capture_output=True, text=True)
        os.kill(int(first.stdout), signal.SIGKILL)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("another run works there", refused.stderr)
        for _ in range(100):  # until it is gone
            if subprocess.run([*command, "0"], check=False, capture_output=True).returncode == 0:
                return
            time.sleep(0.05)
        self.fail("the folder stayed locked")

    def test_a_lost_or_damaged_picture_is_made_anew(self):
        self.measured()
        pictures = [file for file in sorted((self.folder / "pictures").rglob("*.png"))]
        self.assertEqual(len(pictures), 9)
        for number, picture in enumerate(pictures):
            whole = picture.read_text()
            picture.unlink() if number % 2 else picture.write_text(whole[:4])
            self.assertEqual(self.measured(), ({64.0}, 1), picture)
            self.assertEqual(picture.read_text(), whole)

    def test_no_page_outlives_its_pictures(self):
        self.measured()
        page = self.folder / "thesis.md"
        page.write_text("shows pictures of 64x36\n")
        self.measured()
        self.assertTrue(page.is_file())
        self.measured("96x54")
        self.assertFalse(page.is_file())

    def test_a_picture_that_cannot_be_made_anew_is_not_an_older_one(self):
        self.measured()
        self.program.write_text("#!/bin/false\n")
        take = Measurements(self.folder, str(self.program), None)
        measure_pictures(take, self.scene, {"size": "96x54", "counts": [1, 4], "bias": 16}, self.folder / "pictures")
        self.assertFalse((self.folder / "pictures/still_life/source_1spp.png").is_file())

    def test_a_generated_scene_that_is_not_whole_is_made_anew(self):
        maker = self.folder / "make_scenes.py"
        maker.write_text("import pathlib, sys\nfolder = pathlib.Path(sys.argv[2])\nfolder.mkdir()\n"
                         "(folder / 'city.gltf').write_text('{}')\n(folder / 'city.bin').write_text('data')\n")
        made, buffer = thesis.MAKER, self.folder / "scenes/city/city.bin"
        self.addCleanup(setattr, thesis, "MAKER", made)
        thesis.MAKER = maker
        (self.folder / "scenes/city").mkdir(parents=True)
        (self.folder / "scenes/city/city.gltf").write_text("{}")  # made by halves, and killed
        for damage in (lambda: None, buffer.unlink, lambda: buffer.write_text("da")):
            damage()
            scene, problem = thesis.generated("city", self.folder)
            self.assertEqual((problem, buffer.read_text()), ("", "data"))
            self.assertTrue(os.path.isfile(scene.file))
        before = buffer.stat().st_ino
        thesis.generated("city", self.folder)
        self.assertEqual(buffer.stat().st_ino, before, "what is whole is not made twice")
        maker.write_text("import sys\nsys.exit('no room')\n")
        self.assertIn("no room", thesis.generated("city", self.folder)[1])
        self.assertEqual(sorted(file.name for file in (self.folder / "scenes").iterdir()), ["city", "city.json"])


class Packs(unittest.TestCase):
    """What a stranger sends back as a self-test."""
    SERIES = "source core, diffuse"
    GOOD = {"devices": {"source": "A GPU", "target": None}, "size": "640x360", "ssim": {"1": 0.99, "4": None},
            "bias": {"verdict": "agree", "p_value": 0.5},
            "series": {SERIES: {"ms_per_frame": {"total": 10.0, "generate": 1, "extend": 3.0, "shade": 2.5, "connect": 2.0, "finalize": 0},
                                "mrays_per_s": {"total": 100.0, "trace": None}, "threads": 2}}}

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.file = pathlib.Path(temporary.name) / "pack.zip"

    def read(self, content):
        thesis_pack.write_pack(self.file, content, self.file.parent, [])
        return thesis_pack.read_pack(self.file)

    def changed(self, path, value):
        content = copy.deepcopy(self.GOOD)
        place = content
        for name in path[:-1]:
            place = place[name]
        place[path[-1]] = value
        return content

    def test_what_can_be_true_is_shown(self):
        title, rows, words = thesis_pack.machine_of(self.read(self.GOOD))
        self.assertEqual(title, "Another machine: A GPU")
        self.assertEqual(rows, [[self.SERIES, "100.00", "10.00", "100.00", "-", "50.0"]])
        self.assertIn("the target core on -. SSIM of the two cores there, samples and figure: 1: 0.990000, 4: -.", words)
        self.assertEqual(self.read(self.changed(["bias"], None))["bias"], None)
        self.assertEqual(self.read({**self.GOOD, "more": [1]})["size"], "640x360")

    def test_what_cannot_be_true_is_refused(self):
        total = ["series", self.SERIES, "ms_per_frame", "total"]
        rays = ["series", self.SERIES, "mrays_per_s", "trace"]
        no_number = (-1, float("nan"), float("inf"), 1e300, 10 ** 400, True, "5", [], {})
        odd = [(path, value, path[-1]) for path in (total, total[:-1] + ["extend"], rays) for value in no_number]
        odd += [(total, 0, "no frame takes no time"), (total, None, "total is None"), (total, 1.0, "longer than the frame"),
                (["ssim", "1"], 1.5, "ssim of 1 samples is 1.5"), (["ssim", "1"], float("nan"), "ssim of 1 samples is nan"),
                (["ssim", "x"], 1, "'x' where a number of samples"), (["ssim"], [1], "ssim is list"),
                (["bias", "p_value"], 2, "p_value is 2"), (["bias", "p_value"], None, "p_value is None"),
                (["bias", "verdict"], "fine", "verdict is 'fine'"), (["bias"], False, "bias is False"), (["bias"], [1], "bias is list"),
                (["size"], "640 x 360", "size is '640 x 360'"), (["size"], 5, "size is 5"), (["devices"], [1], "devices is list"),
                (["devices", "source"], 5, "a device is 5"), (["devices", "source"], "x" * 1000, "a text of at most"),
                (["series"], {str(i): self.GOOD["series"][self.SERIES] for i in range(100)}, "series has 100 names"),
                (["series", self.SERIES], 3, "diffuse' is 3")]
        for path, value, said in odd:
            with self.assertRaises(thesis_pack.NoSelfTest, msg=(path, value)) as refused:
                self.read(self.changed(path, value))
            self.assertIn("pack.zip: is no file of --self-test", str(refused.exception))
            self.assertIn(said, str(refused.exception))
            self.assertNotIn("\n", str(refused.exception))
            self.assertLess(len(str(refused.exception)), 300)
        for name in self.GOOD:
            content = {key: value for key, value in self.GOOD.items() if key != name}
            with self.assertRaisesRegex(thesis_pack.NoSelfTest, f"it has no '{name}'"):
                self.read(content)

    @unittest.skipUnless(shutil.which("cmark-gfm"), "needs cmark-gfm")
    def test_others_words_are_shown_as_they_are(self):
        odd = "**a** `b` _c_ ~~d~~ <i>e</i> &amp; | [f](g) ![h](i) http://j.example www.k.example snake_case 2 * 3 \\* l"
        content = self.changed(["devices", "source"], odd)
        content["series"] = {odd: content["series"][self.SERIES]}
        page = thesis_page.Page("Page")
        page.section("First").quote(f"Left out: {odd}")
        page.lead("Made by `bench/thesis.py`")
        thesis_sections.add_other_machines(page, [thesis_pack.machine_of(self.read(content))])
        shown = subprocess.run(["cmark-gfm", "-e", "table", "-e", "autolink", "-e", "strikethrough"], input=page.markdown(self.file.parent),
                               capture_output=True, text=True, check=True).stdout
        for before, after in (("<h2>Another machine: ", "</h2>"), ("<p>Left out: ", "</p>"), ("<td>", "</td>")):
            self.assertIn(before + html.escape(odd, quote=False) + after, shown)
        self.assertIn("<code>bench/thesis.py</code>", shown)

    def test_what_no_screen_shows_is_marked(self):
        device = self.read(self.changed(["devices", "source"], "a\x1b[31m\x00\u202eb\n\nc"))["devices"]["source"]
        self.assertEqual(device, "a\ufffd[31m\ufffd\ufffdb c")


class Samples(unittest.TestCase):
    def test_the_counts_go_up_to_what_is_asked_for(self):
        for words, counts in ((["--quick"], [1, 4]), (["--quick", "--samples", "64"], [1, 4, 16, 64]), (["--samples", "3"], [1]),
                              (["--samples", "17"], [1, 4, 16]), ([], [1, 4, 16, 64, 256, 1024]),
                              (["--samples", "4096"], [1, 4, 16, 64, 256, 1024, 4096])):
            with unittest.mock.patch.object(sys, "argv", ["thesis.py", *words]):
                self.assertEqual(thesis.settings_of(thesis.read_options())["counts"], counts)


class OtherPrograms(unittest.TestCase):
    def test_bad_input_is_one_line(self):
        with tempfile.TemporaryDirectory() as name:
            odd = pathlib.Path(name) / "odd"
            odd.mkdir()
            (odd / "compile_commands.json").write_text('[{"file": "a.cpp"}]')
            parity = ["--parity", name]
            for script, words, said in (
                    ("bias_edits", ["--only", "nosuch"], "--only nosuch: no edit is of that file; name one of bsdf.glsl, "),
                    ("bias_edits", ["--spp", "x"], "x: expected a whole number of at least 1"),
                    ("bias_edits", ["--equal", "-3"], "--equal"), ("bias_edits", ["--jobs", "0"], "0: expected a whole number"),
                    ("bias_edits", ["--program", "nosuch"], "there is no program nosuch"),
                    ("bias_edits", ["--program", PATHTRACER, *parity], f"there is no {name}/parity.gltf"),
                    ("bias_edits", ["--program", "/bin/true", "--equal", "1"], "/bin/true compare ended with exit code 0"),
                    ("bias_edits", ["--program", PATHTRACER, "--equal", "1", "--equal-size", "abc"], "'abc' is no size"),
                    ("one_text", ["--compiles", "--build", "nosuch"], "nosuch/compile_commands.json: No such file"),
                    ("one_text", ["--compiles", "--build", odd], "compile_commands.json has no command that compiles"),
                    ("one_text", ["--build", odd], "odd/bin/pathtracer; "), ("one_text", ["--rounds", "0"], "0: expected a whole"),
                    ("cross_compiled", ["--compiles", "--build", "nosuch"], "nosuch/compile_commands.json: No such file"),
                    ("cross_compiled", ["--probes", "24"], "24: expected a multiple of 16"),
                    ("cross_compiled", ["--rounds", "0"], "0: expected a whole number of at least 1")):
                done = subprocess.run([sys.executable, str(ROOT / f"bench/{script}.py"), *map(str, words)], capture_output=True,
                                      text=True, check=False)
                self.assertEqual(done.returncode, 2, (script, words, done.stderr))
                lines = [line for line in done.stderr.splitlines() if line]
                self.assertEqual((len(lines), lines[0].split(":")[0]), (1, f"{script}.py"), done.stderr)
                self.assertIn(said, lines[0])


class SceneDigest(unittest.TestCase):
    """What tells that a measurement is of another scene than the one that is there now."""

    def test_it_is_of_the_text_the_camera_and_the_files(self):
        with tempfile.TemporaryDirectory() as name:
            scene, camera, data = (pathlib.Path(name) / file for file in ("s.gltf", "camera.json", "a s.bin"))
            seen = set()
            named = '{"buffers": [{"uri": "a%20s.bin"}, {"uri": "data:,"}, {}]}'
            for gltf, eye, buffer in (("{}", "1", b"1234"), (named, "1", b"1234"), (named, "2", b"1234"), (named, "2", b"12345"),
                                      (named, "2", b"12346")):
                scene.write_text(gltf)
                camera.write_text(eye)
                data.write_bytes(buffer)
                seen.add(Scene("s", str(scene), ["--camera", camera]).digest())
            self.assertEqual(len(seen), 5)
            self.assertEqual(len(seen | {Scene("s", str(scene), ["--camera", camera]).digest()}), 5)


class Age(unittest.TestCase):
    """Counted here once more, by other means."""

    def test_the_stored_page_says_how_many_kernel_files_changed(self):
        text = STORED.read_text()
        then = dict(re.findall(r"<!-- kernel (\S+) (\w+) -->", text))
        now = {}
        for core in ("source", "target"):
            for file in (ROOT / f"{core}_core/kernels").iterdir():
                now[file.relative_to(ROOT).as_posix()] = hashlib.sha256(file.read_bytes()).hexdigest()
        changed = {file for file, digest in now.items() if not digest.startswith(then.get(file, "none"))} | set(then) - set(now)
        self.assertIn(f"\n{len(changed)} of {len(now)} kernel files changed since", text,
                      "run bench/thesis.py --age docs/thesis-numbers.md")

    def test_age_counts_what_changed(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            then = set(re.findall(r"<!-- kernel (\S+) \w+ -->", STORED.read_text()))
            now = {file.relative_to(ROOT).as_posix() for core in ("source", "target")
                   for file in (ROOT / f"{core}_core/kernels").iterdir()}
            text = re.sub(r"(kernel \S+) \w+ -->", r"\1 000000000000 -->", STORED.read_text())
            page.write_text(text)
            said = run("--age", page)
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertIn(f"{len(then | now)} of {len(now)} ", said.stdout)
            self.assertIn(said.stdout.strip(), page.read_text())
            page.write_text("nothing\n")
            self.assertNotEqual(run("--age", page).returncode, 0)

    def test_a_page_that_cannot_be_written_stays(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            text = re.sub(r"(kernel \S+) \w+ -->", r"\1 000000000000 -->", STORED.read_text())
            page.write_text(text)
            page.chmod(0o640)
            done = subprocess.run([sys.executable, str(SCRIPT), "--age", str(page)], capture_output=True, text=True, check=False,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
            self.assertEqual((done.returncode, done.stderr), (2, f"thesis.py: {page}: File too large; name another place, or make room\n"))
            self.assertEqual((page.read_text(), os.listdir(folder)), (text, ["page.md"]))
            self.assertEqual(run("--age", page).returncode, 0)
            self.assertNotEqual(page.read_text(), text)
            self.assertEqual(page.stat().st_mode & 0o777, 0o640)

    def test_code_is_counted_anew_and_the_rest_stays(self):
        report = json.loads(subprocess.run([PORTTOOL, "report", "--format", "json"], capture_output=True, text=True, check=True,
                                           cwd=ROOT).stdout)
        block = next(block for block in report["blocks"] if block["name"] == "Render core")
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            stored = STORED.read_text()
            page.write_text(re.sub(r"^\| Render core \|.*$", "| Render core | stale |", stored, flags=re.M))
            said = run("--code", page, "--porttool", PORTTOOL)
            self.assertEqual(said.returncode, 0, said.stderr)
            text = page.read_text()
            row = re.search(r"^\| Render core \|(.*)$", text, re.M)[1].split("|")
            self.assertEqual([int(cell) for cell in row[:2]], [block["target_lines"], block["shared_target"]])
            self.assertAlmostEqual(float(row[4]), 100 * block["shared_target"] / block["target_lines"], delta=0.05)
            for chart in re.findall(r"\]\((page/charts/[^)]*)\)", text):
                self.assertTrue((page.parent / chart).is_file(), chart)

            def counted(words):
                return re.sub(r"^## (Table 2|Equations 3 to 8: what).*?(?=^## |^<!-- kernel )", "", words, flags=re.M | re.S)
            self.assertEqual(counted(text), counted(stored))
            page.write_text(stored.replace("## Table 2", "## Table"))
            self.assertIn("has no section 'Table 2", run("--code", page, "--porttool", PORTTOOL).stderr)

    def test_nonsense_is_refused_before_anything_is_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            out, pipe = pathlib.Path(folder) / "out", pathlib.Path(folder) / "pipe.md"
            os.mkfifo(pipe)
            for *words, said in (("--size", "abc", "'abc' is no size"), ("--samples", "0", "'0' is no number of samples"),
                                 ("--age", "nosuch", "nosuch: No such file"), ("--code", "nosuch", "nosuch: No such file"),
                                 ("-o", "/dev/null/out", "/dev/null/out"), ("--keep", "/nosuch/p.md", "/nosuch/p.md: nothing can be"),
                                 ("--self-test", "/nosuch/t.zip", "/nosuch/t.zip: nothing can be"),
                                 ("--self-test", folder, f"{folder}: is a folder"), ("--self-test", pipe, f"{pipe}: is a folder, a pipe"),
                                 ("--keep", pipe, f"{pipe}: is a folder, a pipe"),
                                 ("--keep", out, "a page ends in .md"),
                                 ("-o", "", "the name is empty"), ("--program", folder, f"there is no program {folder}"),
                                 ("--porttool", "nosuch", "there is no program nosuch"), ("--nosuch", "unrecognized")):
                refused = run("--quick", "-o", out, "--program", PATHTRACER, *words)
                self.assertEqual(refused.returncode, 2, words)
                self.assertIn(said, refused.stderr)
                self.assertEqual(refused.stderr.count("\n"), 1, refused.stderr)
                self.assertFalse(out.exists())
            self.assertTrue(pipe.is_fifo())


class EqualTime(unittest.TestCase):
    """Independent samples: the error is 8 / sqrt(samples), and after a given time it is known in closed form."""
    ERRORS = {1: 8.0, 4: 4.0, 16: 2.0, 64: 1.0}

    def test_error_follows_from_time_and_time_from_error(self):
        for time in (0.02, 0.1, 0.5, 1.2):
            samples, error = equal_time.error_after(time, 0.02, self.ERRORS)
            self.assertAlmostEqual(samples, time / 0.02)
            self.assertAlmostEqual(error, 8 / (time / 0.02) ** 0.5)
            self.assertAlmostEqual(equal_time.time_for(error, 0.06, self.ERRORS), 3 * time)

    def test_beyond_what_was_rendered_nothing_is_known(self):
        self.assertIsNone(equal_time.error_after(0.01, 0.02, self.ERRORS)[1])
        self.assertIsNone(equal_time.error_after(2, 0.02, self.ERRORS)[1])
        self.assertIsNone(equal_time.time_for(9, 0.02, self.ERRORS))
        self.assertIsNone(equal_time.time_for(0.5, 0.02, self.ERRORS))

    def test_what_is_missing_is_named(self):
        for words, said in ((["--pathtracer", "nosuch"], "there is no program nosuch"), (["--times", "1,x"], "1,x: expected seconds"),
                            (["--reference", "8"], "8: expected a whole number of at least 512")):
            refused = subprocess.run([sys.executable, str(ROOT / "bench/equal_time.py"), *words], capture_output=True, text=True,
                                     check=False)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(said, refused.stderr)
            self.assertNotIn("Traceback", refused.stderr)


if __name__ == "__main__":
    info = json.loads(subprocess.run([PATHTRACER, "info", "--format", "json"], capture_output=True, text=True, check=True).stdout)
    missing = [core["id"] for core in info["cores"] if not core["available"]]
    if missing:
        print(f"SKIPPED: the {missing[0]} core cannot run here")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
