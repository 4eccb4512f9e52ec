#ifndef GB_FIGURES_FIGURES_LABEL_H
#define GB_FIGURES_FIGURES_LABEL_H

#include "figures/series.h"

/* What tells a group from the others, short, as Pango markup: "9.7 nm, µ = 0.4"; the
 * title of its first run where there is one group, or nothing shorter.  except: a key
 * "group.key" left out (NULL: none).  g_free. */
char *gb_figures_label(const struct gb_runset *set, size_t group, const char *except);

/* The axis of a key "group.key" as the labels write it, with the unit of its numbers ("":
 * none): "d (nm)".  g_free. */
char *gb_figures_label_axis(const char *key, const char *unit);

/* Notes which number is which group and run; runs of the largest group. */
size_t gb_figures_label_groups(struct gb_series *series, const struct gb_runset *set);

/* The same, and says in the caption what bands are. */
void gb_figures_label_note(struct gb_series *series, const struct gb_runset *set);

/* Columns and curves of the mean pressure (MPa) of every group over the grid. */
bool gb_figures_label_means(struct gb_series *series,
                            const struct gb_series_sample *sample,
                            const struct gb_runset *set, const double *grid,
                            struct gb_error *err);

#endif
