#ifndef GB_TESTS_FIGURE_FOLDER_H
#define GB_TESTS_FIGURE_FOLDER_H

#include "figures/figures.h"

/* Small run directories in a temporary folder, and the figures drawn from them. */

/* Makes the folder; finish removes it with all that it holds. */
void figure_folder_init(void);
void figure_folder_finish(void);

/* Path of a file of a directory of the folder, NULL: of the directory; g_free. */
char *figure_folder_path(const char *directory, const char *file);
/* A file of a directory, which is made where it is missing. */
void figure_folder_write(const char *directory, const char *file, const char *text);

/* The figure of its own preset; words of a preset and keys where it has none. */
bool figure_folder_scene(const struct gb_figures_row *row, struct gb_series *series,
                         struct gb_error *err);
/* The figure of up to five directories of the folder, NULL at the end. */
bool figure_folder_run(const struct gb_figures_row *row, const char *const *words,
                       struct gb_series *series, struct gb_error *err);
bool figure_folder_named(const char *name, const char *const *words,
                         struct gb_series *series, struct gb_error *err);

/* A column of the series; the test ends where it has none. */
const double *figure_folder_column(const struct gb_series *series, const char *name);
/* The series has axes and curves and can be drawn. */
void figure_folder_assert_drawn(const struct gb_figures_row *row,
                                const struct gb_series *series);

#endif
