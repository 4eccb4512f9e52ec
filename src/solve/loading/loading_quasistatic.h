#ifndef GB_SOLVE_LOADING_LOADING_QUASISTATIC_H
#define GB_SOLVE_LOADING_LOADING_QUASISTATIC_H

#include <stdbool.h>
#include <stddef.h>

#include "base/record.h"
#include "scene/model.h"
#include "solve/loading/loading_cell.h"

/* The loading schedule of P1 section IV as a state machine: from pressure and density of
 * each relaxed state to the next order.  The caller owns the world and saves its states. */
enum gb_quasistatic_order {
    GB_QUASISTATIC_STRAIN, /* scale the cell by factor */
    GB_QUASISTATIC_UNLOAD, /* save the state, then scale: an unloading branch begins */
    GB_QUASISTATIC_RESTORE, /* the branch has ended: go back to the saved state and ask again */
    GB_QUASISTATIC_END
};

struct gb_quasistatic {
    struct gb_compressed_axes axes;
    double step;      /* strain step, share of the present edge */
    double step_most; /* the preset's; step is smaller for a while after a guard */
    double until_pressure, until_density;
    double unload_from[GB_UNLOAD_MAX];
    int unload_count, next_unload;
    int branch; /* 0 loading, k the k-th unloading branch; -1 before the first state */
    double top_pressure;   /* where the branch under way began */
    double last_pressure;  /* of the state before, for the last fraction of a step */
    double last_expansion; /* relative growth of the edges in the last unloading step */
    int expansions;        /* steps of the branch under way */
    bool endless;          /* the last branch was given up with pressure left */
    /* Unloading that began furthest above its pressure, by more than its tolerance: that
     * pressure, and the present one; 0: none */
    double exceeded, exceeded_by;
};

void gb_loading_quasistatic_init(struct gb_quasistatic *load,
                                 const struct gb_model *model);

/* What follows a relaxed state with this stress (normal pressures in x, y, z; E) and
 * density. factor is filled for STRAIN and UNLOAD. */
enum gb_quasistatic_order gb_loading_quasistatic_next(struct gb_quasistatic *load,
                                                      const double pressure[3],
                                                      double density, double factor[3]);

/* Halves the strain step and asks for the same step again (after a guard has tripped and
 * the state before was restored); doubles it again once per relaxed step, up to the
 * preset's. */
void gb_loading_quasistatic_halve(struct gb_quasistatic *load, double factor[3]);

void gb_loading_quasistatic_recover(struct gb_quasistatic *load);

/* Mean pressure over the compressed axes. */
double gb_loading_quasistatic_pressure(const struct gb_quasistatic *load,
                                       const double pressure[3]);

#endif
