# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the shell steps of action.yml and templates/porttool.yml as the two services would: PORTTOOL as first argument.

The archive is a file:// one, but where a server of our own with a certificate of our own hands it out. In most tests its
program writes down the arguments that it was given, so that what reaches it can be held to what was asked for, byte by
byte; the real program runs in the last ones.
"""
import functools
import hashlib
import http.server
import os
import pathlib
import re
import shutil
import ssl
import subprocess
import sys
import tarfile
import tempfile
import threading
import unittest

try:
    import yaml
except ImportError:
    print("python3-yaml is not there: skipped")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(sys.argv.pop(1))
RECORDER = '#!/bin/sh\nfor a; do printf "%s\\0" "$a"; done >> "$RECORD"\nexit "${PRETENDED_EXIT:-0}"\n'
HOSTILE = ["$(touch HARM)", "`touch HARM`", "; touch HARM; && touch HARM | touch HARM > HARM", "\ntouch HARM\n",
           "\" ; touch HARM ; \"", "' ; touch HARM ; '", "a b", "* ~ \\", "${IFS}touch${IFS}HARM", "-rf", "--",
           "\n::error::x %s%n", "%0A::error::x", "../../x", "é\u202e\x1b[31m", "$((touch HARM)) $HOME"]


class Service:
    """What both services do with the inputs: put them into the environment of the steps."""

    def __init__(self, folder):
        self.folder, self.work, self.temp = folder, folder / "work", folder / "temp"
        self.work.mkdir()
        self.temp.mkdir()

    def run(self, inputs, **more):
        environment = {"PATH": os.environ["PATH"], "RECORD": str(self.folder / "record"), "HOME": str(self.folder),
                       **more}
        for name in ("record", "output", "path"):
            (self.folder / name).write_bytes(b"")
        for left in self.temp.iterdir():
            shutil.rmtree(left)
        code, out, err = self.steps(inputs, environment)
        recorded = (self.folder / "record").read_bytes().decode()
        return code, out, err, recorded.split("\0")[:-1]

    def shell(self, script, environment):
        done = subprocess.run(["sh", "-e", "-c", script], cwd=self.work, env=environment, capture_output=True,
                              text=True)
        return done.returncode, done.stdout, done.stderr


class GitHub(Service):
    definition = yaml.safe_load((ROOT / "action.yml").read_text())
    scripts = [step["run"] for step in definition["runs"]["steps"]]
    reports = 1

    def steps(self, inputs, environment):
        values = {f"inputs.{name}": spec["default"] for name, spec in self.definition["inputs"].items()}
        values.update({f"inputs.{name}": value for name, value in inputs.items()})
        out = err = ""
        for step in self.definition["runs"]["steps"]:
            assert step["shell"] == "sh"
            local = dict(environment, GITHUB_OUTPUT=str(self.folder / "output"), GITHUB_PATH=str(self.folder / "path"),
                         GITHUB_SERVER_URL="https://github.invalid", RUNNER_TEMP=str(self.temp))
            for name, value in step["env"].items():
                local[name] = re.sub(r"\$\{\{ *([^ }]+) *\}\}", lambda found: values[found[1]], value)
            code, more_out, more_err = self.shell(step["run"], local)
            out, err = out + more_out, err + more_err
            if code != 0:
                break
            if "id" in step:
                for line in (self.folder / "output").read_text().splitlines():
                    name, value = line.split("=", 1)
                    values[f"steps.{step['id']}.outputs.{name}"] = value
        return code, out, err


class GitLab(Service):
    specification, definition = yaml.safe_load_all((ROOT / "templates/porttool.yml").read_text())
    job = definition["port-drift"]
    scripts = job["script"]
    reports = 2

    def steps(self, inputs, environment):
        values = {name: spec.get("default") for name, spec in self.specification["spec"]["inputs"].items()}
        values.update(inputs)
        local = dict(environment, CI_PROJECT_DIR=str(self.work))
        for name, value in self.job["variables"].items():
            text = value["value"] if isinstance(value, dict) else value
            local[name] = re.sub(r"\$\[\[ *inputs\.([^ \]]+) *\]\]", lambda found: values[found[1]], text)
        local["PORTTOOL_TEMP"] = str(self.temp)
        return self.shell("\n".join(self.scripts), local)


def pack(folder, program):
    """An archive with this program, its SHA256SUMS, and its address and sum as inputs."""
    top = folder / "porttool-9-linux-x"
    (top / "bin").mkdir(parents=True)
    shutil.copy(program, top / "bin/porttool")
    archive = folder / "porttool-9-linux-x.tar.gz"
    with tarfile.open(archive, "w:gz", compresslevel=0) as tar:
        tar.add(top, top.name)
    total = hashlib.sha256(archive.read_bytes()).hexdigest()
    (folder / "SHA256SUMS").write_text(f"{'0' * 64}  another.tar.gz\n{total}  {archive.name}\n")
    return {"archive-url": f"file://{archive}", "sha256": total}


class Folder(http.server.SimpleHTTPRequestHandler):
    """Hands out a folder; /to/ADDRESS leads to that address."""

    def do_GET(self):
        if not self.path.startswith("/to/"):
            return super().do_GET()
        self.send_response(302)
        self.send_header("Location", self.path.removeprefix("/to/"))
        self.end_headers()

    def log_message(self, *_):
        pass


def serve(test, folder, certificate=None):
    """Starts a server for the time of a test, with HTTPS if there is a certificate; returns its port."""
    server = http.server.ThreadingHTTPServer(("localhost", 0), functools.partial(Folder, directory=folder))
    if certificate is not None:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(certificate)
        server.socket = context.wrap_socket(server.socket, server_side=True)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    for clean_up in (server.server_close, thread.join, server.shutdown):  # the last is called first
        test.addCleanup(clean_up)
    return server.server_port


def make_certificate(folder):
    """A file with a key and a certificate for `localhost` that nobody trusts who is not told to."""
    file = folder / "certificate.pem"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=localhost",
                    "-addext", "subjectAltName=DNS:localhost", "-keyout", file, "-out", folder / "part"], check=True,
                   capture_output=True)
    file.write_text(file.read_text() + (folder / "part").read_text())
    return file


def path_with(folder, tool):
    """A PATH on which the steps find `tool` and no other program that gets files."""
    folder.mkdir()
    for name in ("sh", "cp", "grep", "gzip", "mkdir", "mktemp", "sha256sum", "tar", "tr", "uname", tool):
        (folder / name).symlink_to(shutil.which(name))
    return str(folder)


class Steps:
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="porttool_gate_steps_"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "archive").mkdir()
        recorder = self.folder / "recorder"
        recorder.write_text(RECORDER)
        recorder.chmod(0o755)
        self.archive = pack(self.folder / "archive", recorder)
        self.service = self.service_type(self.folder)

    def refused(self, inputs, word, **environment):
        code, out, err, arguments = self.service.run(inputs, **environment)
        self.assertEqual((code, out, arguments), (2, "", []), err)
        self.assertIn(word, err)
        self.assertNotRegex(out + err, r"(?m)^::")
        self.assertFalse(list(self.service.temp.glob("*/unpacked")))

    def test_no_input_stands_in_a_script(self):
        for script in self.service.scripts:
            self.assertNotIn("${{", script)
            self.assertNotIn("$[[", script)

    def test_the_archive_with_its_sum_or_with_sums_beside_it(self):
        for inputs in (self.archive, {**self.archive, "sha256": ""},
                       {**self.archive, "sha256": self.archive["sha256"].upper()}):
            code, _, err, arguments = self.service.run(inputs)
            self.assertEqual((code, err), (0, ""))
            self.assertEqual(arguments.count("check"), self.service.reports)
        self.assertEqual(self.service.run(self.archive, PRETENDED_EXIT="1")[0], 1)
        self.assertEqual(self.service.run(self.archive, PRETENDED_EXIT="2")[0], 2)

    def test_another_archive_is_refused_before_it_is_unpacked(self):
        wrong = "f" * 64
        self.refused({**self.archive, "sha256": wrong}, "is not what it should be")
        self.refused({**self.archive, "sha256": self.archive["sha256"][:-1]}, "is not what it should be")
        sums = self.folder / "archive/SHA256SUMS"
        sums.write_text(f"{wrong}  porttool-9-linux-x.tar.gz\n")
        self.refused({**self.archive, "sha256": ""}, "is not what it should be")
        sums.write_text(f"{self.archive['sha256']}  another.tar.gz\n")
        self.refused({**self.archive, "sha256": ""}, "does not list")
        sums.unlink()
        self.refused({**self.archive, "sha256": ""}, "could not get SHA256SUMS")
        another = self.archive["archive-url"].replace("-9-", "-8-")
        self.refused({**self.archive, "archive-url": another}, "could not get")

    def test_only_addresses_that_cannot_be_read_along(self):
        for url in ("http://example.org/p.tar.gz", "ftp://example.org/p.tar.gz", "file://host/p.tar.gz", "-o/x.tar.gz"):
            self.refused({**self.archive, "archive-url": url}, "must begin with https://")
        self.refused({**self.archive, "archive-url": "https://example.org/"}, "must end in .tar.gz")

    @unittest.skipUnless(shutil.which("openssl"), "openssl makes the certificate")
    def test_the_archive_over_https(self):
        certificate = make_certificate(self.folder)
        files = self.folder / "archive"
        port, plain = serve(self, files, certificate), serve(self, files)
        name = "porttool-9-linux-x.tar.gz"
        secure = f"https://localhost:{port}/{name}"
        (self.folder / "wgetrc").write_text(f"ca_certificate = {certificate}\n")
        trust = {"curl": {"CURL_CA_BUNDLE": str(certificate)}, "wget": {"WGETRC": str(self.folder / "wgetrc")}}
        for tool in filter(shutil.which, trust):
            with self.subTest(tool=tool):
                alone = {"PATH": path_with(self.folder / tool, tool)}
                trusted = {**alone, **trust[tool]}
                given = {**self.archive, "archive-url": secure}
                for inputs in (given, {**given, "sha256": ""},
                               {**given, "archive-url": f"https://localhost:{port}/to/{secure}"}):
                    code, _, err, arguments = self.service.run(inputs, **trusted)
                    self.assertEqual((code, err), (0, ""))
                    self.assertEqual(arguments.count("check"), self.service.reports)
                self.refused({**given, "sha256": "f" * 64}, "is not what it should be", **trusted)
                for url in (secure.replace("-9-", "-8-"), f"https://localhost:{port}/to/http://localhost:{plain}/{name}",
                            f"https://localhost:{plain}/{name}"):
                    self.refused({**given, "archive-url": url}, f"could not get {url.rpartition('/')[2]}", **trusted)
                other = secure.replace("localhost", "127.0.0.1")  # not what the certificate is for
                self.refused({**given, "archive-url": other}, "could not get", **trusted)
                self.refused(given, "could not get", **alone)

    def test_hostile_inputs_are_data(self):
        for text in HOSTILE:
            with self.subTest(text=text):
                self.refused({**self.archive, "archive-url": f"{self.archive['archive-url']}{text}"}, "porttool: ")
                self.refused({**self.archive, "sha256": text}, "is not what it should be")
                inputs = {**self.archive, "working-directory": text, "base": text, "format": text, "args": text}
                code, out, err, arguments = self.service.run(inputs)
                self.assertEqual((code, out, err), (0, "", ""))
                expected = ["check", "-C", f"./{text}", f"--format={text}", *text.split(), f"--base={text}"]
                self.assertEqual(sorted(arguments[-len(expected):]), sorted(expected))
                self.assertEqual([str(path) for path in self.folder.rglob("HARM")], [])

    def test_the_real_program(self):
        self.archive = pack(self.folder / "real", PROGRAM)
        map_folder = self.service.work / "a 'b' \"c\" $(touch HARM)"
        for side, name in (("cuda", "k.cu"), ("glsl", "k.glsl")):
            (map_folder / side).mkdir(parents=True)
            (map_folder / side / name).write_text("float half_of(float x) { return x * 0.5f; }\n")
        subprocess.run([PROGRAM, "init", "-C", map_folder, "--source", "cuda/*", "--target", "glsl/*"], check=True,
                       capture_output=True)
        inputs = {**self.archive, "working-directory": map_folder.name, "args": "--strict"}
        self.assertEqual(self.service.run(inputs)[0], 0)
        (map_folder / "cuda/k.cu").write_text("float half_of(float x) { return x * 0.25f; }\n")
        code, out, _, _ = self.service.run(inputs)
        self.assertEqual(code, 1)
        self.assertIn("k.cu", out)
        self.assertEqual(self.service.run({**inputs, "working-directory": "not there"})[0], 2)


class GitHubSteps(Steps, unittest.TestCase):
    service_type = GitHub

    def test_a_release_needs_version_and_repository(self):
        for given in ({}, {"version": "1"}, {"repository": "a/b"}):
            self.refused(given, "give archive-url, or version and repository")
        for text in HOSTILE[:4]:
            self.refused({"version": text, "repository": "a/b"}, "a character that addresses do not have")

    def test_later_steps_find_the_program(self):
        self.service.run(self.archive)
        found = pathlib.Path((self.folder / "path").read_text().strip(), "porttool")
        self.assertTrue(os.access(found, os.X_OK))


class GitLabSteps(Steps, unittest.TestCase):
    service_type = GitLab

    def test_the_same_steps_get_the_archive_on_both_services(self):
        def shared(scripts):
            return re.search(r"(?s)# From here to \"got\".*# got\n", "\n".join(scripts))[0]
        self.assertEqual(shared(GitHub.scripts), shared(GitLab.scripts))


if __name__ == "__main__":
    unittest.main()
