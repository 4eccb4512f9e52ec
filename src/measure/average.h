#ifndef GB_MEASURE_AVERAGE_H
#define GB_MEASURE_AVERAGE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* A curve as plain arrays; not owned. */
struct gb_average_curve {
    const double *x, *y;
    size_t count;
};

/* Values of y on a grid by linear interpolation; NaN outside the curve and beside a
 * missing y.  x must not fall; where it repeats, the first of the equal points counts.
 * Errors: GB_ERR_INPUT (x not finite or falling). */
bool gb_average_resample(const struct gb_average_curve *curve, const double *grid,
                         size_t size, double *y, struct gb_error *err);

/* All x of the curves in ascending order, those closer than 1e-9 of the span taken as
 * one, thinned evenly to at most `most` (>= 2, ends kept).  *grid: gb_alloc_free.
 * Errors: GB_ERR_INPUT (x not finite or falling, no point at all), GB_ERR_MEMORY. */
bool gb_average_grid(const struct gb_average_curve *curves, size_t count, size_t most,
                     double **grid, size_t *size, struct gb_error *err);

/* Mean and standard error over `count` values, those that are NaN left out.  The error is
 * NaN with fewer than two.  Returns how many there were. */
size_t gb_average_values(const double *values, size_t count, double *mean, double *error);

/* Standard error by the jackknife: without[i] is a figure found from all runs but run i;
 * those that are NaN are left out.  NaN with fewer than two. */
double gb_average_jackknife(const double *without, size_t count);

/* Points of a grid at which some curves have no value (NaN). */
enum gb_average_gaps {
    GB_AVERAGE_PRESENT, /* mean of the curves that have one */
    GB_AVERAGE_ALL      /* no mean unless all curves have one */
};

/* Mean and standard error at every point of a grid: row r of `rows` (count x size) is one
 * curve.  NULL for error is fine. */
void gb_average_rows(const double *rows, size_t count, size_t size,
                     enum gb_average_gaps gaps, double *mean, double *error);

/* y where x first reaches level, going along the curve, by linear interpolation; NaN when
 * it never does.  x may rise and fall.  *at: index of the point at or behind the
 * crossing, NULL is fine. */
double gb_average_crossing(const struct gb_average_curve *curve, double level,
                           size_t *at);

/* Standard deviation of the relative density of one cell at a pressure, from structure to
 * structure: 0.0064 (1000/N)^0.4, through what was measured on the powder of P1 set II:
 * 0.011 for 250 particles, 0.006 for 1000, 0.003 for 8000 at 10 to 100 MPa
 * (docs/accuracy.md).  NaN where it was not measured: 2D, runs with time, dies, lattices
 * and packings of a file. */
double gb_average_cell_scatter(const struct gb_params *params);

#endif
