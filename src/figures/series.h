#ifndef GB_FIGURES_SERIES_H
#define GB_FIGURES_SERIES_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "draw/figure.h"
#include "greenbody/status.h"
#include "many/compaction_data.h"
#include "many/runset.h"
#include "measure/compaction_fits.h"

/* A curve of a figure: indices of columns of its series, -1: none. */
struct gb_series_curve {
    int x, y, error, x_error;
    size_t from, rows; /* first row, number of rows */
    enum gb_figure_kind kind;
    int style;
    bool open;   /* hollow markers */
    bool below;  /* in the panel below */
    char *label; /* Pango markup; NULL: none */
};

/* An axis: the column that a table of --data must have for it, and its label. */
struct gb_series_axis {
    const char *name, *label;
    bool log;
    double low, high; /* NaN: from the data */
    bool several;     /* a figure needs two values on it at least */
};

/* The data of a figure: comment lines and columns of numbers (NaN: no value), and the
 * curves that show them. */
struct gb_series {
    GString *notes; /* lines without '#' */
    GPtrArray *names;
    GPtrArray *columns; /* double[rows] each */
    size_t rows;
    struct gb_series_axis x, y;
    struct gb_series_axis below_y; /* of the panel below; label NULL: there is none */
    struct gb_figure_second_axis top, right; /* labels are not copied */
    GArray *curves;                          /* struct gb_series_curve */
    GArray *annotations;                     /* struct gb_figure_annotation */
    GString *caption;                        /* Pango markup */
    double inset[2];                         /* x range of the inset; NaN: none */
    bool equal_scales;                       /* of both axes */
    struct gb_figure_map *map; /* NULL: none; its arrays belong to the series */
};

void gb_series_init(struct gb_series *series, size_t rows);
void gb_series_finish(struct gb_series *series); /* zeroed is fine */

/* Adds a comment line of the CSV; control characters become '?'. */
void gb_series_note(struct gb_series *series, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Adds a column of NaN and returns it. */
double *gb_series_column(struct gb_series *series, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Sets names of columns and labels with units; the strings are not copied. */
void gb_series_axes(struct gb_series *series, const char *x_name, const char *x_label,
                    const char *y_name, const char *y_label);
/* Adds a curve of existing columns; error may be NULL.  Returns the curve, valid until the
 * next call; label (NULL: none) is copied. */
struct gb_series_curve *gb_series_draw(struct gb_series *series, const double *x,
                                       const double *y, const double *error,
                                       enum gb_figure_kind kind, int style,
                                       const char *label);
/* Gives the figure a map; edges and values are copied, the label is not. */
void gb_series_map(struct gb_series *series, const struct gb_figure_map *map);

/* Adds a sentence to the caption. */
void gb_series_caption(struct gb_series *series, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* At least `rows` rows, the new ones NaN; pointers to columns become invalid. */
void gb_series_grow(struct gb_series *series, size_t rows);

/* The figure, whose arrays belong to the series; *curves for g_free, those of the panel
 * below last. */
void gb_series_figure(const struct gb_series *series, struct gb_figure *figure,
                      struct gb_figure_curve **curves);

/* Whether there is something to draw, with as many abscissas as the axis needs.  Errors:
 * GB_ERR_INPUT. */
bool gb_series_check_drawable(const struct gb_series *series, const char *figure,
                              struct gb_error *err);

/* CSV: comments, a header row, the numbers.  g_string_free. */
GString *gb_series_csv(const struct gb_series *series);

/* One branch of all runs of a set, interpolated on one grid. */
struct gb_series_sample {
    double *grid;
    size_t size;
    double *rows; /* of each run, in the order of the set */
};

enum { GB_SERIES_GRID_MAX = 4000 }; /* points of a grid */

/* branch NULL: all branches.  Errors: those of gb_runset_points, and a decreasing x. */
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

/* All runs are dynamic.  Errors: GB_ERR_INPUT with the first other run. */
bool gb_series_check_dynamic(const struct gb_runset *set, const char *figure,
                             struct gb_error *err);

/* All runs are dies. */
bool gb_series_check_die(const struct gb_runset *set, const char *figure,
                         struct gb_error *err);

/* Mean relative density of a group where loading first reaches a pressure, with its
 * standard error (NaN for one run), over the runs that reach it.  Returns their number.
 * Errors: 0 and GB_ERR_INPUT when no run reaches it. */
size_t gb_series_density_at_pressure(const struct gb_runset *set, size_t group,
                                     double pressure_mpa, double *mean, double *error,
                                     struct gb_error *err);

/* Differences of a group to the others as Pango markup, "9.7 nm, µ = 0.4"; the title of
 * its first run for one group, or where the differences are long.  except: a key
 * "group.key" left out (NULL: none).  g_free. */
char *gb_series_group_label(const struct gb_runset *set, size_t group,
                            const char *except);

/* Label of an axis of a key "group.key" with the unit of its numbers ("": none): "d (nm)".
 * g_free. */
char *gb_series_key_label(const char *key, const char *unit);

/* Comment lines with the number, runs and differences of every group.  Returns the runs of
 * the largest group. */
size_t gb_series_list_groups(struct gb_series *series, const struct gb_runset *set);

/* The same, with the meaning of bands and bars in the caption. */
void gb_series_note_groups(struct gb_series *series, const struct gb_runset *set);

/* Columns NAME_1UNIT and se_1UNIT, and a curve, of the mean of every group over the
 * grid. */
bool gb_series_means(struct gb_series *series, const struct gb_series_sample *sample,
                     const struct gb_runset *set, const double *grid, const char *name,
                     const char *unit, struct gb_error *err);

/* What a curve of means is made from: a branch and two columns of curve.csv. */
struct gb_series_points {
    const char *branch, *x, *y;
};

/* The points that are not in equilibrium, with hollow markers, columns and a sentence in
 * the caption; nothing where there is none.  The columns may move: after everything that
 * holds pointers to them. */
bool gb_series_unrelaxed(struct gb_series *series, const struct gb_runset *set,
                         const struct gb_series_points *axes, struct gb_error *err);

/* Points of one powder with fitted equations of compaction as curves of a figure. */
struct gb_series_powder {
    struct gb_compaction_data data;
    struct gb_compaction_fits fits;
    char *label; /* of the points, Pango markup */
};

/* Fits all equations (only NULL), or one, to data that it takes over; label is copied.
 * gb_series_powder_finish must be called in any case.  Errors: GB_ERR_INPUT when none is
 * defined, GB_ERR_MEMORY. */
bool gb_series_powder_init(struct gb_series_powder *one,
                           const struct gb_compaction_data *data,
                           const struct gb_equation *only, const char *label,
                           struct gb_error *err);

void gb_series_powder_finish(struct gb_series_powder *one); /* zeroed is fine */

/* Draws powders into a series that it initialises. */
typedef bool gb_series_powder_draw(struct gb_series *series,
                                   const struct gb_series_powder *all, size_t count,
                                   struct gb_error *err);

/* Density against pressure with the curves of the best equations, residuals below: up to
 * six of one powder, the best one of each of several. */
gb_series_powder_draw gb_series_powder_fit;

/* ln(1/(1 - rho)) against pressure with the line of the straightest stretch of each.
 * Errors: GB_ERR_INPUT where Heckel's equation is refused. */
gb_series_powder_draw gb_series_powder_heckel;

/* The groups of a set as powders, drawn by one of the functions above. */
bool gb_series_powder_runs(struct gb_series *series, const struct gb_runset *set,
                           gb_series_powder_draw *draw, struct gb_error *err);

#endif
