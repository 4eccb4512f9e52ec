#include "tui/term/term_style.h"

#include <ncurses.h>
#include <stdbool.h>

#include "tui/term/term.h"
#include "tui/term/term_theme.h"

/* Numbers of colour pairs; those of the shades come last. */
enum {
    SERIES = GB_TERM_THEME_SERIES,
    GREY_PAIR = SERIES + 1,
    TEXT_PAIR,
    SHADE_PAIRS,
    PAIRS = SHADE_PAIRS + GB_TERM_SHADES * (GB_TERM_SHADES + 1)
};

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

/* The colour that the terminal has. */
static short of_terminal(short colour_256, short colour_16)
{
    return COLORS >= 256                      ? colour_256
           : COLORS >= 16 || colour_16 < 0 ? colour_16
                                              : (short)(colour_16 % 8);
}

static short background_of(const struct gb_term_theme *theme)
{
    return of_terminal(theme->background, theme->background_16);
}

/* Text without a pair of its own gets the pair of the background, too. */
static void set_background(const struct gb_term_theme *theme)
{
    init_pair(TEXT_PAIR, of_terminal(theme->text, theme->text_16), background_of(theme));
    bkgdset(theme->background < 0 ? ' ' : (chtype)' ' | (chtype)COLOR_PAIR(TEXT_PAIR));
}

static void set_colours(uint64_t *style, const struct gb_term_theme *theme)
{
    const short back = background_of(theme);
    uint64_t pair[SERIES];
    for (short i = 0; i < SERIES; i++) {
        init_pair((short)(i + 1), of_terminal(theme->series[i], theme->series_16[i]),
                  back);
        pair[i] = (uint64_t)COLOR_PAIR(i + 1);
        style[GB_STYLE_SERIES + i] = pair[i];
    }
    if (COLORS >= 16) {
        init_pair(GREY_PAIR, of_terminal(theme->grey, theme->grey_16), back);
        style[GB_STYLE_DIM] = (uint64_t)COLOR_PAIR(GREY_PAIR);
    }
    style[GB_STYLE_CHANGED] = pair[1] | A_BOLD;
    style[GB_STYLE_GOOD] = pair[2];
    style[GB_STYLE_WARN] = pair[1] | A_BOLD;
    style[GB_STYLE_BAD] = pair[4] | A_BOLD;
    style[GB_STYLE_FOCUS] = pair[0] | A_REVERSE | A_BOLD;
}

/* One hue from dark to light: depth is visible with every kind of colour vision. */
static const short shades_256[GB_TERM_SHADES] = {17, 23, 24, 31, 38, 74, 117, 195};

static short shade_pair(int shade, int back)
{
    return (short)(SHADE_PAIRS + shade * (GB_TERM_SHADES + 1) + back + 1);
}

static bool set_shades(short background)
{
    if (COLORS < 256 || COLOR_PAIRS < PAIRS) {
        return false;
    }
    for (int shade = 0; shade < GB_TERM_SHADES; shade++) {
        for (int back = -1; back < GB_TERM_SHADES; back++) {
            init_pair(shade_pair(shade, back), shades_256[shade],
                      back < 0 ? background : shades_256[back]);
        }
    }
    return true;
}

uint64_t gb_term_style_shade(int shade, int back)
{
    return (uint64_t)COLOR_PAIR(shade_pair(shade, back));
}

bool gb_term_style_init(uint64_t *style, bool coloured, int theme)
{
    const struct gb_term_theme *row = gb_term_theme_row(theme);
    set_plain(style);
    if (!coloured || !has_colors() || start_color() != OK || use_default_colors() != OK) {
        return false;
    }
    set_background(row);
    set_colours(style, row);
    return set_shades(background_of(row));
}
