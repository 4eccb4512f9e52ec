#ifndef GB_STUDY_BENCH_BENCH_CELLS_H
#define GB_STUDY_BENCH_BENCH_CELLS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "study/bench/bench_figure.h"
#include "study/bench/bench_state.h"

/* One of several periodic cells that are timed in turn. */
struct gb_bench_cell {
    struct gb_params params;
    bool busy;                    /* also time it while another thread computes */
    struct gb_bench_state *state; /* where checkpoints of it are timed; NULL: nowhere */
    double grow_s;                /* initial structure */
    double coordination, density; /* where it was timed */
    double bytes_per_particle;    /* of world and relaxer */
    bool same_bits;               /* after the timed evaluations on one and all cores */
    /* one evaluation (forces, torques, history) with the move of the relaxer, s: on one
     * core, on all, and on all while another thread keeps one of them busy (NaN) */
    struct gb_bench_figure one, all, all_busy;
};

/* Called when a cell has been pressed (round 0), and when it has been timed in a round. */
typedef void gb_bench_progress(void *data, const struct gb_bench_cell *cell, int round);

/* Presses the packings of the cells in steps of 1 % until the coordination number is
 * reached, then times batches of evaluations, a strain step of 0.1 % before each as in a
 * run.
 *
 * cell   the first three members are given, the others are set
 * tell   called with the progress; NULL is fine
 *
 * Errors: as of the engine; GB_ERR_GUARD where the coordination number is not reached. */
bool gb_bench_cells_run(struct gb_bench_cell *cell, size_t cells, double coordination,
                        gb_bench_progress *tell, void *data, struct gb_error *err);

#endif
