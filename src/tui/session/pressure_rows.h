#ifndef GB_TUI_SESSION_PRESSURE_ROWS_H
#define GB_TUI_SESSION_PRESSURE_ROWS_H

#include "tui/session/session.h"

/* Densities at a pressure for everything on the plot: run, quick cell, mean of the
 * replicas, previous curves, measured points. */

enum { GB_PRESSURE_ROWS = 4 + GB_SESSION_PREVIOUS };

enum gb_pressure_row_kind {
    GB_PRESSURE_ROW_RUN,
    GB_PRESSURE_ROW_QUICK,
    GB_PRESSURE_ROW_REPLICAS,
    GB_PRESSURE_ROW_PREVIOUS,
    GB_PRESSURE_ROW_MEASURED
};

struct gb_pressure_row {
    enum gb_pressure_row_kind kind;
    int previous;                   /* index of the previous curve */
    bool quick;                     /* of a quick cell, which has long strain steps */
    char name[64];                  /* as in the legend: "run", "a mu 0.2" */
    char brief[16];                 /* "run", "a" */
    const struct gb_params *params; /* NULL: measured */
};

struct gb_pressure_rows {
    struct gb_pressure_row row[GB_PRESSURE_ROWS];
    int count;
};

/* Lists the rows, the run first. hide_previous: without previous curves that are not
 * pinned.  Hidden curves are not listed. */
void gb_pressure_rows_list(struct gb_pressure_rows *rows,
                           const struct gb_session *session, bool hide_previous);

/* Row of the run on display; row of a previous curve. */
struct gb_pressure_row gb_pressure_rows_run(const struct gb_session *session);
struct gb_pressure_row gb_pressure_rows_previous(const struct gb_session *session,
                                                 int index);

/* The pressure for a single density per curve: the typed pressure, else 100 MPa, or a
 * lower round value if the run (without a run: every curve) has not reached that. */
double gb_pressure_rows_usual(const struct gb_session *session, double typed_pa);

/* A density and its standard error: of the mean of replicas, as given with a
 * measurement, or gb_average_cell_scatter for one cell.  NaN: not reached, or unknown. */
struct gb_pressure_value {
    double density, error;
};

/* Where loading first reaches the pressure, between two points.  Measured points and
 * means are interpolated in the logarithm of the pressure. */
struct gb_pressure_value gb_pressure_rows_at(const struct gb_session *session,
                                             const struct gb_pressure_row *row,
                                             double pressure_pa);

enum gb_pressure_verdict {
    GB_PRESSURE_VERDICT_NONE,   /* unknown error, or a bias (quick against full) */
    GB_PRESSURE_VERDICT_WITHIN, /* within two standard deviations of the difference */
    GB_PRESSURE_VERDICT_BEYOND
};

/* Do two values at a pressure differ by more than their errors? */
enum gb_pressure_verdict gb_pressure_rows_verdict(const struct gb_pressure_row *row,
                                                  struct gb_pressure_value value,
                                                  const struct gb_pressure_row *base,
                                                  struct gb_pressure_value base_value);

/* The smallest difference with the verdict BEYOND; NaN: none. */
double gb_pressure_rows_limit(const struct gb_pressure_row *row,
                              struct gb_pressure_value value,
                              const struct gb_pressure_row *base,
                              struct gb_pressure_value base_value);

/* RMS misfit of densities to the measured points that the row has reached.  NaN: none,
 * and for the measurement itself. */
double gb_pressure_rows_misfit(const struct gb_session *session,
                               const struct gb_pressure_row *row);

/* Writes "0.4062", or "-" if it was not reached. */
char *gb_pressure_rows_write(struct gb_pressure_value value, char *text, size_t size);
/* Writes "+0.0103!": the difference with its verdict, ~ within, ! beyond, blank for
 * none; "" if a value is missing. */
enum gb_pressure_verdict gb_pressure_rows_write_difference(
    const struct gb_pressure_row *row, struct gb_pressure_value value,
    const struct gb_pressure_row *base, struct gb_pressure_value base_value, char *text,
    size_t size);

#endif
