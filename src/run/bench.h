#ifndef GB_RUN_BENCH_H
#define GB_RUN_BENCH_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* Speed of one scene, measured on this machine. */
struct gb_bench {
    double grow_s;           /* initial structure */
    double coordination;     /* where the sweep was timed */
    double density;
    double evaluation_s;     /* median: forces, torques, history and move, one core */
    double evaluation_all_s; /* the same on all cores */
    int cores;
    bool same_bits;          /* the same state after the timed evaluations on 1 and all cores */
    double bytes_per_particle;
};

/* Builds the packing of params, presses it in steps of 1 % until the coordination number is
 * reached, then times batches of force evaluations with the moves of the relaxer between
 * them, a strain step of 0.1 % before each batch as in a run.  Errors as of the engine. */
bool gb_bench_run(struct gb_bench *bench, const struct gb_params *params,
                  double coordination, struct gb_error *err);

#endif
