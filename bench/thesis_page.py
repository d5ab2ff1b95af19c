# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""A page of sections with text, tables, charts and pictures, as Markdown and as one HTML file. For bench/thesis.py."""
import base64
import html
import os
import re

from thesis_chart import svg_of

STYLE = """body{font:15px/1.5 sans-serif;max-width:78em;margin:2em auto;padding:0 1em;color:#222}
table{border-collapse:collapse;margin:1em 0;font-size:13px}th,td{border-bottom:1px solid #ddd;padding:.25em .6em;text-align:right}
th:first-child,td:first-child{text-align:left}th{vertical-align:bottom}figure{display:inline-block;margin:.5em}
img{image-rendering:auto;max-width:36em}figcaption{font-size:13px;color:#555}"""


class Section:
    """`quoted`: its words are others', in which nothing is a mark of Markdown; in ours backticks are."""

    def __init__(self, title, quoted=False):
        self.title, self.quoted, self.parts = title, quoted, []

    def say(self, text):
        self.parts.append(("quote" if self.quoted else "text", text))

    def quote(self, text):
        """A paragraph of others' words, such as a program's."""
        self.parts.append(("quote", text))

    def table(self, columns, rows):
        self.parts.append(("table", columns, [[str(cell) for cell in row] for row in rows]))

    def picture(self, file, caption):
        if file.is_file():
            self.parts.append(("picture", file, caption))

    def chart(self, file, caption, bars, parts=("",)):
        """Bars by name, each with a value for every part; the Markdown page has it in `file`."""
        self.parts.append(("chart", file, caption, {name: tuple(values) for name, values in bars.items()}, tuple(parts)))


class Page:
    def __init__(self, title):
        self.title, self.leads, self.sections, self.kernels = title, [], [], {}

    def lead(self, text):
        self.leads.append(text)

    def section(self, title, quoted=False):
        self.sections.append(Section(title, quoted))
        return self.sections[-1]

    def markdown(self, folder):
        lines = [f"# {plain(self.title)}", ""]
        for lead in self.leads:
            lines += [plain(lead), ""]
        for section in self.sections:
            lines += markdown_of_section(section, folder)
        lines += [f"<!-- kernel {file} {digest} -->" for file, digest in self.kernels.items()]
        return "\n".join(lines) + "\n"

    def html(self):
        body = [f"<h1>{html.escape(self.title)}</h1>"] + [f"<p>{html.escape(lead)}</p>" for lead in self.leads]
        for section in self.sections:
            body += [f"<h2>{html.escape(section.title)}</h2>", *map(html_of, section.parts)]
        return (f"<!doctype html><html lang=en><meta charset=utf-8><title>{html.escape(self.title)}</title>"
                f"<style>{STYLE}</style>" + "\n".join(body) + "</html>\n")

    def outline(self):
        """The structure without the numbers."""
        lines = []
        for section in self.sections:
            lines.append(f"# {section.title}")
            for kind, *content in section.parts:
                if kind == "table":
                    lines.append("table: " + " | ".join(content[0]))
                    lines += [f"  row: {row[0]}" for row in content[1]]
                elif kind == "picture":
                    lines.append(f"picture: {content[1]}")
                elif kind == "chart":
                    lines.append(f"chart: {content[1]}: " + ", ".join(content[2]))
                    lines += [f"  part: {part}" for part in content[3] if part]
        return "\n".join(lines) + "\n"

    def section_of(self, title):
        return next(section for section in self.sections if section.title == title)

    def write(self, folder):
        (folder / "thesis.md").unlink(missing_ok=True)  # whose charts are replaced first
        for section in self.sections:
            write_charts(section)
        for name, text in (("thesis.md", self.markdown(folder)), ("thesis.html", self.html()), ("outline.txt", self.outline())):
            unfinished = folder / f"{name}.new"
            unfinished.write_text(text, errors="replace")  # a pack may name what no file can hold
            unfinished.replace(folder / name)


def plain(text):
    """Text of ours as Markdown that shows it, with code between backticks: one line, no tags, comments, links, pictures,
    emphasis or cells of its own."""
    escaped = re.sub(r"[\\\[\]|*~]|(?<!\w)_|_(?!\w)", r"\\\g<0>", html.escape(" ".join(text.split()), quote=False))
    return re.sub(r"(?<=:)(?=//)|(?<=www)(?=\.)", r"\\", escaped)


def literal(text):
    """The same of others' text, in which backticks are none of ours."""
    return plain(text).replace("`", r"\`")


def markdown_of_section(section, folder):
    shown = literal if section.quoted else plain
    lines = [f"## {shown(section.title)}", ""]
    for part in section.parts:
        lines += markdown_of(part, folder, shown) + [""]
    return lines


def write_charts(section):
    for kind, *content in section.parts:
        if kind == "chart":
            content[0].parent.mkdir(parents=True, exist_ok=True)
            content[0].write_text(svg_of(content[3], content[2]))


def markdown_of(part, folder, shown):
    kind, *content = part
    if kind == "text":
        return [shown(content[0])]
    if kind == "quote":
        return [literal(content[0])]
    if kind in ("picture", "chart"):
        return [f"![{shown(content[1])}]({os.path.relpath(content[0], folder)})"]
    columns, rows = content
    return ["| " + " | ".join(map(shown, columns)) + " |", "| --- |" + " ---: |" * (len(columns) - 1),
            *("| " + " | ".join(map(shown, row)) + " |" for row in rows)]


def html_of(part):
    kind, *content = part
    if kind in ("text", "quote"):
        return f"<p>{html.escape(content[0])}</p>"
    if kind == "picture":
        data = base64.b64encode(content[0].read_bytes()).decode()
        caption = html.escape(content[1])
        return f'<figure><img alt="{caption}" src="data:image/png;base64,{data}"><figcaption>{caption}</figcaption></figure>'
    if kind == "chart":
        return f"<figure>{svg_of(content[3], content[2])}<figcaption>{html.escape(content[1])}</figcaption></figure>"
    columns, rows = content
    head = "".join(f"<th>{html.escape(column)}" for column in columns)
    return f"<table><tr>{head}" + "".join("<tr>" + "".join(f"<td>{html.escape(cell)}" for cell in row) for row in rows) + "</table>"
