#include "tui/term/term_style.h"

#include <ncurses.h>
#include <stdbool.h>

#include "tui/term/term.h"

/* Palette of Okabe and Ito, distinguishable with every kind of colour vision, in the
 * nearest of 256 colours with enough contrast on a white background; and its nearest of 8
 * colours. */
static const short series_256[] = {74, 172, 36, 175, 166, 32};
static const short series_8[] = {COLOR_CYAN,    COLOR_YELLOW, COLOR_GREEN,
                                 COLOR_MAGENTA, COLOR_RED,    COLOR_BLUE};

enum { SERIES = sizeof series_8 / sizeof series_8[0], GREY_256 = 244, GREY_16 = 8 };

static void set_plain(uint64_t *style)
{
    style[GB_STYLE_PLAIN] = A_NORMAL;
    style[GB_STYLE_DIM] = A_DIM;
    style[GB_STYLE_BOLD] = A_BOLD;
    style[GB_STYLE_TITLE] = A_NORMAL;
    style[GB_STYLE_FOCUS] = A_REVERSE | A_BOLD;
    style[GB_STYLE_SELECTED] = A_REVERSE;
    style[GB_STYLE_EDIT] = A_UNDERLINE | A_BOLD;
    style[GB_STYLE_CHANGED] = A_BOLD;
    style[GB_STYLE_GOOD] = A_NORMAL;
    style[GB_STYLE_WARN] = A_BOLD;
    style[GB_STYLE_BAD] = A_BOLD;
    for (int i = 0; i < SERIES; i++) {
        style[GB_STYLE_SERIES + i] = A_NORMAL;
    }
}

static void set_colours(uint64_t *style)
{
    const short *series = COLORS >= 256 ? series_256 : series_8;
    uint64_t pair[SERIES];
    for (short i = 0; i < SERIES; i++) {
        init_pair((short)(i + 1), series[i], -1);
        pair[i] = (uint64_t)COLOR_PAIR(i + 1);
        style[GB_STYLE_SERIES + i] = pair[i];
    }
    if (COLORS >= 16) {
        init_pair(SERIES + 1, COLORS >= 256 ? GREY_256 : GREY_16, -1);
        style[GB_STYLE_DIM] = (uint64_t)COLOR_PAIR(SERIES + 1);
    }
    style[GB_STYLE_CHANGED] = pair[1] | A_BOLD;
    style[GB_STYLE_GOOD] = pair[2];
    style[GB_STYLE_WARN] = pair[1] | A_BOLD;
    style[GB_STYLE_BAD] = pair[4] | A_BOLD;
    style[GB_STYLE_FOCUS] = pair[0] | A_REVERSE | A_BOLD;
}

/* One hue from dark to light: depth is visible with every kind of colour vision. */
static const short shades_256[GB_TERM_SHADES] = {17, 23, 24, 31, 38, 74, 117, 195};

enum {
    SHADE_PAIRS = SERIES + 2, /* first colour pair of the shades */
    PAIRS = SHADE_PAIRS + GB_TERM_SHADES * (GB_TERM_SHADES + 1)
};

static short shade_pair(int shade, int back)
{
    return (short)(SHADE_PAIRS + shade * (GB_TERM_SHADES + 1) + back + 1);
}

static bool set_shades(void)
{
    if (COLORS < 256 || COLOR_PAIRS < PAIRS) {
        return false;
    }
    for (int shade = 0; shade < GB_TERM_SHADES; shade++) {
        for (int back = -1; back < GB_TERM_SHADES; back++) {
            init_pair(shade_pair(shade, back), shades_256[shade],
                      back < 0 ? -1 : shades_256[back]);
        }
    }
    return true;
}

uint64_t gb_term_style_shade(int shade, int back)
{
    return (uint64_t)COLOR_PAIR(shade_pair(shade, back));
}

bool gb_term_style_init(uint64_t *style, bool coloured)
{
    set_plain(style);
    if (!coloured || !has_colors() || start_color() != OK || use_default_colors() != OK) {
        return false;
    }
    set_colours(style);
    return set_shades();
}
