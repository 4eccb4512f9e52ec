#ifndef GB_STUDY_BENCH_BENCH_H
#define GB_STUDY_BENCH_BENCH_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "study/bench/bench_state.h"

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
    struct gb_bench_state state; /* a checkpoint of the pressed packing */
};

/* Builds the packing of params, presses it in steps of 1 % until the coordination number
 * is reached, then times batches of force evaluations with the moves of the relaxer
 * between them, a strain step of 0.1 % before each batch as in a run, and checkpoints of
 * the pressed packing.  Errors as of the engine. */
bool gb_bench_run(struct gb_bench *bench, const struct gb_params *params,
                  double coordination, struct gb_error *err);

/* The cell with `count` particles among others, timed as by gb_bench_run. */
struct gb_bench_size {
    int64_t count;
    double coordination;
    double evaluation_s, evaluation_all_s; /* as above */
    double bytes_per_particle;
};

/* Called when the cell with `count` particles has been pressed (round 0), and when it has
 * been timed in a round. */
enum { GB_BENCH_ROUNDS = 5 };
typedef void gb_bench_progress(void *data, int64_t count, int round);

/* Cost against the size of the cell: the packing of params with other numbers of
 * particles.  They are timed alternately, round by round, so that other work on the
 * machine slows all of them alike; medians over the rounds.
 *
 * size   sizes of them, with their counts
 * tell   called with the progress; NULL is fine */
bool gb_bench_growth_run(struct gb_bench_size *size, size_t sizes,
                         const struct gb_params *params, double coordination,
                         gb_bench_progress *tell, void *data, struct gb_error *err);

/* b of cost ~ count^b, by least squares of the logarithms over n sizes (2 or more). */
double gb_bench_exponent(const double *count, const double *cost, size_t n);

/* What each term of the sweep costs: the same pressed packing timed with fewer of them.
 */
enum { GB_BENCH_TERMS = 6 };
struct gb_bench_term {
    const char *name;    /* "all terms", "without bridges", ... */
    double evaluation_s; /* median, one core; NaN where the scene has no such term */
};

/* Presses the packing of params to the coordination number and times it on one core as it
 * is, and without bridges, friction, attraction and all of them.  Errors as of the
 * engine.
 */
bool gb_bench_terms(struct gb_bench_term term[GB_BENCH_TERMS],
                    const struct gb_params *params, double coordination,
                    struct gb_error *err);

/* Particle-steps per second of P2's planar scene (1000 discs, set II with mu = 0.5) on
 * one core, between densities 0.89 and 0.91 at the paper's step of 0.04 T and the rate
 * v1. */
bool gb_bench_planar(double *particle_steps_per_s, struct gb_error *err);

#endif
