#ifndef GB_STUDY_BENCH_BENCH_STATE_H
#define GB_STUDY_BENCH_BENCH_STATE_H

#include "greenbody/params.h"
#include "greenbody/status.h"
#include "pack/cell/world.h"

/* What a checkpoint costs, medians, s. */
struct gb_bench_state {
    double held;      /* the engine: wall clock of copying its state */
    double processor; /* the writing thread: processor time */
    double written;   /* ... and wall clock until the file stands */
    double disk;      /* of that, the same bytes written, synced and renamed alone */
    double bytes_per_particle;
};

/* Takes checkpoints of the packing in copy, whose scene is params, and writes each in a
 * temporary folder (TMPDIR) as a run does.  Errors: GB_ERR_INPUT for dies, GB_ERR_MEMORY,
 * GB_ERR_MACHINE. */
bool gb_bench_state_run(struct gb_bench_state *bench, const struct gb_params *params,
                        const struct gb_world_copy *copy, struct gb_error *err);

#endif
