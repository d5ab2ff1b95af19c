#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Draws where a frame's time goes, from files of `pathtracer bench --format json`: one bar a file, to one scale.

    bench/where_time_goes.py NAME=FILE.json... > docs/performance.svg

A bar is the wall time of a frame, split by kernel; the line below it is the time that Embree alone takes for the same
rays, where it was measured.
"""
import json
import sys
from xml.sax.saxutils import escape

KERNELS = [("generate", "#8a8f98"), ("extend", "#12757a"), ("shade", "#b5562f"), ("connect", "#45609f"),
           ("finalize", "#8a8f98")]
WIDTH, LEFT, BAR, GAP = 860, 190, 26, 44


def read(argument):
    name, _, path = argument.partition("=")
    if not path:
        sys.exit(f"{argument}: expected NAME=FILE.json")
    try:
        with open(path, encoding="utf-8") as file:
            bench = json.load(file)
        return name, bench["ms_per_frame"], bench["embree_limit_ms"]
    except (OSError, ValueError, KeyError) as problem:
        sys.exit(f"{path}: {problem}; make it with: pathtracer bench SCENE --format json")


def bar(y, name, ms, limit, scale):
    out = [f'<text x="{LEFT - 12}" y="{y + 18}" text-anchor="end" class="name">{escape(name)}</text>']
    x = LEFT
    for kernel, color in KERNELS:
        width = ms[kernel] * scale
        out.append(f'<rect x="{x:.1f}" y="{y}" width="{width:.1f}" height="{BAR}" fill="{color}">'
                   f"<title>{kernel}: {ms[kernel]:.2f} ms</title></rect>")
        if width > 64:
            out.append(f'<text x="{x + 6:.1f}" y="{y + 17}" class="in">{kernel} {ms[kernel]:.1f}</text>')
        x += width
    out.append(f'<text x="{x + 8:.1f}" y="{y + 18}">{ms["total"]:.1f} ms</text>')
    if limit is not None:
        end = LEFT + limit * scale
        out.append(f'<path d="M{LEFT} {y + BAR + 5}H{end:.1f}" class="limit"/>'
                   f'<text x="{end + 8:.1f}" y="{y + BAR + 9}" class="small">Embree alone {limit:.1f} ms</text>')
    return out


def main():
    rows = [read(argument) for argument in sys.argv[1:]]
    if not rows:
        sys.exit(__doc__)
    scale = (WIDTH - LEFT - 90) / max(ms["total"] for _, ms, _ in rows)
    height = 16 + len(rows) * (BAR + GAP)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" role="img" '
           'aria-label="Wall time of a frame by kernel">',
           "<style>text{font:13px system-ui,sans-serif;fill:#1c1f24}.in{fill:#fff}.name{font-weight:600}"
           ".small{font-size:11px;fill:#565c66}.limit{stroke:#565c66;stroke-width:3}"
           "@media(prefers-color-scheme:dark){text{fill:#e8e8e4}.small{fill:#a9adb5}}</style>"]
    for i, (name, ms, limit) in enumerate(rows):
        out += bar(10 + i * (BAR + GAP), name, ms, limit, scale)
    print("\n".join(out + ["</svg>"]))


main()
