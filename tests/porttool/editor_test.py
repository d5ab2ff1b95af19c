# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""`porttool watch` and `porttool lsp` as editors use them: real files, real processes, and a client of our own.

The client knows the protocol from its specification alone (LSP 3.17). The session of an editor that it replays,
editor_session.jsonl, was recorded from Neovim 0.7.2.
"""
import json
import os
import pathlib
import select
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.parse

PORTTOOL = os.path.abspath(sys.argv.pop(1))
SLOW = 10 if "sanitized" in PORTTOOL else 1
SOURCE = """\
// caf\u00e9 \U0001f600
float scale(float a) { return a * 0.5f; }

float shade(float a, float b) {
    float t = scale(a) + b;
    return t * 0.5f;
}
"""
TARGET = SOURCE.replace("// caf\u00e9 \U0001f600\n", "").replace("float scale", "inline float scale") \
    .replace("float shade", "inline float shade")


class Project(unittest.TestCase):
    """A mapped and recorded repository of two files, of its own for each test."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name).resolve() / "a project"
        for path, text in (("src/k.glsl", SOURCE), ("port/k.h", TARGET)):
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            (self.root / path).write_text(text)
        self.porttool("init", "--source", "src/*", "--target", "port/*")

    def tearDown(self):
        self.folder.cleanup()

    def porttool(self, *arguments):
        subprocess.run([PORTTOOL, "-C", self.root, *arguments], check=True, capture_output=True)

    def uri(self, path):
        return (self.root / path).as_uri()


def read_some(pipe, seconds):
    """What comes next on a pipe, or b"" after so long."""
    return os.read(pipe.fileno(), 65536) if select.select([pipe], [], [], seconds)[0] else b""


def end(process):
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout, process.stderr):
        if pipe:
            pipe.close()


