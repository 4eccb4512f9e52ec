#ifndef GB_SOLVE_LOADING_PATH_LEG_RUN_H
#define GB_SOLVE_LOADING_PATH_LEG_RUN_H

#include <stdbool.h>
#include <stdint.h>

#include "base/record.h"
#include "greenbody/status.h"
#include "pack/cell/world.h"
#include "scene/model.h"
#include "scene/path/path.h"

/* Stress of a packing against strain of its cell, as far as it is known: stress increments
 * k strain increments, components as in scene/path/path.h, in E. */
struct gb_strain_tangent {
    double k[GB_PATH_COMPONENTS][GB_PATH_COMPONENTS];
};

/* A loading path under way, as a state machine: from stress and density of each
 * relaxed state to the next strain increment, and from the stress after it to the
 * corrections of the components whose stress is held.  The caller owns the world.
 *
 * There is no gain.  The increment of a component with a held stress follows from the
 * tangent of the steps so far; what is left of the difference afterwards is corrected by
 * a second tangent, that of small strains.  Both begin with the measured affine tangent
 * and learn from every increment. */
struct gb_leg_run {
    int64_t identity;    /* of the path */
    int32_t leg;         /* under way, from 0; the number of legs when all are over */
    int32_t begun;       /* targets and tangents are those of this leg */
    int32_t steps;       /* recorded points of the leg */
    int32_t reversals;   /* of a cycle */
    int32_t released;    /* bits of components whose stress could not be held */
    int32_t corrections; /* in the step under way */
    int32_t shortened;   /* how often the step under way was */
    double shorter;      /* share of it up to the end of the leg */
    bool approaching;    /* held stresses are brought to their values first */
    bool last_approach;  /* with this step they are there */
    double nearest;      /* least distance of held stresses from their values, and ... */
    int32_t nearest_at;  /* ... the number of steps since then */
    double step, step_most;         /* strain of the leading component */
    double start[6];                /* stress at which the leg began */
    double target[6];               /* stress (E), or ratio */
    double strain[6];               /* since the leg began */
    double increment[6];            /* of the step under way, corrections included */
    double stress[6];               /* at the last accepted state */
    double corrected[6], before[6]; /* last correction, and the stress before it */
    double largest;                 /* largest stress of the leg */
    double sense[2];                /* of the ends: +1 where the value has to rise */
    double value[2];                /* of the ends at the last accepted state */
    double from[2];                 /* those at which the way to the ends began */
    double slope[2];      /* of that value against the leading strain; 0: unknown */
    double best, best_at; /* largest value of the first end, and where */
    int32_t exceeded;     /* legs that went past their ends, and the first of them: */
    int32_t exceeded_leg, exceeded_end;
    double exceeded_value;
    struct gb_strain_tangent affine, tangent, small;
};

/* Deformation gradient of the strains: diagonal exp(-e), engineering shears above it. */
struct gb_deformation gb_leg_run_deformation(const double strain[GB_PATH_COMPONENTS]);

/* Pressures xx, yy, zz and the shear stresses of a world right after an evaluation. */
void gb_leg_run_stress(const struct gb_world *world, double stress[GB_PATH_COMPONENTS]);

/* The tangent without relaxation, from small affine strains of the packing, which is
 * brought back to *good (saved here).  Shears only where the model allows them.  Stiffer
 * than the relaxed packing, and the start of what is learned.  Errors: GB_ERR_MEMORY,
 * GB_ERR_GUARD. */
bool gb_leg_run_measure(struct gb_strain_tangent *tangent, struct gb_world *world,
                        struct gb_world_copy **good, struct gb_error *err);

/* A linear condition on the stress of component `of`: its increment, less share times the
 * one of component `base` (share 0: none), is `change`. */
struct gb_stress_condition {
    int of, base;
    double share, change;
};

enum gb_leg_step_outcome {
    GB_LEG_STEP_HELD,    /* all held stresses are there */
    GB_LEG_STEP_CORRECT, /* a further strain is needed */
    GB_LEG_STEP_BEYOND,  /* the step went past the end of the leg: a shorter one */
    GB_LEG_STEP_MISSED   /* corrections do not lead there */
};

/* Stress after the relaxation of a step: what is left to correct, in correction. */
enum gb_leg_step_outcome gb_leg_run_check(struct gb_leg_run *run,
                                          const struct gb_model *model,
                                          const double stress[6], double correction[6]);

/* The step again, as long as it takes to the end that it went past. */
void gb_leg_run_shorten(struct gb_leg_run *run, const struct gb_model *model);

/* Half the step, from the last accepted state again. */
void gb_leg_run_halve(struct gb_leg_run *run, const struct gb_model *model);

/* "leg 2 (shear xz to 20 % at z = 50 MPa): no equilibrium with z = 50 MPa beyond a strain
 * of 4.1 %: collapse".  Returns buffer. */
char *gb_leg_run_held_missed(const struct gb_leg_run *run, const struct gb_model *model,
                             char *buffer, size_t size);

enum gb_leg_run_order {
    GB_LEG_RUN_STRAIN,   /* take `increment` */
    GB_LEG_RUN_NEXT_LEG, /* the leg is over; ask again */
    GB_LEG_RUN_END,      /* all legs are over */
    GB_LEG_RUN_COLLAPSE  /* no equilibrium with that stress; `text` says which */
};

void gb_leg_run_init(struct gb_leg_run *run, const struct gb_model *model);
/* The state out of a record or into it.  Errors: GB_ERR_INPUT naming the member. */
bool gb_leg_run_record(struct gb_leg_run *run, const struct gb_model *model,
                       struct gb_record *record, struct gb_error *err);

/* A leg begins at this state; affine: its measured tangent. */
void gb_leg_run_begin(struct gb_leg_run *run, const struct gb_model *model,
                      const struct gb_strain_tangent *affine, const double stress[6],
                      double density);
/* The step under way is accepted: learns from it. */
void gb_leg_run_accept(struct gb_leg_run *run, const struct gb_model *model,
                       const double stress[6], double density);
/* What follows an accepted state.  text (size bytes): of COLLAPSE, else "". */
enum gb_leg_run_order gb_leg_run_next(struct gb_leg_run *run,
                                      const struct gb_model *model, double density,
                                      char *text, size_t size);
/* The stresses of this leg are held no longer: strain goes on. */
void gb_leg_run_release(struct gb_leg_run *run);
/* The leg is given up where it is; the next one follows. */
void gb_leg_run_skip(struct gb_leg_run *run);
/* Number of the leg of a recorded point, from 1; 0 before the first one, and while held
 * stresses are brought to their values. */
int gb_leg_run_number(const struct gb_leg_run *run);
/* Legs that went past their ends by more than GB_PATH_BEYOND tolerances, as one line into
 * text; false: none. */
bool gb_leg_run_missed(const struct gb_leg_run *run, const struct gb_model *model,
                       char *text, size_t size);
/* Share of the path that is done, 0 to 1. */
double gb_leg_run_progress(const struct gb_leg_run *run, const struct gb_model *model);

#endif
