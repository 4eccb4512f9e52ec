#ifndef GB_API_ARRAY_PRIVATE_H
#define GB_API_ARRAY_PRIVATE_H

#include "greenbody/array.h"
#include "greenbody/status.h"
#include "io/state_forces.h"
#include "run/experiment.h"

/* Arrays that are stored as arcs and must be converted to angles. */
enum gb_array_angular { GB_ARRAY_TORQUE, GB_ARRAY_SPIN, GB_ARRAY_ANGULAR };

/* A packing of a run or from a file, with the arrays computed from it. */
struct gb_array_source {
    struct gb_experiment *experiment; /* the run; NULL: read from a file */
    struct gb_state
        *state; /* owned; under way a list of the contacts, when first needed */
    double *diameter, *stress; /* owned; computed when first needed */
    struct gb_state_gaps gaps; /* the same */
    bool gaps_found;
    double *angular[GB_ARRAY_ANGULAR]; /* the same, of unequal particles */
};

struct gb_saved_state {
    struct gb_array_source packing;
};

/* Frees all computed arrays; call it when the positions change. */
void gb_array_forget(struct gb_array_source *packing);

/* The time unit T in s; NaN in scenes without time. */
double gb_array_second_per_time(const struct gb_array_source *packing);

/* Finds an array by its name.  Errors: see gb_saved_state_array. */
bool gb_array_find(struct gb_array_source *packing, const char *name,
                   struct gb_array *array, struct gb_error *err);

#endif
