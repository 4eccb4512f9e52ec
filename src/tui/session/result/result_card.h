#ifndef GB_TUI_SESSION_RESULT_RESULT_CARD_H
#define GB_TUI_SESSION_RESULT_RESULT_CARD_H

#include <stdbool.h>

#include <glib.h>

#include "greenbody/params.h"

struct gb_session;
struct gb_result_card;

/* What a job in the background has found, as a few lines. */

enum gb_result_role { GB_RESULT_VALUE, GB_RESULT_NOTE, GB_RESULT_WARNING };

struct gb_result_line {
    enum gb_result_role role;
    char *text;
};

/* A parameter as the result would set it. */
struct gb_result_value {
    const struct gb_field *field;
    char *text; /* as in a preset */
};

/* One row for each kind of results (results.c). */
struct gb_result_kind {
    const char *job;   /* name of the child command; NULL: none */
    const char *title; /* "calibration" */
    const char *use;   /* what Enter does where the card has values */
    /* Fills a card without lines from the files of a job, or from the session; false: there
     * is no result. */
    bool (*fill)(struct gb_result_card *card, const struct gb_session *session);
};

struct gb_result_card {
    const struct gb_result_kind *kind; /* NULL: no such result */
    GArray *lines;                     /* struct gb_result_line */
    GArray *values;                    /* struct gb_result_value; empty: nothing to use */
    char *path;                        /* of the result: a file or a directory */
    char *page;                        /* what is opened elsewhere; NULL: path */
    char *picture;                     /* PNG that a terminal can show; NULL: none */
};

/* path: NULL: none. */
void gb_result_card_init(struct gb_result_card *card, const struct gb_result_kind *kind,
                         const char *path);
void gb_result_card_finish(struct gb_result_card *card); /* zeroed is fine */

void gb_result_card_add(struct gb_result_card *card, enum gb_result_role role,
                        const char *format, ...) __attribute__((format(printf, 3, 4)));
/* The value of a field in params becomes one that Enter sets. */
void gb_result_card_offer(struct gb_result_card *card, const struct gb_field *field,
                          const struct gb_params *params);

/* All lines and the path, as copied; g_free. */
char *gb_result_card_text(const struct gb_result_card *card);

/* Sets the values that the card offers; told receives "contact.mu = 0.28, ...", g_free.
 * Errors: GB_ERR_INPUT; params is untouched then, and told is NULL. */
bool gb_result_card_use(const struct gb_result_card *card, struct gb_params *params,
                        char **told, struct gb_error *err);

#endif
