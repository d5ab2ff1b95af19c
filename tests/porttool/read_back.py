# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Reads porttool's outputs back with parsers of others: python3 read_back.py FOLDER

FOLDER/cases.json lists outputs that were made twice, with hostile and with harmless texts. Both must have one structure,
and what a reader sees of the hostile ones must be the texts themselves, with visible escapes. Prints one line for each
case that is not so, and `absent: NAME` for a parser that is not installed.
"""
import base64
import collections
import csv
import html.parser
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib
import unicodedata
import urllib.parse
import xml.etree.ElementTree as ElementTree
import zlib

try:
    import pyte
except ImportError:
    pyte = None

IGNORABLE = {0x34F, 0x115F, 0x1160, 0x3164, 0xFFA0, 0xFEFF} | set(range(0xFE00, 0xFE10)) | set(range(0xE0000, 0xE1000))


def is_hidden(text, at):
    character = text[at]
    if character in "\u200d\ufe0f":  # within an emoji they are no letters of their own
        return at == 0 or not (unicodedata.category(text[at - 1]) in ("So", "Sk") or text[at - 1] == "\ufe0f")
    return unicodedata.category(character) in ("Cc", "Cf", "Zl", "Zp") or ord(character) in IGNORABLE


def visible(text):
    text = text.replace("\\u{", "\\u{5c}u{")
    text = "".join(f"\\u{{{ord(c):x}}}" if is_hidden(text, i) else c for i, c in enumerate(text))
    return re.sub(r"##(?=[a-z]*\[)", r"#\\u{23}", text)


def need(holds, what):
    if not holds:
        raise AssertionError(what)


def check_characters(text, kind):
    """No hidden character, no command to whoever reads the log."""
    for match in re.finditer("[^ -~\n]", text):
        at, character = match.start(), match[0]
        allowed = (character == "\r" and kind == "csv" and text[at + 1:at + 2] == "\n") or (character == "\t" and kind == "html")
        need(allowed or not is_hidden(text, at), f"U+{ord(character):04X} in {text[max(0, at - 40):at + 20]!r}")
    for line in text.split("\n"):
        need(kind == "github" or not line.lstrip().startswith("::"), f"a workflow command: {line[:80]!r}")
    need(re.search(r"##[a-z]*\[", text) is None, "a command in a log")


def is_shown(wanted, seen):
    squeezed = " ".join(visible(wanted).split())
    return squeezed in seen or squeezed.replace("::", "\\u{3a}:", 1) in seen


def check_shown(case, seen):
    seen = " ".join(seen.split())
    for wanted in case["shown"]:
        need(is_shown(wanted, seen), f"not shown: {wanted!r}")


def read_text(text):
    """The lines as a terminal shows them; nothing else of its state may change."""
    lines = text.split("\n")
    if pyte is None:
        return lines
    screen = pyte.Screen(2 * max(map(len, lines)) + 2, 2)
    stream = pyte.Stream(screen)
    for line in lines:
        if line.isascii() and line.isprintable():
            continue
        line = line.replace("\u200d", "").replace("\ufe0f", "")  # of emoji: pyte stops there
        stream.feed(line)
        need(screen.cursor.y == 0 and screen.title == "" and screen.cursor.attrs == screen.default_char, f"it acts: {line!r}")
        shown = "".join(screen.buffer[0][x].data for x in range(screen.cursor.x))
        need(unicodedata.normalize("NFC", shown) == unicodedata.normalize("NFC", line), f"shown as {shown!r}: {line!r}")
        screen.buffer.clear()
        screen.cursor_position()
    return lines


def check_text(case, hostile, harmless):
    need(len(read_text(hostile)) == len(harmless.split("\n")) or case.get("lines_vary"), "another number of lines")
    check_shown(case, hostile)


def markdown_tree(text):
    command = ["cmark-gfm", "-t", "xml", "--unsafe"]
    for extension in ("table", "strikethrough", "autolink", "footnotes", "tasklist"):
        command += ["-e", extension]
    out = subprocess.run(command, input=text.encode(), capture_output=True, check=True).stdout
    return ElementTree.fromstring(re.sub(rb"<!DOCTYPE[^>]*>", b"", out))


def tag_of(node):
    return node.tag.rsplit("}", 1)[-1]


INLINE = {"text", "code", "softbreak"}


def markdown_shape(tree, but):
    """Each node that is no plain text, with the number of its children that are none either."""
    return collections.Counter((tag_of(node), sum(tag_of(child) not in INLINE for child in node))
                               for node in tree.iter() if tag_of(node) not in INLINE and tag_of(node) not in but)


def markdown_words(node):
    """What stands in a node, without the joints between text and code."""
    return "".join(part.text or "" for part in node.iter() if tag_of(part) in ("text", "code"))


LINKED = re.compile(r"(?<![A-Za-z0-9])@\w|#\d|\bGH-\d|://|\bwww\.|\$|(?<!:):[a-z0-9_+-]+:(?!:)", re.IGNORECASE)


def check_markdown_tree(hostile, harmless, but=()):
    shapes = markdown_shape(hostile, but), markdown_shape(harmless, but)
    need(shapes[0] == shapes[1], f"another structure: {shapes[0] - shapes[1]} for {shapes[1] - shapes[0]}")
    for node in hostile.iter():
        texts = [child for child in node if tag_of(child) in INLINE]
        for run in re.split("\0", "".join(c.text or "" if tag_of(c) == "text" else "\0" for c in texts)):
            need(LINKED.search(run) is None, f"forges would link: {run!r}")


def check_markdown(case, hostile, harmless):
    tree = markdown_tree(hostile)
    but = ("list", "item", "paragraph") if case.get("lists_vary") else ()  # as with the likeness of texts
    check_markdown_tree(tree, markdown_tree(harmless), but)
    holders = [node for node in tree.iter() if tag_of(node) in ("table_cell", "paragraph")]
    check_shown(case, "\n".join(markdown_words(node) for node in holders))


class Tags(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.tags, self.words, self.within, self.script = [], [], "", ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, tuple(sorted(name for name, _ in attributes))))
        self.within = tag

    def handle_comment(self, data):
        self.tags.append("comment")

    def handle_data(self, data):
        self.words.append(data)
        if self.within == "script" and not self.script:
            self.script = data


def unpacked(data):
    """What the page's own data say: deflated, in base64."""
    return zlib.decompress(base64.b64decode(data, validate=True)).decode()


