#ifndef GB_TUI_SESSION_RESULTS_H
#define GB_TUI_SESSION_RESULTS_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/curve.h"
#include "greenbody/params.h"
#include "many/compaction_data.h"
#include "measure/compaction_fits.h"

/* The last result of each kind. */
enum gb_results_kind {
    GB_RESULTS_CALIBRATION,
    GB_RESULTS_REPLICAS,
    GB_RESULTS_MODULI,
    GB_RESULTS_CHART,
    GB_RESULTS_STABILITY,
    GB_RESULTS_PICTURE,
    GB_RESULTS_REPORT,
    GB_RESULTS_FIT,
    GB_RESULTS_KINDS
};

struct gb_result_card;

struct gb_session;

/* One row for each kind of results (results.c). */
struct gb_result_kind {
    const char *job;   /* name of the child command; NULL: none */
    const char *title; /* "calibration" */
    const char *use;   /* what Enter does if the card has values */
    /* Fills an empty card from the files of a job, or from the session.  False: there
     * is no result. */
    bool (*fill)(struct gb_result_card *card, const struct gb_session *session);
};

struct gb_result_card {
    const struct gb_result_kind *kind; /* NULL: no such result */
    GArray *lines;                     /* struct gb_result_line */
    GArray *values;                    /* struct gb_result_value; empty: nothing to use */
    char *path;                        /* of the result: a file or a directory */
    char *page;                        /* file opened in another program; NULL: path */
    char *picture;                     /* PNG that a terminal can show; NULL: none */
};

/* Compaction equations fitted to the curve on display.  They are fitted again only when
 * the curve has grown: with linear intervals during a run (about 1 ms), with profiles
 * after its end. */
struct gb_compaction_cache {
    const struct gb_curve *curve; /* NULL: nothing fitted yet */
    size_t points;
    double first; /* density of the first point: detects another curve at the address */
    enum gb_compaction_intervals intervals;
    bool fitted; /* else: reason */
    struct gb_error reason;
    struct gb_compaction_data data;
    struct gb_compaction_fits fits;
};

struct gb_results {
    struct gb_result_card card[GB_RESULTS_KINDS];
    enum gb_results_kind recent[GB_RESULTS_KINDS]; /* the newest first */
    int count;
    bool news;                       /* a job has ended since gb_results_take_news */
    struct gb_compaction_cache fits; /* of the card of fits */
};

void gb_results_finish(struct gb_results *results); /* zeroed is fine */

/* Takes the result of a successful job, by its name and the path of its result.
 * Nothing changes for a job without a row. */
void gb_results_take(struct gb_results *results, const struct gb_session *session,
                     const char *job, const char *path);
/* Makes the card of a kind from what the session shows; false: there is no result. */
bool gb_results_make(struct gb_results *results, const struct gb_session *session,
                     enum gb_results_kind kind);

/* Has a job ended since the last call? */
bool gb_results_take_news(struct gb_results *results);

/* The card that is `back` older than the newest; NULL: none. */
const struct gb_result_card *gb_results_at(const struct gb_results *results, int back);

/* Fits the first `points` points of a curve unless it was done; true if there are fits
 * to show. */
bool gb_results_fits_update(struct gb_compaction_cache *cache,
                            const struct gb_curve *curve, size_t points,
                            enum gb_compaction_intervals intervals);

void gb_results_fits_finish(struct gb_compaction_cache *cache); /* zeroed is fine */

enum gb_result_role { GB_RESULT_VALUE, GB_RESULT_NOTE, GB_RESULT_WARNING };

struct gb_result_line {
    enum gb_result_role role;
    char *text;
};

/* A parameter that the result offers to set. */
struct gb_result_value {
    const struct gb_field *field;
    char *text; /* as in a preset */
};

/* All lines and the path, for the clipboard; g_free. */
char *gb_results_card_text(const struct gb_result_card *card);

/* Sets the values offered by the card. told receives "contact.mu = 0.28, ...", g_free.
 * Errors: GB_ERR_INPUT; params does not change then, and told is NULL. */
bool gb_results_card_use(const struct gb_result_card *card, struct gb_params *params,
                         char **told, struct gb_error *err);

#endif
