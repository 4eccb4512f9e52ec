#ifndef GB_STUDY_YIELD_YIELD_FILES_H
#define GB_STUDY_YIELD_YIELD_FILES_H

#include <glib.h>
#include <stdbool.h>

#include "study/yield/yield_study.h"

/* The tables and the page of a study; stresses in MPa, angles in degrees. */

/* yield.csv: a row per compact, offset and direction, means over the cells with standard
 * errors. */
GString *gb_yield_files_points(const struct gb_yield_study *study, const char *comment);
/* yield_cells.csv: the points of every cell at the chosen offset. */
GString *gb_yield_files_cells(const struct gb_yield_study *study, const char *comment);
/* yield_fit.csv: a row per compact, offset and quantity, with its 95 % interval. */
GString *gb_yield_files_fit(const struct gb_yield_study *study, const char *comment);
/* The page: what was done, the fitted surfaces, and the three statements on each compact:
 * shift of the ellipse, dilatancy under shear, flow against normal. */
GString *gb_yield_files_page(const struct gb_yield_study *study, const char *title,
                             const char *command);

/* Writes all of them into a folder; preset.ini is the caller's. */
bool gb_yield_files_write(const struct gb_yield_study *study, const char *directory,
                          const char *title, const char *command, struct gb_error *err);

#endif
