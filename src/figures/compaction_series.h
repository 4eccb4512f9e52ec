#ifndef GB_FIGURES_COMPACTION_SERIES_H
#define GB_FIGURES_COMPACTION_SERIES_H

#include "figures/series.h"
#include "many/compaction_data.h"
#include "measure/fit/compaction/compaction_fits.h"

/* Points of one powder with fitted equations of compaction as curves of a figure. */
struct gb_compaction_series {
    struct gb_compaction_data data;
    struct gb_compaction_fits fits;
    char *label; /* of the points, Pango markup */
};

enum { GB_COMPACTION_SERIES_EQUATIONS = 6 }; /* most that one figure shows */

/* Fits all equations (only NULL), or one, to data that it takes over; label is copied.
 * gb_compaction_series_finish is due in any case.  Errors: GB_ERR_INPUT when none is
 * defined, GB_ERR_MEMORY. */
bool gb_compaction_series_init(struct gb_compaction_series *one,
                               const struct gb_compaction_data *data,
                               const struct gb_equation *only, const char *label,
                               struct gb_error *err);
void gb_compaction_series_finish(struct gb_compaction_series *one); /* zeroed is fine */

/* Draws powders into a series that it initialises. */
typedef bool gb_compaction_series_draw(struct gb_series *series,
                                       const struct gb_compaction_series *all,
                                       size_t count, struct gb_error *err);

/* Density against pressure with the curves of the best equations, residuals below: up to
 * six of one powder, the best one of each of several. */
gb_compaction_series_draw gb_compaction_series_fit;

/* ln(1/(1 - rho)) against pressure with the line of the straightest stretch of each.
 * Errors: GB_ERR_INPUT where Heckel's equation is refused. */
gb_compaction_series_draw gb_compaction_series_heckel;

/* The groups of a set as powders, drawn by one of the functions above. */
bool gb_compaction_series_runs(struct gb_series *series, const struct gb_runset *set,
                               gb_compaction_series_draw *draw, struct gb_error *err);

#endif
