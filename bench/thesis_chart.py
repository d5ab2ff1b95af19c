# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Bars side by side, each of one part or of several, as SVG. For bench/thesis_page.py."""
import html

COLOURS = ("#3b6ea5", "#e0913a", "#5b9a59", "#a65a8c", "#8a8a8a")
ROW, TEXT, LEFT, WIDTH, RIGHT = 22, 12, 190, 420, 90


def text(x, y, words, anchor="start"):
    return f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}">{html.escape(words)}</text>'


def legend(parts, y):
    out, x = [], LEFT
    for part, colour in zip(parts, COLOURS):
        out += [f'<rect x="{x}" y="{y - 10}" width="10" height="10" fill="{colour}"/>', text(x + 14, y, part)]
        x += 30 + 7 * len(part)
    return out


def svg_of(parts, bars):
    """`bars`: by name one value for each of `parts`; what is below 0 is drawn as nothing. A bar ends in its sum."""
    most = max([sum(max(value, 0) for value in values) for values in bars.values()] + [1e-9])
    top = ROW if len(parts) > 1 else 4
    out = legend(parts, ROW - 8) if len(parts) > 1 else []
    for i, (name, values) in enumerate(bars.items()):
        y, x = top + i * ROW, float(LEFT)
        out.append(text(LEFT - 6, y + 15, name, "end"))
        for value, colour in zip(values, COLOURS):
            width = WIDTH * max(value, 0) / most
            out.append(f'<rect x="{x:.1f}" y="{y + 3}" width="{width:.1f}" height="{ROW - 6}" fill="{colour}"/>')
            x += width
        out.append(text(x + 5, y + 15, f"{sum(values):.0f}" if sum(values) >= 1000 else f"{sum(values):.4g}"))
    size = f'width="{LEFT + WIDTH + RIGHT}" height="{top + ROW * len(bars) + 4}"'
    return (f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="{TEXT}">'
            '<rect width="100%" height="100%" fill="white"/>' + "".join(out) + "</svg>\n")
