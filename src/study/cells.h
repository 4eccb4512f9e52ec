#ifndef GB_STUDY_CELLS_H
#define GB_STUDY_CELLS_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/listing.h"
#include "greenbody/params.h"
#include "io/lock.h"
#include "many/pool.h"
#include "scene/field/keep_points.h"

/* The cells of a study, each measured by a worker of a pool (many/pool.h) into files of its
 * own: DIR/cells/NAME.ini says what is asked, NAME.csv is the answer.  A repeated command
 * measures only cells without an answer to the same question.  Several processes share the
 * cells: each belongs to the process that holds the lock NAME.lock.  Results depend on the
 * list alone, not on the number of workers and processes. */
struct gb_cells_item {
    struct gb_params params;
    char *name;
    char *question; /* key file: what the worker reads beside the parameters */
    bool done;
    bool submitted, ended; /* to a worker; by it, or by another process */
    bool named;            /* on_wait was called for it */
    struct gb_error error; /* GB_OK once done */
};

struct gb_cells {
    GPtrArray *list; /* of struct gb_cells_item */
    char *directory; /* DIR/cells */
};

/* Callbacks; NULL members are not called. */
struct gb_cells_callbacks {
    bool (*cancelled)(void *data);
    void (*progress)(void *data, const struct gb_cells_item *cell, size_t done,
                     size_t total);
    /* Called once for a cell of another process that is waited for since a minute. */
    void (*on_wait)(void *data, const struct gb_cells_item *cell, const char *holder);
    void *data;
};

/* Makes DIR and DIR/cells.  gb_cells_finish is due.  Errors: those of
 * gb_ensemble_make_directory. */
bool gb_cells_init(struct gb_cells *cells, const char *directory, struct gb_error *err);
void gb_cells_finish(struct gb_cells *cells); /* zeroed is fine */

/* Takes name and options (lines "key=value"); parameters and program version are added to
 * the question. */
struct gb_cells_item *gb_cells_add(struct gb_cells *cells, const struct gb_params *params,
                                   char *name, const char *options);

/* "density-0.5-cell-001", of replica 0; g_free. */
char *gb_cells_name(const struct gb_keep_point *mark, int replica);

/* Marks the cells that have an answer to the same question as done. */
void gb_cells_find_done(struct gb_cells *cells);

/* Measures the cells without an answer: work gets the path of the cell without ending.
 *
 * jobs  workers; 0: one per processor of this process
 * One that fails is marked; the others go on.  It ends when the cells of other processes
 * have ended, too.  Errors: GB_ERR_CANCELLED, GB_ERR_MACHINE
 * when no worker can be started. */
bool gb_cells_work(struct gb_cells *cells, int jobs, gb_pool_work *work,
                   const struct gb_cells_callbacks *callbacks, struct gb_error *err);

/* True when no cell failed; else GB_ERR_GUARD with their number and the first message. */
bool gb_cells_check(const struct gb_cells *cells, struct gb_error *err);

/* A double of the options of a study, and its key in the question. */
struct gb_cells_number {
    const char *key;
    size_t offset;
};

/* Lines of the question for the mark and these numbers; and for the worker, what they say.
 * A number that is missing becomes NaN. */
void gb_cells_write(GString *text, const struct gb_keep_point *mark, const void *options,
                    const struct gb_cells_number *number, size_t count);
void gb_cells_read(GKeyFile *question, struct gb_keep_point *mark, void *options,
                   const struct gb_cells_number *number, size_t count);

/* For the worker.  Takes the lock of the cell, for gb_lock_release after the answer, and
 * reads its question.  Errors: one that gb_cells_work knows where another process has the
 * cell; GB_ERR_MACHINE. */
bool gb_cells_question(GKeyFile **question, struct gb_lock *lock, const char *path,
                       struct gb_error *err);
/* A number of the question; NaN where it has none. */
double gb_cells_option(GKeyFile *question, const char *key);
/* Writes an answer, `path` with an ending. */
bool gb_cells_answer(const char *path, const char *ending, const GString *text,
                     struct gb_error *err);
/* The same of a listing, as CSV. */
bool gb_cells_table(const char *path, const char *ending,
                    const struct gb_listing *listing, struct gb_error *err);

#endif
