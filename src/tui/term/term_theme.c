#include "tui/term/term_theme.h"

#include <stdlib.h>
#include <string.h>

#include "tui/term/settings.h"

enum { WHITE_16 = 15, WHITE_256 = 231, BLACK_256 = 16, LIGHT_GREY_16 = 7 };

/* Series: sky blue, orange, green, pink, red, blue: the hues of Okabe and Ito. */
#define PLAIN_16  {6, 3, 2, 5, 1, 4}
#define BRIGHT_16 {14, 11, 10, 13, 9, 12}

static const struct gb_term_theme themes[] = {
    [GB_THEME_AUTO] = {{39, 208, 108, 139, 160, 25}, PLAIN_16, 244, 8, -1, -1, -1, -1},
    [GB_THEME_LIGHT] = {{32, 136, 65, 139, 124, 24}, PLAIN_16, 240, 8, -1, -1, -1, -1},
    [GB_THEME_DARK] =
        {{45, 221, 151, 169, 196, 33}, BRIGHT_16, 247, LIGHT_GREY_16, -1, -1, -1, -1},
    [GB_THEME_CONTRAST] = {{81, 214, 35, 211, 223, 111},
                           BRIGHT_16,
                           WHITE_256,
                           WHITE_16,
                           WHITE_256,
                           WHITE_16,
                           BLACK_256,
                           0},
};

const struct gb_term_theme *gb_term_theme_row(int theme)
{
    return &themes[theme];
}

int gb_term_theme_resolve(int theme, const char *colorfgbg)
{
    const char *background = colorfgbg != NULL ? strrchr(colorfgbg, ';') : NULL;
    char *end = NULL;
    const long colour = background != NULL ? strtol(background + 1, &end, 10) : -1;
    if (theme != GB_THEME_AUTO || background == NULL || end == background + 1 || *end != '\0' || colour < 0 ||
        colour > WHITE_16) {
        return theme;
    }
    return colour == LIGHT_GREY_16 || colour > LIGHT_GREY_16 + 1 ? GB_THEME_LIGHT
                                                                 : GB_THEME_DARK;
}