def check_html(case, hostile, harmless):
    read, plain = Tags(hostile), Tags(harmless)
    need(collections.Counter(read.tags) == collections.Counter(plain.tags), "other elements or attributes")
    if not case.get("script"):
        return check_shown(case, "\n".join(read.words))
    need(re.fullmatch("[A-Za-z0-9+/]+=*", read.script) is not None, "the script's data")
    hostile_data, plain_data = unpacked(read.script), unpacked(plain.script)
    need(json.loads(hostile_data).keys() == json.loads(plain_data).keys(), "other data")
    need("\u2028" not in hostile_data, "the unpacked data")
    check_json({**case, "sub": ""}, hostile_data, plain_data)


def check_xml(case, hostile, harmless):
    trees = ElementTree.fromstring(hostile.encode()), ElementTree.fromstring(harmless.encode())
    shapes = [collections.Counter((node.tag, tuple(sorted(node.attrib))) for node in tree.iter()) for tree in trees]
    need(shapes[0] == shapes[1], "other elements or attributes")
    check_shown(case, "\n".join([*trees[0].itertext(), *(v for node in trees[0].iter() for v in node.attrib.values())]))


def check_csv(case, hostile, harmless):
    rows, plain = ([row for row in csv.reader(io.StringIO(text, newline=""), strict=True)] for text in (hostile, harmless))
    need([len(row) for row in rows] == [len(row) for row in plain], "other rows or cells")
    for cell in (cell for row in rows for cell in row):
        number = re.fullmatch(r"-?[0-9.]+(e[-+][0-9]+)?", cell)
        need(number or cell.lstrip()[:1] not in ("=", "+", "-", "@", "\uff1d", "\uff0b", "\uff0d", "\uff20"), f"a formula: {cell!r}")
    for line in hostile.split("\r\n" if "\r\n" in hostile else "\n"):
        need(len(re.sub(r'"(?:[^"]|"")*"', "", line).split(";")) == 1, f"semicolons part it: {line!r}")
    check_shown(case, "\n".join(cell for row in rows for cell in row))


