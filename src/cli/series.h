#ifndef GB_CLI_SERIES_H
#define GB_CLI_SERIES_H

#include <stdbool.h>
#include <stddef.h>

#include <glib.h>

#include "greenbody/status.h"
#include "run/runset.h"

/* The data of a figure: notes and columns of numbers, NaN where there is none. */
struct gb_series {
    GString *notes; /* lines without '#' */
    GPtrArray *names;
    GPtrArray *columns; /* double[rows] each */
    size_t rows;
};

void gb_series_init(struct gb_series *series, size_t rows);
void gb_series_finish(struct gb_series *series); /* zeroed is fine */

/* A line of notes; control characters become '?'. */
void gb_series_note(struct gb_series *series, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Adds a column of NaN and gives it to be filled. */
double *gb_series_column(struct gb_series *series, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* As CSV: notes as comments, a header row, the numbers.  g_string_free. */
GString *gb_series_csv(const struct gb_series *series);

/* The same branch of all runs of a set, read on one grid. */
struct gb_series_sample {
    double *grid;
    size_t size;
    double *rows; /* of each run, in the order of the set */
};

enum { GB_SERIES_PLACES = 4000 }; /* of a grid at most */

/* branch NULL: all branches.  Errors: those of gb_runset_points, and x that falls. */
bool gb_series_sample(struct gb_series_sample *sample, const struct gb_runset *set,
                      const char *branch, const char *x, const char *y,
                      struct gb_error *err);
void gb_series_sample_finish(struct gb_series_sample *sample); /* zeroed is fine */

/* Mean and standard error over the runs of a group, where all of them have a value; each
 * `size` values. */
bool gb_series_mean(const struct gb_series_sample *sample, const struct gb_runset *set,
                    size_t group, double *mean, double *error, struct gb_error *err);

#endif
