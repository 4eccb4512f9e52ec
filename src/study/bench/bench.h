#ifndef GB_STUDY_BENCH_BENCH_H
#define GB_STUDY_BENCH_BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "study/bench/bench_cells.h"
#include "study/bench/bench_figure.h"

/* The periodic cells of the table: the scene as it is, of 1000 particles, in double
 * precision, and of many sizes. */
enum gb_bench_which {
    GB_BENCH_SCENE,
    GB_BENCH_SMALL,
    GB_BENCH_DOUBLE,
    GB_BENCH_SIZES,
    GB_BENCH_CELLS
};

enum { GB_BENCH_SMALL_COUNT = 1000 };

/* Fills the parameters of these cells from those of a scene.  Of many sizes: the
 * log-normal law of `p1-set2-lognormal` about the scene's diameter; the scene itself where
 * it has many sizes or a law of one size. */
bool gb_bench_plan(struct gb_bench_cell cell[GB_BENCH_CELLS],
                   const struct gb_params *params, struct gb_error *err);

/* b of cost ~ count^b, by least squares of the logarithms over n sizes (2 or more). */
double gb_bench_exponent(const double *count, const double *cost, size_t n);

/* What each term of the sweep costs: the same pressed packing timed with fewer of them, in
 * turn. */
enum { GB_BENCH_TERMS = 6 };
struct gb_bench_term {
    const char *name;                  /* "all terms", "without bridges", ... */
    struct gb_bench_figure evaluation; /* s, one core; NaN: the scene has no such term */
};

/* Presses the packing of params to the coordination number and times it on one core as it
 * is, and without bridges, friction, attraction and all of them.  Errors as of the
 * engine.
 */
bool gb_bench_terms(struct gb_bench_term term[GB_BENCH_TERMS],
                    const struct gb_params *params, double coordination,
                    struct gb_error *err);

/* Particle-steps per second of P2's planar scene (1000 discs, set II with mu = 0.5)
 * between densities 0.89 and 0.91 at the paper's step of 0.04 T and the rate v1. */
bool gb_bench_planar(int threads, struct gb_bench_figure *particle_steps_per_s,
                     struct gb_error *err);

#endif