class WatchTest(Project):
    def start(self, *options):
        self.process = subprocess.Popen([PORTTOOL, "-C", self.root, "watch", *options], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE)
        self.addCleanup(end, self.process)
        self.rest = b""

    def line(self, seconds=10 * SLOW):
        while b"\n" not in self.rest:
            got = read_some(self.process.stdout, seconds)
            if not got:
                return None
            self.rest += got
        line, self.rest = self.rest.split(b"\n", 1)
        return line.decode()

    def events(self):
        """The lines of one look, up to `judged` or `error`."""
        out = []
        while not out or out[-1]["event"] not in ("judged", "error"):
            out.append(json.loads(self.line()))
        return out

    def settled(self):
        """All lines until nothing more comes for a moment: an editor's save may be seen in two steps."""
        out = self.events()
        while select.select([self.process.stdout], [], [], 0.2)[0]:
            out += self.events()
        return out

    def stop(self, number, code):
        self.process.send_signal(number)
        self.assertEqual(self.process.wait(10 * SLOW), code)
        self.assertEqual(self.process.stderr.read(), b"")

    def test_tells_each_save_however_the_editor_saves(self):
        self.start("--format", "json")
        first = self.events()
        self.assertEqual([one["event"] for one in first], ["judged"])
        self.assertEqual(first[0]["verdict"], "in_step")
        source = self.root / "src/k.glsl"

        source.write_text(SOURCE.replace("t * 0.5f", "t * 0.25f"))  # in place
        finding, judged = self.settled()
        self.assertEqual((finding["event"], finding["rule"], finding["source"]["id"], finding["target"]["id"]),
                         ("finding", "source-changed", "src/k.glsl:shade", "port/k.h:shade"))
        self.assertEqual((judged["verdict"], judged["summary"]["drifted"], judged["files"]),
                         ("drift", 1, ["src/k.glsl"]))

        (self.root / "src/k.glsl.new").write_text(SOURCE)  # by renaming over it
        (self.root / "src/k.glsl.new").rename(source)
        gone = self.settled()
        self.assertEqual([(one["event"], one.get("fingerprint")) for one in gone if one["event"] == "gone"],
                         [("gone", finding["fingerprint"])])
        self.assertEqual(gone[-1]["verdict"], "in_step")

        source.rename(self.root / "k.glsl~")  # as with a backup: gone for a moment
        source.write_text(SOURCE)
        self.assertEqual(self.settled()[-1]["verdict"], "in_step")

        os.link(self.root / "k.glsl~", self.root / "linked")  # by a link to a whole file
        source.write_text(SOURCE.replace("t * 0.5f", "t * 0.75f"))
        self.assertEqual(self.settled()[-1]["verdict"], "drift")
        (self.root / "linked").rename(source)
        self.assertEqual(self.settled()[-1]["verdict"], "in_step")

    def test_survives_what_happens_to_the_map_the_lock_and_the_folders(self):
        self.start("--format", "json")
        self.events()
        map_text = (self.root / "portmap.toml").read_text()
        (self.root / "portmap.toml").write_text("version = 1\n[sides\n")
        error = self.settled()[-1]
        self.assertEqual(error["event"], "error")
        self.assertIn("portmap.toml:2", error["message"])
        (self.root / "portmap.toml").write_text(map_text)
        self.assertEqual(self.settled()[-1]["verdict"], "in_step")

        (self.root / "src/k.glsl").write_text(SOURCE.replace("0.5f;", "0.75f;"))
        self.assertEqual(self.settled()[-1]["summary"]["drifted"], 2)
        self.porttool("accept", "--all", "--force")  # writes the lock beside us
        self.assertEqual(self.settled()[-1]["summary"]["drifted"], 0)

        (self.root / "port/k.h").rename(self.root / "k.h")
        gone = self.settled()
        self.assertEqual(gone[-1]["verdict"], "drift")
        self.assertIn("dead-link", [one.get("rule") for one in gone])
        (self.root / "k.h").rename(self.root / "port/k.h")
        self.assertEqual(self.settled()[-1]["verdict"], "in_step")

        (self.root / "src/n.glsl").write_text("float fresh(float a) {\n    return a;\n}\n")
        fresh = self.settled()
        self.assertIn("unported", [one.get("rule") for one in fresh])
        (self.root / "src/n.glsl").unlink()
        self.assertEqual(self.settled()[-1]["verdict"], "in_step")

    def test_prints_text_and_ends_by_a_signal(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            self.start()
            self.assertTrue(self.line().startswith("in_step: 2 pairs"))
            (self.root / "src/k.glsl").write_text(SOURCE.replace("t * 0.5f", "t * 0.25f"))
            self.assertRegex(self.line(), r"src/k\.glsl:4: error: .*\[source-changed\]$")
            while not (line := self.line()).startswith("drift: "):
                self.assertIsNotNone(line)
            (self.root / "src/k.glsl").write_text(SOURCE)
            self.assertEqual(self.line(), "settled: src/k.glsl:shade [source-changed]")
            self.assertTrue(self.line().startswith("in_step: "))
            self.stop(number, code)

    def test_ends_when_nobody_reads_any_more(self):
        self.start()
        self.line()
        self.process.stdout.close()
        self.assertEqual(self.process.wait(10 * SLOW), 2)
        self.assertIn(b"nobody reads", self.process.stderr.read())

    def test_says_at_the_start_what_cannot_be_done(self):
        for arguments, said in ((["-C", self.folder.name, "watch"], b"portmap.toml"),
                                (["-C", self.root, "watch", "-o", "x"], b"-o"),
                                (["-C", self.root, "watch", "--format", "sarif"], b"--format")):
            got = subprocess.run([PORTTOOL, *arguments], capture_output=True, timeout=10 * SLOW)
            self.assertEqual((got.returncode, got.stdout), (2, b""), got.stderr)
            self.assertIn(said, got.stderr)


class Client:
    """The smallest client of the protocol: it frames what it sends, and cuts what comes."""

    def __init__(self, root, arguments=("lsp",), options=None):
        self.root = root
        self.process = subprocess.Popen([PORTTOOL, *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, cwd="/")
        self.rest, self.last_id, self.notices, self.diagnostics = b"", 0, [], {}
        self.options = options or {}

    def send_bytes(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.send_bytes(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))

    def receive(self, seconds=10 * SLOW):
        while True:
            head, found, rest = self.rest.partition(b"\r\n\r\n")
            if found:
                length = int(head.removeprefix(b"Content-Length: "))
                if len(rest) >= length:
                    self.rest = rest[length:]
                    return json.loads(rest[:length])
            got = read_some(self.process.stdout, seconds)
            if not got:
                return None
            self.rest += got

    def note(self, message):
        if message.get("method") == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
        else:
            self.notices.append(message)

    def answer(self, wanted):
        while (message := self.receive()) is not None:
            if "method" not in message and message["id"] == wanted:
                return message
            self.note(message)
        raise AssertionError("no answer")

    def request(self, method, params=None):
        self.last_id += 1
        self.send({"id": self.last_id, "method": method, "params": params})
        return self.answer(self.last_id)

    def notify(self, method, params=None):
        self.send({"method": method, "params": params})

    def initialize(self, **capabilities):
        got = self.request("initialize", {"processId": None, "rootUri": self.root.as_uri(),
                                          "capabilities": capabilities})
        self.notify("initialized", {})
        return got["result"]

    def wait_for(self, is_there, seconds=10 * SLOW):
        end = time.monotonic() + seconds
        while not is_there():
            message = self.receive(max(0, end - time.monotonic()))
            if message is None:
                raise AssertionError(f"never came; there are {self.diagnostics}")
            self.note(message)

    def leave(self):
        """Returns the exit code of a session that ends as it should."""
        self.request("shutdown")
        self.notify("exit")
        return self.process.wait(10 * SLOW)


def applied(text, edits):
    """TextEdits on a text, by the specification: UTF-16 units, \\n and \\r\\n end lines."""
    lines = text.splitlines(keepends=True) + [""]

    def offset(position):
        before = "".join(lines[:position["line"]])
        line = lines[position["line"]].encode("utf-16-le")
        return len(before) + len(line[:2 * position["character"]].decode("utf-16-le"))

    for edit in sorted(edits, key=lambda one: offset(one["range"]["start"]), reverse=True):
        start, end = (offset(edit["range"][name]) for name in ("start", "end"))
        text = text[:start] + edit["newText"] + text[end:]
    return text


class LspTest(Project):
    def client(self, *arguments):
        client = Client(self.root, arguments or ("lsp", "--stdio"))
        self.addCleanup(end, client.process)
        return client

    def open(self, client, path, text=None):
        client.notify("textDocument/didOpen", {"textDocument": {
            "uri": self.uri(path), "languageId": "cpp", "version": 1,
            "text": (self.root / path).read_text() if text is None else text}})

    def at(self, path, line, character):
        return {"textDocument": {"uri": self.uri(path)}, "position": {"line": line, "character": character}}

    def drifted(self, client, **capabilities):
        """A session with an edit of the source that is typed, not saved. Returns its text."""
        client.initialize(**capabilities)
        self.open(client, "src/k.glsl")
        edited = SOURCE.replace("t * 0.5f", "t * 0.25f")
        client.notify("textDocument/didChange", {
            "textDocument": {"uri": self.uri("src/k.glsl"), "version": 2},
            "contentChanges": [{"range": {"start": {"line": 5, "character": 15}, "end": {"line": 5, "character": 19}},
                                "text": "0.25f"}]})
        client.wait_for(lambda: client.diagnostics.get(self.uri("src/k.glsl")))
        return edited

    def test_a_typed_edit_is_told_on_both_sides_ported_and_gone(self):
        client = self.client()
        edited = self.drifted(client, workspace={"workspaceEdit": {"documentChanges": True}})
        client.wait_for(lambda: client.diagnostics.get(self.uri("port/k.h")))
        [here], [there] = client.diagnostics[self.uri("src/k.glsl")], client.diagnostics[self.uri("port/k.h")]
        self.assertEqual((here["code"], here["severity"], here["source"]), ("source-changed", 1, "porttool"))
        self.assertEqual(here["range"], {"start": {"line": 3, "character": 6}, "end": {"line": 3, "character": 11}})
        self.assertEqual(there["range"], {"start": {"line": 2, "character": 13}, "end": {"line": 2, "character": 18}})
        self.assertEqual(here["relatedInformation"][0]["location"], {"uri": self.uri("port/k.h"),
                                                                     "range": there["range"]})

        place = {"textDocument": {"uri": self.uri("src/k.glsl")}, "context": {"diagnostics": [here]},
                 "range": {"start": {"line": 5, "character": 0}, "end": {"line": 5, "character": 0}}}
        port, accept = client.request("textDocument/codeAction", place)["result"]
        self.assertIn("Port this edit to port/k.h", port["title"])
        [change] = port["edit"]["documentChanges"]
        self.assertEqual(change["textDocument"], {"uri": self.uri("port/k.h"), "version": None})
        ported = applied(TARGET, change["edits"])
        self.assertEqual(ported, TARGET.replace("t * 0.5f", "t * 0.25f"))

        refused = client.request("workspace/executeCommand", {"command": accept["command"]["command"],
                                                              "arguments": accept["command"]["arguments"]})
        self.assertEqual(refused["error"]["code"], -32803)  # it is not saved
        self.assertIn("src/k.glsl is not saved", refused["error"]["message"])

        self.open(client, "port/k.h", ported)
        client.wait_for(lambda: client.diagnostics[self.uri("src/k.glsl")] == []
                        and client.diagnostics[self.uri("port/k.h")] == [])
        self.assertEqual((self.root / "src/k.glsl").read_text(), SOURCE)  # nothing was written
        self.assertEqual((self.root / "port/k.h").read_text(), TARGET)
        self.assertNotEqual(edited, SOURCE)
        client.notify("textDocument/didClose", {"textDocument": {"uri": self.uri("port/k.h")}})
        client.wait_for(lambda: client.diagnostics[self.uri("src/k.glsl")] != [])  # the port is as on the disk again
        self.assertEqual(client.leave(), 0)

    def test_a_session_that_neovim_had(self):
        client = self.client()
        root = urllib.parse.quote(str(self.root))
        recorded = [json.loads(line.replace("file://ROOT", "file://" + root).replace("ROOT", str(self.root)))
                    for line in (pathlib.Path(__file__).parent / "editor_session.jsonl").read_text().splitlines()]
        answers, told = {}, []
        for message in recorded:
            if message.get("method") == "textDocument/codeAction":  # Neovim asked once it had shown the finding
                client.wait_for(lambda: client.diagnostics.get(self.uri("src/k.glsl")))
                told = client.diagnostics[self.uri("src/k.glsl")]
                message["params"]["context"]["diagnostics"] = told
            client.send(message)
            if "id" in message:
                answers[message["method"]] = client.answer(message["id"])["result"]
        self.assertEqual(client.process.wait(10 * SLOW), 0)
        self.assertEqual([one["code"] for one in told], ["source-changed"])
        self.assertIn("Similarity", answers["textDocument/hover"]["contents"]["value"])
        self.assertEqual([one["kind"] for one in answers["textDocument/codeAction"]], ["quickfix", "quickfix"])
        self.assertEqual(answers["textDocument/declaration"][0]["uri"], self.uri("port/k.h"))
        self.assertEqual(client.diagnostics[self.uri("src/k.glsl")], [])  # it had applied the port

    def test_accepts_what_is_saved(self):
        client = self.client()
        client.initialize()
        (self.root / "src/k.glsl").write_text(SOURCE.replace("t * 0.5f", "t * 0.25f"))  # by another program
        client.wait_for(lambda: client.diagnostics.get(self.uri("src/k.glsl")))
        [finding] = client.diagnostics[self.uri("src/k.glsl")]
        place = {"textDocument": {"uri": self.uri("port/k.h")}, "context": {"diagnostics": []},
                 "range": {"start": {"line": 2, "character": 0}, "end": {"line": 2, "character": 0}}}
        actions = client.request("textDocument/codeAction", place)["result"]
        [port] = [one for one in actions if "edit" in one]
        self.assertEqual(list(port["edit"]["changes"]), [self.uri("port/k.h")])  # no documentChanges were promised
        [accept] = [one["command"] for one in actions if "command" in one]
        self.assertEqual(accept["arguments"], [finding["data"]["fingerprint"]])
        done = client.request("workspace/executeCommand", {key: accept[key] for key in ("command", "arguments")})
        self.assertIsNone(done["result"])
        client.wait_for(lambda: client.diagnostics[self.uri("src/k.glsl")] == [])
        self.porttool("check", "--strict")
        again = client.request("workspace/executeCommand", {key: accept[key] for key in ("command", "arguments")})
        self.assertEqual(again["error"]["code"], -32803)
        self.assertEqual(client.leave(), 0)

    def test_goes_to_the_counterpart_and_says_how_it_stands(self):
        client = self.client()
        capabilities = client.initialize()["capabilities"]
        self.assertEqual(capabilities["positionEncoding"], "utf-16")
        there = [{"uri": self.uri("port/k.h"), "range": {"start": {"line": 2, "character": 13},
                                                         "end": {"line": 2, "character": 18}}}]
        back = [{"uri": self.uri("src/k.glsl"), "range": {"start": {"line": 3, "character": 6},
                                                          "end": {"line": 3, "character": 11}}}]
        for method in ("definition", "declaration", "implementation"):
            self.assertTrue(capabilities[method + "Provider"])
            for path, line, found in (("src/k.glsl", 3, there), ("port/k.h", 2, back), ("src/k.glsl", 2, [])):
                self.assertEqual(client.request("textDocument/" + method, self.at(path, line, 8))["result"], found)
        # A name within a body is the language's own server's.
        self.assertEqual(client.request("textDocument/definition", self.at("src/k.glsl", 4, 16))["result"], [])
        self.assertEqual(client.request("textDocument/declaration", self.at("src/k.glsl", 4, 16))["result"], there)
        self.assertEqual(client.request("textDocument/definition", self.at("src/k.glsl", 5, 16))["result"], there)
        hover = client.request("textDocument/hover", self.at("src/k.glsl", 4, 6))["result"]["contents"]
        self.assertEqual(hover["kind"], "markdown")
        for part in ("port/k.h:shade", self.uri("port/k.h") + "#L3", "State: in step, recorded, not verified",
                     "Similarity: "):
            self.assertIn(part, hover["value"])
        self.assertIsNone(client.request("textDocument/hover", self.at("src/k.glsl", 0, 0))["result"])
        self.assertEqual(client.leave(), 0)

    def test_lives_and_ends_as_the_specification_says(self):
        client = self.client()
        self.assertEqual(client.request("textDocument/hover", {})["error"]["code"], -32002)
        client.notify("textDocument/didOpen", {})  # dropped
        client.initialize()
        self.assertEqual(client.request("initialize", {})["error"]["code"], -32600)
        self.assertIsNone(client.request("shutdown")["result"])
        self.assertEqual(client.request("textDocument/hover", {})["error"]["code"], -32600)
        client.notify("exit")
        self.assertEqual(client.process.wait(10 * SLOW), 0)
        for end in (lambda one: one.notify("exit"), lambda one: one.process.stdin.close()):
            client = self.client()
            client.initialize()
            end(client)
            self.assertEqual(client.process.wait(10 * SLOW), 1)

    def test_answers_what_is_malformed_and_goes_on(self):
        client = self.client()
        client.initialize()

        def raw(body, head=b"Content-Length: %d\r\n\r\n"):
            client.send_bytes((head % len(body) if b"%d" in head else head) + body)
            while (message := client.receive()) is not None:
                if "error" in message:
                    return message["id"], message["error"]["code"]
                client.note(message)
            return None

        self.assertEqual(raw(b"{"), (None, -32700))
        self.assertEqual(raw(b"\xff\xfe"), (None, -32700))
        self.assertEqual(raw(b"[" * 100000), (None, -32700))
        self.assertEqual(raw(b"{}", b"Content-Length: x\r\n\r\n"), (None, -32700))
        deep = b'{"jsonrpc":"2.0","id":1,"method":"shutdown","params":' + b'{"a":' * 100000 + b"1" + b"}" * 100001
        self.assertEqual(raw(deep), (None, -32700))
        for length in (b"-1", b"18446744073709551616", b"1e3", b"5, 5"):
            self.assertEqual(raw(b"{}", b"Content-Length: " + length + b"\r\n\r\n"), (None, -32700), length)
            self.assertIsNone(client.request("textDocument/hover", self.at("src/k.glsl", 0, 0))["result"])  # found again
        self.assertEqual(raw(b"[]"), (None, -32600))
        batch = [{"jsonrpc": "2.0", "id": i, "method": "shutdown"} for i in range(1000)]
        self.assertEqual(raw(json.dumps(batch).encode()), (None, -32600))
        self.assertEqual(raw(b"7"), (None, -32600))
        self.assertEqual(raw(b'{"jsonrpc":"1.0","id":3,"method":"shutdown"}'), (3, -32600))
        self.assertEqual(raw(b'{"jsonrpc":"2.0","id":4}'), (4, -32600))
        self.assertEqual(raw(b'{"jsonrpc":"2.0","id":[1],"method":"shutdown"}'), (None, -32600))
        self.assertEqual(raw(b'{"jsonrpc":"2.0","id":"a","method":"no/such"}'), ("a", -32601))
        self.assertEqual(raw(b'{"jsonrpc":"2.0","id":"$","method":"$/no"}'), ("$", -32601))
        for method, params in (("textDocument/hover", {}), ("textDocument/hover", []), ("textDocument/hover", None),
                               ("textDocument/hover", self.at("src/k.glsl", -1, 0)),
                               ("textDocument/hover", self.at("src/k.glsl", 1e40, 0)),
                               ("textDocument/hover", self.at("src/k.glsl", "1", 0)),
                               ("textDocument/codeAction", self.at("src/k.glsl", 1, 0)),
                               ("workspace/executeCommand", {"command": "rm"}),
                               ("workspace/executeCommand", {"command": "porttool.accept", "arguments": [1]})):
            self.assertEqual(client.request(method, params)["error"]["code"], -32602, (method, params))
        for params in ({}, {"textDocument": {"uri": 1}}, self.at("never/opened", 0, 0)):
            for name in ("didOpen", "didChange", "didClose", "didSave"):
                client.notify("textDocument/" + name, params)  # no answer, and no end
        far = client.request("textDocument/hover", self.at("src/k.glsl", 2147483647, 2147483647))
        self.assertIsNone(far["result"])
        other = client.request("textDocument/hover", {"textDocument": {"uri": "untitled:1"},
                                                      "position": {"line": 0, "character": 0}})
        self.assertIsNone(other["result"])
        self.assertEqual(client.leave(), 0)

    def test_a_hostile_session_changes_no_file_and_shows_none_from_elsewhere(self):
        outside = self.root.parent / "outside.glsl"
        outside.write_text(SOURCE.replace("0.5f", "0.125f"))
        (self.root / "src/link.glsl").symlink_to(outside)

        def files():
            return {path: path.read_bytes() for path in self.root.parent.rglob("*") if path.is_file()}

        before = files()
        client = self.client()
        client.initialize()
        told = []
        for uri in ("file:///etc/passwd", self.uri("src/link.glsl"), self.uri("src") + "/../../outside.glsl",
                    self.uri("src") + "/..%2f..%2foutside.glsl", self.uri(".git/config"), "file://host/etc/passwd",
                    "file:/etc/passwd", "file:///%", "file:///%00", "file:///a%zz", "", "file:///dev/zero",
                    "file:///" + "a/" * 5000, "file:///" + "a" * 100000):
            document = {"uri": uri, "languageId": "glsl", "version": 1, "text": "float shade(float a) { return a; }"}
            client.notify("textDocument/didOpen", {"textDocument": document})
            for method in ("hover", "definition", "codeAction"):
                got = client.request("textDocument/" + method, {
                    "textDocument": document, "position": {"line": 0, "character": 6},
                    "range": {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 9}}})
                told += [uri, got["result"]] if got["result"] else []
        self.assertEqual(told, [])
        [[leads_out]] = [found for found in client.diagnostics.values() if found]
        self.assertEqual(leads_out["code"], "unreadable")
        self.assertNotIn("float", json.dumps(leads_out))

        for number in range(2000):
            client.notify("textDocument/didOpen", {"textDocument": {
                "uri": self.uri(f"elsewhere/{number}.glsl"), "version": 1, "text": SOURCE}})
            if number % 100 == 0:  # reads what was told: a server waits for who does not
                client.request("textDocument/hover", self.at("src/k.glsl", 4, 6))
        self.open(client, "src/k.glsl", "{" * (8 << 20))
        everywhere = {"start": {"line": 0, "character": 0}, "end": {"line": 2147483647, "character": 2147483647}}
        changes = [{"range": everywhere, "text": "a"}, {"text": SOURCE}, {"range": dict(everywhere, end={
            "line": 0, "character": 0}), "text": ""}]
        client.notify("textDocument/didChange", {"textDocument": {"uri": self.uri("src/k.glsl"), "version": 2},
                                                 "contentChanges": changes})
        hover = client.request("textDocument/hover", self.at("src/k.glsl", 4, 6))["result"]
        self.assertIn("State: in step", hover["contents"]["value"])
        self.assertEqual(files(), before)
        self.assertIsNone(client.request("shutdown")["result"])
        self.assertEqual(client.request("shutdown")["error"]["code"], -32600)
        client.notify("exit")
        self.assertEqual(client.process.wait(10 * SLOW), 0)

    def test_waits_for_a_map_that_is_not_there_or_broken(self):
        map_text = (self.root / "portmap.toml").read_text()
        (self.root / "portmap.toml").unlink()
        client = self.client()
        client.initialize()
        client.wait_for(lambda: any("no portmap.toml" in str(one) for one in client.notices))
        (self.root / "portmap.toml").write_text("version = 1\n[sides\n")
        client.wait_for(lambda: client.diagnostics.get(self.uri("portmap.toml")))
        [broken] = client.diagnostics[self.uri("portmap.toml")]
        self.assertEqual((broken["severity"], broken["range"]["start"]["line"]), (1, 1))
        (self.root / "portmap.toml").write_text(map_text)
        client.wait_for(lambda: client.diagnostics[self.uri("portmap.toml")] == [])
        self.assertEqual(client.leave(), 0)


if __name__ == "__main__":
    unittest.main()
