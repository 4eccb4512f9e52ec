#ifndef GB_STUDY_BENCH_BENCH_PACKING_H
#define GB_STUDY_BENCH_BENCH_PACKING_H

#include <stddef.h>

#include "pack/cell/world.h"
#include "scene/model.h"
#include "solve/relax/relax.h"

/* A packing that was pressed, and what it is timed with. */
struct gb_bench_packing {
    struct gb_model model;
    struct gb_world *world;
    struct gb_world_copy *copy;
    double grow_s, coordination;
    size_t bytes; /* held by world and relaxer */
};

/* Grows the packing of params and presses it until the coordination number is reached.
 * gb_bench_packing_finish is due, also after an error.  Errors: as of the engine, and
 * GB_ERR_GUARD where the coordination number is not reached. */
bool gb_bench_packing_press(struct gb_bench_packing *pressed,
                            const struct gb_params *params, double coordination,
                            struct gb_error *err);
void gb_bench_packing_finish(struct gb_bench_packing *pressed);

/* Largest number of batches timed at once. */
enum { GB_BENCH_PACKING_BATCHES = 15 };

/* Median time, s, of one evaluation with its move over batches (1 to
 * GB_BENCH_PACKING_BATCHES) of 24, with a strain step of 0.1 % before each: processor time
 * on one thread, else wall time. */
bool gb_bench_packing_time(struct gb_world *world, struct gb_relax *relax, int batches,
                           double *median, struct gb_error *err);

#endif
