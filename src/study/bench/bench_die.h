#ifndef GB_STUDY_BENCH_BENCH_DIE_H
#define GB_STUDY_BENCH_BENCH_DIE_H

#include <stdbool.h>

#include "greenbody/status.h"
#include "study/bench/bench_figure.h"

/* Speed of a bed of 1751 spheres pressed to 50 MPa as in P3, on one core and on all of them:
 * one time step (forces, histories, motion) per particle, s. */
struct gb_bench_die {
    struct gb_bench_figure hertz, hertz_all, hertz_friction, storakers,
        storakers_friction;
    double coordination, near; /* contacts and listed pairs per particle */
};

/* Fills a die in a few seconds, compresses the bed and times it with every law, in turn.  Errors:
 * as of the stages. */
bool gb_bench_die_run(struct gb_bench_die *bench, struct gb_error *err);

#endif
