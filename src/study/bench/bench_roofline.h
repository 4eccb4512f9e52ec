#ifndef GB_STUDY_BENCH_BENCH_ROOFLINE_H
#define GB_STUDY_BENCH_BENCH_ROOFLINE_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "study/bench/bench_figure.h"

/* What an evaluation with its move does and what the machine could do at most, one core.
 * Flops are additions, multiplications, divisions, roots, minima and maxima, each one; no
 * comparisons, no operations on whole numbers.  Bytes are those of every array that is
 * read or written, once each: what would have to come from memory if nothing stayed in the
 * caches between two evaluations. */
struct gb_bench_roofline {
    double near, far;                  /* pairs of the lists per particle */
    double flops, bytes;               /* per particle and evaluation, counted */
    struct gb_bench_figure evaluation; /* s per particle */
    struct gb_bench_figure peak;       /* flop/s of additions and multiplications */
    /* bytes/s of a copy: of as many bytes as the evaluation touches, and of 256 MiB */
    struct gb_bench_figure bandwidth, memory;
};

/* Presses the packing of params as gb_bench_cells_run does and times evaluation, peak and
 * bandwidth in turn.  Errors: GB_ERR_INPUT unless the scene is in single precision with
 * the rod law; as of the engine. */
bool gb_bench_roofline_run(struct gb_bench_roofline *roofline,
                           const struct gb_params *params, double coordination,
                           struct gb_error *err);

/* The least time that peak and bandwidth allow, s per particle: the larger of both. */
double gb_bench_roofline_least_s(const struct gb_bench_roofline *roofline);

#endif
