#ifndef GB_TUI_TERM_TERM_THEME_H
#define GB_TUI_TERM_TERM_THEME_H

/* Colours of a theme, as numbers of the 256 and the 16 colours of terminals; the latter
 * modulo 8 where there are only eight.  -1: the terminal's own. */

enum { GB_TERM_THEME_SERIES = 6 };

struct gb_term_theme {
    short series[GB_TERM_THEME_SERIES], series_16[GB_TERM_THEME_SERIES];
    short grey, grey_16;
    short text, text_16;
    short background, background_16; /* of all cells */
};

/* theme: of enum gb_settings_theme.  Of the six series any two differ by at least 15 in
 * CIELAB, also for protanopia, deuteranopia and tritanopia (matrices of Machado et al.
 * 2009).  Contrast, as in WCAG: light at least 3 on white, dark 5 on black, contrast 7 on
 * its black background; auto 2.4 on white and 3.2 on black. */
const struct gb_term_theme *gb_term_theme_row(int theme);

/* The theme itself; auto becomes light or dark for a terminal that tells its background in
 * $COLORFGBG ("15;0"; NULL: it does not). */
int gb_term_theme_resolve(int theme, const char *colorfgbg);

#endif
