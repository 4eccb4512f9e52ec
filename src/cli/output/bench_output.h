#ifndef GB_CLI_BENCH_OUTPUT_H
#define GB_CLI_BENCH_OUTPUT_H

#include <stddef.h>

#include <glib.h>

#include "study/bench/bench.h"
#include "study/bench/bench_compare.h"
#include "study/bench/bench_die.h"
#include "study/bench/bench_roofline.h"

/* The tables of `bench`. */

/* The figures of the main table. */
struct gb_bench_output_figures {
    struct gb_bench_cell cell[GB_BENCH_CELLS];
    struct gb_bench_state state;
    struct gb_bench_figure planar, planar_all; /* NaN: one core */
    struct gb_bench_die die;
};

enum { GB_BENCH_OUTPUT_ROWS = 40 };

struct gb_bench_output_rows {
    struct gb_bench_row row[GB_BENCH_OUTPUT_ROWS];
    size_t count;
};

void gb_bench_output_figures(const struct gb_bench_output_figures *figures,
                             struct gb_bench_output_rows *rows);
void gb_bench_output_roofline(const struct gb_bench_roofline *roofline, double particles,
                              struct gb_bench_output_rows *rows);

/* CSV begins with a comment that names program and level of vectors. */
void gb_bench_output_csv(GString *text, const struct gb_bench_output_rows *rows);
void gb_bench_output_table(GString *text, const struct gb_bench_output_rows *rows);
/* Beside a stored run. */
void gb_bench_output_changes(GString *text, const struct gb_bench_output_rows *rows,
                             const struct gb_bench_change *change);

#endif
