#ifndef GB_CLI_PAGE_OPTIONS_H
#define GB_CLI_PAGE_OPTIONS_H

#include <stdbool.h>

#include <glib.h>

#include "greenbody/status.h"

/* Options of the size of pictures and figures: pixels, or a width in print. */
struct gb_page_options {
    char *size, *width; /* NULL: not given; owned */
    int per_inch;       /* 0: not given */
};

#define GB_PAGE_OPTIONS_ENTRIES(options)                                                 \
    {"size",        0, 0, G_OPTION_ARG_STRING, &(options)->size, "pixels (1600x1200)",   \
     "WIDTHxHEIGHT"},                                                                    \
        {"width",                                                                        \
         0,                                                                              \
         0,                                                                              \
         G_OPTION_ARG_STRING,                                                            \
         &(options)->width,                                                              \
         "in print, as in 8cm, 80mm or a journal's column, as elsevier: letters of 6 "   \
         "to 9 points there",                                                            \
         "WIDTH"},                                                                       \
    {                                                                                    \
        "dpi", 0, 0, G_OPTION_ARG_INT, &(options)->per_inch,                             \
            "pixels per inch of print, with --width (300)", "N"                          \
    }

/* Sets pixels and pixels per inch of print where options were given.  Errors: GB_ERR_INPUT
 * saying what is accepted. */
bool gb_page_options_take(const struct gb_page_options *options, int *width, int *height,
                          int *per_inch, struct gb_error *err);
/* Widths of the columns of journals for the help of a command, with a line above; g_free. */
char *gb_page_options_journals(void);
void gb_page_options_finish(struct gb_page_options *options);

#endif