def strings_in(value):
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield from strings_in(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from strings_in(inner)


def shape_of(value):
    if isinstance(value, dict):
        return {key: shape_of(inner) for key, inner in sorted(value.items())}
    return [shape_of(inner) for inner in value][:1] if isinstance(value, list) else type(value).__name__


def check_json(case, hostile, harmless):
    """The true text comes back, whole."""
    read, plain = json.loads(hostile), json.loads(harmless)
    need(isinstance(read, type(plain)) and len(read) == len(plain), "another document")
    texts = "\n".join(strings_in(read))
    for wanted in case["shown"]:
        need(wanted in texts, f"not there: {wanted!r}")
    if case.get("sub") == "sarif":
        check_sarif(case, read, plain)
    if case.get("sub") == "gitlab":
        need(sorted(map(len, read)) == sorted(map(len, plain)), "other issues")
        documents = ["\n\n".join(issue["description"] for issue in value) for value in (read, plain)]
        need("\n" not in "".join(issue["description"] for issue in read), "a line break in a description")
        check_markdown_tree(*map(markdown_tree, documents))


def check_sarif(case, read, plain):
    results = read["runs"][0]["results"]
    need(len(results) == len(plain["runs"][0]["results"]), "other results")
    paths = set()
    for result in results:
        need(re.search(r"(?<!\\)\]\(", result["message"]["text"]) is None, "a link in a message")
        need(result["message"]["text"].count("\n") == 1, "a line break in a message")
        uri = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        parts = urllib.parse.urlsplit(uri)
        need(not (parts.scheme or parts.netloc or parts.query or parts.fragment), f"more than a path: {uri}")
        paths.add(urllib.parse.unquote(uri))
    for wanted in case["shown"]:
        need(wanted in paths, f"no such URI: {wanted!r}")


def check_github(case, hostile, harmless):
    """Lines as the runner reads them: ActionCommand.TryParseV2 of actions/runner."""
    lines, plain = (text.splitlines() for text in (hostile, harmless))
    need(len(lines) == len(plain), "another number of lines")
    files = []
    for line in lines:
        match = re.fullmatch(r"::(error|warning|notice) ([^:]*)::(.*)", line)
        need(match, f"no command: {line!r}")
        properties = [part.split("=", 1) for part in match[2].split(",")]
        need([name for name, _ in properties] == ["file", "line", "endLine", "title"], f"other properties: {line!r}")
        path = properties[0][1]
        for code, character in (("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ","), ("%25", "%")):
            path = path.replace(code, character)
        files.append(path)
        need(match[3].count("%0A") == 1, f"a line break: {line!r}")
    for wanted in case["shown"]:
        name = "".join(part if part in ("\n", "\r") else visible(part) for part in re.split("([\n\r])", wanted))
        need(name in files, f"no such file: {wanted!r}")


def check_toml(case, hostile, harmless):
    read, plain = tomllib.loads(hostile), tomllib.loads(harmless)
    need(shape_of(read) == shape_of(plain), "another document")
    texts = "\n".join(strings_in(read))
    for wanted in case["shown"]:
        need(wanted in texts, f"not there: {wanted!r}")


CHECKS = {"text": check_text, "markdown": check_markdown, "html": check_html, "xml": check_xml, "csv": check_csv,
          "json": check_json, "github": check_github, "toml": check_toml}


def main(folder):
    absent = [name for name, there in (("pyte", pyte), ("cmark-gfm", shutil.which("cmark-gfm"))) if not there]
    for name in absent:
        print("absent:", name)
    for case in json.loads((folder / "cases.json").read_text(encoding="utf-8")):
        kind, name = case["kind"], case["name"]
        if "cmark-gfm" in absent and (kind == "markdown" or case.get("sub") == "gitlab"):
            continue
        try:
            texts = [(folder / f"{case['file']}.{side}").read_bytes().decode("utf-8") for side in ("hostile", "harmless")]
            check_characters(texts[0], kind)
            CHECKS[kind](case, *texts)
        except Exception as problem:  # a parser that refuses the text is a problem as any other
            print(f"{name} ({kind}): {str(problem)[:300]!r}")


main(pathlib.Path(sys.argv[1]))
