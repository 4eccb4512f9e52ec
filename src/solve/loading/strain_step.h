#ifndef GB_SOLVE_LOADING_STRAIN_STEP_H
#define GB_SOLVE_LOADING_STRAIN_STEP_H

#include <stdbool.h>
#include <stdint.h>

#include "base/deformation.h"
#include "greenbody/status.h"
#include "pack/cell/nonaffine.h"
#include "pack/cell/world.h"
#include "solve/event_queue.h"
#include "solve/relax/relax.h"

/* What is done when a strain step fails, in one place. */
enum gb_guard_action {
    GB_GUARD_ACCEPT, /* record the state */
    GB_GUARD_RETRY,  /* go back to the last good state and take half the strain step */
    GB_GUARD_STOP    /* go back to the last good state and stop; err says why */
};

struct gb_guard {
    int halvings; /* of the strain step, in a row */
    int jumps;    /* of these because of particles that went too far */
};

/* Judges the outcome of a strain step.  text (size bytes) receives one line for
 * events.log when something happened, else "".  Errors: err keeps its text on RETRY (what
 * happened) and is completed on STOP. */
enum gb_guard_action gb_strain_step_judge(struct gb_guard *guard,
                                          enum gb_relax_outcome outcome,
                                          const struct gb_relax *relax, char *text,
                                          size_t size, struct gb_error *err);

/* Judges the nonaffine displacements of a relaxed strain step: beyond GB_NONAFFINE_MAX a
 * particle may have passed contacts by.  RETRY while half the step may help; ACCEPT with a
 * line in text when it does not: an instability of the packing, across a gap or by the
 * failure of a bridge. */
enum gb_guard_action gb_strain_step_nonaffine(struct gb_guard *guard,
                                              const struct gb_nonaffine *nonaffine,
                                              char *text, size_t size);

/* A strain step of a periodic cell: the deformation in equal parts, each relaxed to
 * equilibrium; guards; the way back to the state before it. */
struct gb_strain_step {
    const struct gb_model *model;
    struct gb_world *world;
    struct gb_relax *relax;
    struct gb_world_copy *good; /* before the strain step under way */
    bool have_good;
    struct gb_guard guard;
    struct gb_deformation deformation; /* of a part */
    int part, parts; /* from 1; 0: the first relaxation, without a strain step */
    bool unrelaxed;  /* the last relaxation ended above its tolerance, and was accepted */
    int64_t spent_iterations, spent_evaluations; /* by attempts that were taken back and
                                                  * by parts before this one */
};

enum gb_strain_step_outcome {
    GB_STRAIN_STEP_MORE,    /* the slice is used up, or the next part begins */
    GB_STRAIN_STEP_RELAXED, /* equilibrium after the last part */
    GB_STRAIN_STEP_RETRY,   /* a guard tripped; the packing is back at the good state */
    GB_STRAIN_STEP_STOPPED  /* the same, and nothing helps; err */
};

/* The relaxer; the world follows when it exists.  Errors: GB_ERR_INPUT for an unknown
 * relaxer, GB_ERR_MEMORY. */
bool gb_strain_step_init(struct gb_strain_step *step, const struct gb_model *model,
                         struct gb_error *err);
void gb_strain_step_finish(struct gb_strain_step *step);
/* The relaxation of the packing as it was placed. */
void gb_strain_step_begin_first(struct gb_strain_step *step, struct gb_world *world);
/* Deforms the packing by the first of `parts` equal parts. */
void gb_strain_step_begin(struct gb_strain_step *step,
                          const struct gb_deformation *deformation, int parts);
/* A further small deformation of the same step, relaxed without a new prediction. */
void gb_strain_step_correct(struct gb_strain_step *step,
                            const struct gb_deformation *deformation);
enum gb_strain_step_outcome gb_strain_step_advance(struct gb_strain_step *step,
                                                   int64_t max_evaluations,
                                                   struct gb_event_queue *events,
                                                   struct gb_error *err);
/* After RELAXED: RELAXED, or RETRY where a particle moved too far. */
enum gb_strain_step_outcome gb_strain_step_check_jumps(struct gb_strain_step *step,
                                                       struct gb_event_queue *events,
                                                       struct gb_error *err);
/* Back to the good state, with an event. */
enum gb_strain_step_outcome gb_strain_step_take_back(struct gb_strain_step *step,
                                                     const char *text,
                                                     struct gb_event_queue *events,
                                                     struct gb_error *err);
/* The packing as it is becomes the good state. */
bool gb_strain_step_save(struct gb_strain_step *step, struct gb_error *err);
/* Work counters of the next recorded point begin at 0. */
void gb_strain_step_clear_spent(struct gb_strain_step *step);
/* Iterations and evaluations since the last recorded point. */
int64_t gb_strain_step_iterations(const struct gb_strain_step *step);
int64_t gb_strain_step_evaluations(const struct gb_strain_step *step);

#endif
