#!/usr/bin/env python3
"""Draws a terminal's page, as `tmux capture-pane -e -p` gives it, as SVG on stdout.

    tmux capture-pane -e -p | tools/terminal_svg.py COLUMNS ROWS > picture.svg
    tools/terminal_svg.py COLUMNS ROWS page1.txt page2.txt … --seconds 0.2 > film.svg    (plays for ever)

Blocks and braille are drawn as shapes, so that the picture does not depend on the fonts of the reader.
"""
import argparse
import html
import re
import sys

WIDTH, HEIGHT, BASELINE = 9, 18, 14
FORE, BACK = "#d8dbe2", "#14161c"
BASIC = ["#000000", "#aa0000", "#00aa00", "#aa5500", "#0000aa", "#aa00aa", "#00aaaa", "#aaaaaa",
         "#555555", "#ff5555", "#55ff55", "#ffff55", "#5555ff", "#ff55ff", "#55ffff", "#ffffff"]
# Quadrants of each block character: 1 upper left, 2 upper right, 4 lower left, 8 lower right.
QUADRANTS = {c: i for i, c in enumerate(" ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█")}
EIGHTHS = {c: i + 1 for i, c in enumerate("▁▂▃▄▅▆▇")}
BRAILLE = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3)]


def indexed(number):
    if number < 16:
        return BASIC[number]
    if number >= 232:
        return "#" + f"{8 + 10 * (number - 232):02x}" * 3
    steps = [0, 95, 135, 175, 215, 255]
    number -= 16
    return "#" + "".join(f"{steps[part]:02x}" for part in (number // 36, number // 6 % 6, number % 6))


class Ink:
    def __init__(self):
        self.fore, self.back, self.bold = None, None, False

    def take(self, codes):
        """Applies the numbers of one SGR sequence."""
        codes = [int(code or 0) for code in codes] or [0]
        while codes:
            code = codes.pop(0)
            if code == 0:
                self.__init__()
            elif code == 1:
                self.bold = True
            elif code in (38, 48):
                kind = codes.pop(0)
                colour = indexed(codes.pop(0)) if kind == 5 else "#" + "".join(
                    f"{codes.pop(0):02x}" for _ in range(3))
                if code == 38:
                    self.fore = colour
                else:
                    self.back = colour
            elif code in (39, 49):
                setattr(self, "fore" if code == 39 else "back", None)
            else:
                for first, offset, name in ((30, 0, "fore"), (40, 0, "back"), (90, 8, "fore"), (100, 8, "back")):
                    if first <= code < first + 8:
                        setattr(self, name, BASIC[code - first + offset])


def cells(text, rows):
    """Yields (row, column, character, fore, back, bold)."""
    ink = Ink()
    for row, line in enumerate(text.split("\n")[:rows]):
        column = 0
        for match in re.finditer(r"\x1b\[([0-9;]*)m|\x1b\[[0-9;?]*[A-Za-ln-z]|\x1b[()].|([^\x1b\x0e\x0f])", line):
            if match.group(2):
                yield row, column, match.group(2), ink.fore or FORE, ink.back, ink.bold
                column += 1
            elif match.group(1) is not None:
                ink.take(match.group(1).split(";"))


def box(x, y, width, height, colour):
    return f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" fill="{colour}"/>'


def shapes(character, x, y, fore):
    if character in EIGHTHS:
        height = HEIGHT * EIGHTHS[character] / 8
        return [box(x, y + HEIGHT - height, WIDTH, height, fore)]
    if character in QUADRANTS:
        bits = QUADRANTS[character]
        if bits == 15:
            return [box(x, y, WIDTH, HEIGHT, fore)]
        if bits in (3, 12):
            return [box(x, y + (0 if bits == 3 else HEIGHT / 2), WIDTH, HEIGHT / 2, fore)]
        if bits in (5, 10):
            return [box(x + (0 if bits == 5 else WIDTH / 2), y, WIDTH / 2, HEIGHT, fore)]
        return [box(x + WIDTH / 2 * (i % 2), y + HEIGHT / 2 * (i // 2), WIDTH / 2, HEIGHT / 2, fore)
                for i in range(4) if bits >> i & 1]
    bits = ord(character) - 0x2800
    return [f'<circle cx="{x + WIDTH * (2 * across + 1) / 4:g}" cy="{y + HEIGHT * (2 * down + 1) / 8:g}" r="1.1" '
            f'fill="{fore}"/>' for i, (across, down) in enumerate(BRAILLE) if bits >> i & 1]


def page(text, rows):
    backs, signs, words = [], [], []
    for row, column, character, fore, back, bold in cells(text, rows):
        x, y = column * WIDTH, row * HEIGHT
        if back:
            same = backs and backs[-1][1] == y and backs[-1][0] + backs[-1][2] == x and backs[-1][3] == back
            if same:
                backs[-1][2] += WIDTH
            else:
                backs.append([x, y, WIDTH, back])
        if character in EIGHTHS or (character in QUADRANTS and character != " ") or 0x2800 <= ord(character) < 0x2900:
            signs += shapes(character, x, y, fore)
        elif character != " ":
            style = (y, fore, bold)
            if words and words[-1][0] == style and words[-1][1] + WIDTH * len(words[-1][2]) == x:
                words[-1][2] += character
            else:
                words.append([style, x, character])
    lines = [box(x, y, width, HEIGHT, colour) for x, y, width, colour in backs] + signs
    for (y, fore, bold), x, text_run in words:
        weight = ' font-weight="bold"' if bold else ""
        lines.append(f'<text x="{x}" y="{y + BASELINE}" fill="{fore}"{weight} textLength="{WIDTH * len(text_run)}">'
                     f"{html.escape(text_run)}</text>")
    return "".join(lines)


def film(pages, rows, seconds):
    if len(pages) == 1:
        return page(pages[0], rows)
    whole = seconds * len(pages)
    parts = []
    for i, text in enumerate(pages):
        times = f"0;{i / len(pages):.5f};{(i + 1) / len(pages):.5f}"
        values = "none;inline;none" if i else "inline;inline;none"
        parts.append(f'<g display="none"><animate attributeName="display" values="{values}" keyTimes="{times}" '
                     f'calcMode="discrete" dur="{whole:g}s" repeatCount="indefinite"/>{page(text, rows)}</g>')
    return "".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("columns", type=int)
    parser.add_argument("rows", type=int)
    parser.add_argument("pages", nargs="*", help="files with one page each; none: stdin")
    parser.add_argument("--seconds", type=float, default=0.2, help="how long each page stays")
    given = parser.parse_args()
    pages = [open(name, encoding="utf-8").read() for name in given.pages] or [sys.stdin.read()]
    width, height = given.columns * WIDTH, given.rows * HEIGHT
    print(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
          f'viewBox="0 0 {width} {height}" font-family="DejaVu Sans Mono, Menlo, Consolas, monospace" font-size="14" '
          f'xml:space="preserve">' + box(0, 0, width, height, BACK) + film(pages, given.rows, given.seconds) + "</svg>")


if __name__ == "__main__":
    main()
