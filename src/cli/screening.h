#ifndef GB_CLI_SCREENING_H
#define GB_CLI_SCREENING_H

#include <glib.h>

#include "tui/term/settings.h"

/* Options of the commands that open a screen. */
struct gb_screening {
    char *color, *graph, *images, *mouse; /* owned; NULL: not given */
    gboolean ascii, slow, diagnose;
};

/* The entries, to be put into a command's list. */
#define GB_SCREENING_OPTIONS(to)                                                         \
    {"color",                                                                            \
     0,                                                                                  \
     0,                                                                                  \
     G_OPTION_ARG_STRING,                                                                \
     &(to)->color,                                                                       \
     "auto, always or never; auto: unless NO_COLOR is set",                              \
     "WHEN"},                                                                            \
        {"graph",                                                                        \
         0,                                                                              \
         0,                                                                              \
         G_OPTION_ARG_STRING,                                                            \
         &(to)->graph,                                                                   \
         "auto, braille, block or ascii: how plots are drawn",                           \
         "HOW"},                                                                         \
        {"images",                                                                       \
         0,                                                                              \
         0,                                                                              \
         G_OPTION_ARG_STRING,                                                            \
         &(to)->images,                                                                  \
         "auto, none, sixel or kitty: the packing in real pixels",                       \
         "HOW"},                                                                         \
        {"mouse",                                                                        \
         0,                                                                              \
         0,                                                                              \
         G_OPTION_ARG_STRING,                                                            \
         &(to)->mouse,                                                                   \
         "on or off; dragging with Shift selects text in any case",                      \
         "on"},                                                                          \
        {"ascii", 0, 0, G_OPTION_ARG_NONE, &(to)->ascii, "nothing but ASCII", NULL},     \
        {"slow",      0,                                                                 \
         0,           G_OPTION_ARG_NONE,                                                 \
         &(to)->slow, "two frames a second instead of ten",                              \
         NULL},                                                                          \
    {                                                                                    \
        "diagnose", 0, 0, G_OPTION_ARG_NONE, &(to)->diagnose,                            \
            "tell what the terminal is taken for, and leave", NULL                       \
    }

/* What the file says, and over it the options. */
bool gb_screening_settings(const struct gb_screening *screening,
                           struct gb_settings *settings, struct gb_error *err);
void gb_screening_finish(struct gb_screening *screening);

/* Takes those options out of the words of a command that opens no screen; returns how
 * many words are left.  --batch, which asks for none, goes as well. */
int gb_screening_drop(int argc, char **argv);

/* Whether one of the words, before a "--", is this. */
bool gb_screening_has(int argc, char **argv, const char *word);

#endif
