#ifndef GB_TUI_SESSION_OVERLAY_STABILITY_CSV_H
#define GB_TUI_SESSION_OVERLAY_STABILITY_CSV_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* The stability.csv of `greenbody stability PRESET`: longest stable steps of the methods of
 * a scene in states of its run. */
struct gb_stability_csv_row {
    char method[24];
    double density;
    double measured, used; /* sqrt(m/(E d)), which is T; of steepest 1/(E d) */
    bool stable;           /* with the step that the run takes */
    bool in_use;
};

struct gb_stability_csv {
    size_t count;
    bool in_time; /* velocity Verlet with the step that it takes; else relaxers, which take
                   * up to theirs and shorten it */
    struct gb_stability_csv_row *row; /* in the order of the run */
    double *p_mpa, *margin;           /* margin: measured over used */
};

/* Errors: GB_ERR_INPUT for another table, in one line. */
bool gb_stability_csv_read(struct gb_stability_csv **out, const char *path,
                           struct gb_error *err);
void gb_stability_csv_destroy(struct gb_stability_csv *table); /* NULL is fine */

/* The row of the method in use with the least margin; count: none. */
size_t gb_stability_csv_weakest(const struct gb_stability_csv *table);

/* The parameters with the method of row i, in a dynamic scene with the time step that
 * leaves a margin of 2 there; text receives it, as a preset has it.  Errors: GB_ERR_INPUT
 * for a relaxer that is not stable there. */
bool gb_stability_csv_apply(const struct gb_stability_csv *table, size_t i,
                            struct gb_params *params, char *text, size_t size,
                            struct gb_error *err);

#endif
