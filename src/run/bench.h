#ifndef GB_RUN_BENCH_H
#define GB_RUN_BENCH_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"

/* Speed of one scene, measured on this machine. */
struct gb_bench {
    double grow_s;       /* initial structure */
    double coordination; /* where the sweep was timed */
    double density;
    double evaluation_s;     /* median: forces, torques, history and move, one core */
    double evaluation_all_s; /* the same on all cores */
    int cores;
    bool same_bits; /* the same state after the timed evaluations on 1 and all cores */
    double bytes_per_particle;
};

/* Builds the packing of params, presses it in steps of 1 % until the coordination number
 * is reached, then times batches of force evaluations with the moves of the relaxer
 * between them, a strain step of 0.1 % before each batch as in a run.  Errors as of the
 * engine. */
bool gb_bench_run(struct gb_bench *bench, const struct gb_params *params,
                  double coordination, struct gb_error *err);

/* Particle-steps per second of P2's planar scene (1000 discs, set II with mu = 0.5) on
 * one core, between densities 0.89 and 0.91 at the paper's step of 0.04 T and the rate
 * v1. */
bool gb_bench_planar(double *particle_steps_per_s, struct gb_error *err);

#endif
