#ifndef GB_TUI_LEGS_LEG_WORDS_H
#define GB_TUI_LEGS_LEG_WORDS_H

#include "scene/path/path.h"

/* What a leg does, in words, one line each. */
enum { GB_LEG_WORDS = 160 };

struct gb_leg_words {
    char leads[GB_LEG_WORDS]; /* "xz by strain" */
    char held[GB_LEG_WORDS];  /* "z at 50 MPa, x = 0.5 z" */
    char fixed[GB_LEG_WORDS]; /* "x, y, xy, yz" */
    char ends[GB_LEG_WORDS];  /* "at a strain of 20 % of xz" */
};

void gb_leg_words_write(const struct gb_leg *leg, int dimension,
                        struct gb_leg_words *words);

#endif
