#ifndef GB_FIGURES_SERIES_H
#define GB_FIGURES_SERIES_H

#include <stdbool.h>
#include <stddef.h>

#include <glib.h>

#include "draw/figure/figure.h"
#include "greenbody/status.h"
#include "many/runset.h"

/* A curve of a figure: columns of its series by number, -1: none. */
struct gb_series_curve {
    int x, y, error, x_error;
    size_t from, rows; /* which rows */
    enum gb_figure_kind kind;
    int style;
    bool open;
    char *label; /* Pango markup; NULL: not named */
};

/* An axis: the column that a table of --data must have for it, and its words. */
struct gb_series_axis {
    const char *name, *label; /* NULL label: nothing to draw */
    bool log;
    double low, high; /* NaN: from the data */
};

/* The data of a figure: notes and columns of numbers, NaN where there is none; and which
 * of them are drawn how. */
struct gb_series {
    GString *notes; /* lines without '#' */
    GPtrArray *names;
    GPtrArray *columns; /* double[rows] each */
    size_t rows;
    struct gb_series_axis x, y;
    GArray *curves;   /* struct gb_series_curve */
    GArray *marks;    /* struct gb_figure_note */
    GString *caption; /* Pango markup */
    double inset[2];  /* part of the x axis drawn larger; NaN: none */
};

void gb_series_init(struct gb_series *series, size_t rows);
void gb_series_finish(struct gb_series *series); /* zeroed is fine */

/* A line of notes; control characters become '?'. */
void gb_series_note(struct gb_series *series, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Adds a column of NaN and gives it to be filled. */
double *gb_series_column(struct gb_series *series, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* What the axes are: names of columns, and words with units; texts that live on. */
void gb_series_axes(struct gb_series *series, const char *x_name, const char *x_label,
                    const char *y_name, const char *y_label);
/* Draws columns that are there already; error may be NULL.  Returns the curve, valid
 * until the next call; label (NULL: none) is copied. */
struct gb_series_curve *gb_series_draw(struct gb_series *series, const double *x,
                                       const double *y, const double *error,
                                       enum gb_figure_kind kind, int style,
                                       const char *label);
/* Adds a sentence to the caption. */
void gb_series_say(struct gb_series *series, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Makes it at least so many rows, the new ones of NaN; columns given out before move. */
void gb_series_grow(struct gb_series *series, size_t rows);

/* The drawing, whose arrays belong to the series; *curves for g_free. */
void gb_series_figure(const struct gb_series *series, struct gb_figure *figure,
                      struct gb_figure_curve **curves);

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

/* The grid as the first column, under a name. */
double *gb_series_sample_grid(struct gb_series *series,
                              const struct gb_series_sample *sample, const char *name);

#endif
