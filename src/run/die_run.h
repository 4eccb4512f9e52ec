#ifndef GB_RUN_DIE_RUN_H
#define GB_RUN_DIE_RUN_H

#include "greenbody/snapshot.h"
#include "io/state.h"
#include "pack/die/bed.h"
#include "solve/die_stages.h"

/* What an experiment with kind = die consists of, instead of a world in a periodic cell:
 * a bed and its programme. */
struct gb_die_run {
    const struct gb_params *params;
    const struct gb_model *model;
    struct gb_bed *bed;
    struct gb_die_stages *programme;
    bool unsteady; /* floor and punch differed at the last point */
};

/* Fills the funnel.  params and model must outlive it.  Errors: as of gb_filling_create.
 */
bool gb_die_run_create(struct gb_die_run **out, const struct gb_params *params,
                       const struct gb_model *model, bool (*cancelled)(void *data),
                       void *data, struct gb_error *err);
/* Without a place for the spheres yet: gb_die_run_record loads them. */
bool gb_die_run_bare(struct gb_die_run **out, const struct gb_params *params,
                     const struct gb_model *model, struct gb_error *err);
/* All of it into a record at a recorded point, or back. */
bool gb_die_run_record(struct gb_die_run *run, struct gb_record *record,
                       struct gb_error *err);
void gb_die_run_destroy(struct gb_die_run *run); /* NULL is fine */

/* The state as a point.  step and seconds are the caller's to fill. */
void gb_die_run_measure(const struct gb_die_run *run, struct gb_point *point);

/* One line when the point just recorded begins or ends to be out of equilibrium, the
 * force on the floor not that on the punch; else "". */
void gb_die_run_judge(struct gb_die_run *run, const struct gb_point *point, char *text,
                      size_t size);

/* Contacts, forces, progress. */
void gb_die_run_observe(const struct gb_die_run *run, struct gb_snapshot *snapshot);

/* The packing for pictures and files: places are moved so that the die stands in a box
 * from 0, the box reaches up to the punch or the highest particle. */
bool gb_die_run_state(const struct gb_die_run *run, struct gb_state **out,
                      struct gb_error *err);

#endif
