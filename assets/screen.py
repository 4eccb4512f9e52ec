#!/usr/bin/env python3
"""A terminal's screen as PNG, by cairo and DejaVu Sans Mono:

tmux capture-pane -e -p -t PANE | assets/screen.py screen.png

Colours come from the escape sequences, Braille dots and half blocks are drawn as dots and
blocks.
"""
import ctypes
import ctypes.util
import re
import sys

WIDE, HIGH, SIZE, MARGIN = 9.0, 19.0, 15.0, 8.0
TEXT, GROUND = (0xdc, 0xdc, 0xe0), (0x17, 0x17, 0x1c)
BASIC = [(0, 0, 0), (205, 49, 49), (13, 188, 121), (229, 229, 16), (36, 114, 200), (188, 63, 188),
         (17, 168, 205), (229, 229, 229), (102, 102, 102), (241, 76, 76), (35, 209, 139),
         (245, 245, 67), (59, 142, 234), (214, 112, 214), (41, 184, 219), (255, 255, 255)]
# dots of a Braille cell: column and row of each bit
DOTS = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3)]
CAIRO = ctypes.CDLL(ctypes.util.find_library("cairo"))


def cairo(name, *arguments, result=None):
    function = getattr(CAIRO, "cairo_" + name)
    function.restype = result
    return function(*(ctypes.c_double(a) if isinstance(a, float) else a for a in arguments))


def indexed(index):
    if index < 16:
        return BASIC[index]
    if index >= 232:
        return (8 + 10 * (index - 232),) * 3
    index -= 16
    return tuple(55 + 40 * c if c else 0 for c in (index // 36, index // 6 % 6, index % 6))


def apply(style, codes):
    """Select graphic rendition."""
    codes = [int(c or 0) for c in codes.split(";")]
    while codes:
        code = codes.pop(0)
        if code == 0:
            style.clear()
        elif code in (1, 2, 7):
            style[code] = True
        elif code in (22, 27):
            for c in (1, 2) if code == 22 else (7,):
                style.pop(c, None)
        elif code in (38, 48):
            side = "text" if code == 38 else "ground"
            if codes.pop(0) == 5:
                style[side] = indexed(codes.pop(0))
            else:
                style[side], codes = tuple(codes[:3]), codes[3:]
        elif code in (39, 49):
            style.pop("text" if code == 39 else "ground", None)
        elif 30 <= code % 60 < 38 or 40 <= code % 60 < 48:
            bright = 8 if code >= 90 else 0
            style["text" if code % 60 < 38 else "ground"] = BASIC[code % 10 + bright]


def cells(line):
    """Of a line: character, colour, ground and whether it is bold."""
    style, out = {}, []
    for part in re.findall(r"\x1b\[([0-9;]*)m|\x1b[()][0-9A-Z]|([^\x1b])", line):
        if not part[1]:
            apply(style, part[0])
            continue
        text, ground = style.get("text", TEXT), style.get("ground", GROUND)
        if 7 in style:
            text, ground = ground, text
        if 2 in style:
            text = tuple((2 * t + g) // 3 for t, g in zip(text, ground))
        out.append((part[1], text, ground, 1 in style))
    return out


def colour(context, rgb):
    cairo("set_source_rgb", context, *(c / 255.0 for c in rgb))


def block(context, rgb, x, y, wide, high):
    colour(context, rgb)
    cairo("rectangle", context, x, y, wide, high)
    cairo("fill", context)


def draw_glyph(context, x, y, char, bold):
    if 0x2800 <= ord(char) < 0x2900:
        for bit, (column, row) in enumerate(DOTS):
            if ord(char) - 0x2800 >> bit & 1:
                cairo("arc", context, x + (0.5 + column) * WIDE / 2, y + (0.5 + row) * HIGH / 4,
                      1.5, 0.0, 6.2832)
                cairo("fill", context)
        return
    cairo("select_font_face", context, b"DejaVu Sans Mono", 0, int(bold))
    cairo("move_to", context, x, y + 0.77 * HIGH)
    cairo("show_text", context, char.encode())


def draw_cell(context, x, y, cell):
    char, text, ground, bold = cell
    if ground != GROUND:
        block(context, ground, x, y, WIDE, HIGH)
    if char in "\u2580\u2584\u2588":
        upper = HIGH / 2 if char == "\u2584" else 0.0
        block(context, text, x, y + upper, WIDE, HIGH if char == "\u2588" else HIGH / 2)
    elif char != " ":
        colour(context, text)
        draw_glyph(context, x, y, char, bold)


def main():
    lines = [cells(line) for line in sys.stdin.read().rstrip("\n").split("\n")]
    pixels = [int(2 * MARGIN + size) for size in
              (max(len(line) for line in lines) * WIDE, len(lines) * HIGH)]
    surface = ctypes.c_void_p(cairo("image_surface_create", 1, *pixels, result=ctypes.c_void_p))
    context = ctypes.c_void_p(cairo("create", surface, result=ctypes.c_void_p))
    cairo("set_font_size", context, SIZE)
    block(context, GROUND, 0.0, 0.0, *map(float, pixels))
    for row, line in enumerate(lines):
        for column, cell in enumerate(line):
            draw_cell(context, MARGIN + column * WIDE, MARGIN + row * HIGH, cell)
    status = cairo("surface_write_to_png", surface, sys.argv[1].encode(), result=ctypes.c_int)
    sys.exit(f"{sys.argv[1]}: cairo: status {status}" if status else 0)


main()
