#ifndef GB_FIGURES_FIGURES_LABEL_H
#define GB_FIGURES_FIGURES_LABEL_H

#include "figures/series.h"

/* Differences of a group to the others as Pango markup, "9.7 nm, µ = 0.4"; the title of
 * its first run for one group, or where the differences are long.  except: a key
 * "group.key" left out (NULL: none).  g_free. */
char *gb_figures_label(const struct gb_runset *set, size_t group, const char *except);

/* Label of an axis of a key "group.key" with the unit of its numbers ("": none): "d (nm)".
 * g_free. */
char *gb_figures_label_axis(const char *key, const char *unit);

/* Comment lines with the number, runs and differences of every group.  Returns the runs of
 * the largest group. */
size_t gb_figures_label_groups(struct gb_series *series, const struct gb_runset *set);

/* The same, with the meaning of bands and bars in the caption. */
void gb_figures_label_note(struct gb_series *series, const struct gb_runset *set);

/* Columns NAME_1UNIT and se_1UNIT, and a curve, of the mean of every group over the
 * grid. */
bool gb_figures_label_means(struct gb_series *series,
                            const struct gb_series_sample *sample,
                            const struct gb_runset *set, const double *grid,
                            const char *name, const char *unit, struct gb_error *err);

/* What a curve of means is made from: a branch and two columns of curve.csv. */
struct gb_figures_label_axes {
    const char *branch, *x, *y;
};

/* The points that are not in equilibrium, with hollow markers, columns and a sentence in
 * the caption; nothing where there is none.  The columns may move: after everything that
 * holds pointers to them. */
bool gb_figures_label_unrelaxed(struct gb_series *series, const struct gb_runset *set,
                                const struct gb_figures_label_axes *axes,
                                struct gb_error *err);

#endif
