#ifndef GB_SOLVE_LOADING_DIE_DIE_STAGES_H
#define GB_SOLVE_LOADING_DIE_DIE_STAGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/record.h"
#include "pack/die/bed.h"
#include "scene/model.h"
#include "solve/step_outcome.h"

/* P3's experiment: powder falls through a funnel into the die, settles, is flattened by a
 * punch that is lifted again, comes to rest and is pressed.  Gravity is raised while it falls
 * and reduced in two steps, before flattening and behind it: a fall by 0.1 mm would take a
 * hundred times the time of pressing, and flattening under the last gravity ten times that of
 * filling.  Steps of gb_leapfrog between recorded points, with guards.  The bed belongs to the
 * caller. */
struct gb_die_stages;

enum gb_die_stages_stage {
    GB_DIE_STAGES_POUR,    /* until nothing is left in the funnel */
    GB_DIE_STAGES_EASE,    /* gravity down to that of flattening; again to that at rest */
    GB_DIE_STAGES_SETTLE,  /* until the powder is at rest; again: its height is H0 */
    GB_DIE_STAGES_FLATTEN, /* punch down by a little, slowly */
    GB_DIE_STAGES_LIFT,    /* and up again */
    GB_DIE_STAGES_REST,    /* until the powder is at rest; then EASE and SETTLE again */
    GB_DIE_STAGES_PRESS,   /* the punch carries the pressure of the ramp */
    GB_DIE_STAGES_OVER,
    /* A full cycle goes on instead, solve/loading/die/die_cycle.h; the numbers are in
     * checkpoints. */
    GB_DIE_STAGES_UNLOAD,   /* the pressure falls to none */
    GB_DIE_STAGES_WITHDRAW, /* punch up and off */
    GB_DIE_STAGES_CONFINED, /* rest in the die, its upper end open */
    GB_DIE_STAGES_EJECT,    /* pushed out through that end */
    GB_DIE_STAGES_FREE,     /* rest on the lower punch, outside the die */
    GB_DIE_STAGES_COUNT
};

/* The bed is loose in its funnel and has the law of filling; `law`: that of pressing.
 * Errors: GB_ERR_MEMORY. */
bool gb_die_stages_create(struct gb_die_stages **out, const struct gb_die_scene *scene,
                          const struct gb_bed_law *law, struct gb_error *err);
void gb_die_stages_destroy(struct gb_die_stages *stages); /* NULL is fine */

/* Begins with the ramp, on a filled and flattened bed at rest, so that several laws can
 * press the same bed.  Errors: as of gb_bed_evaluate. */
bool gb_die_stages_begin(struct gb_die_stages *stages, struct gb_bed *bed,
                         struct gb_error *err);

/* At most max_steps time steps.  text (size bytes) receives one line when a stage ended
 * or a guard acted. */
enum gb_step_outcome gb_die_stages_advance(struct gb_die_stages *stages,
                                           struct gb_bed *bed, int64_t max_steps,
                                           char *text, size_t size, struct gb_error *err);

/* Quantities of a recorded point, reduced units. */
struct gb_die_stages_report {
    enum gb_die_stages_stage stage;
    double time;    /* since the start */
    double pressed; /* time of the ramp so far */
    int64_t steps;  /* since the last point */
    double height;  /* of the powder: of its highest particle, or of the punch */
    double height0; /* H0; 0 before it is known */
    double wanted;  /* pressure of the ramp */
    double carried; /* by the powder under the punch, mean since the last point */
    double floor_over_punch; /* forces, likewise; NaN without a punch */
    double side[2];          /* mean pressure on the side wall, x and y */
    double floor;            /* pressure on the floor, mean since the last point */
    double contact;          /* height of the powder against the side, d */
    double drag; /* axial force of the side on the powder, likewise; downward */
    double work; /* of the punch since pressing began, E d^3 */
    /* Springback as fractions: height over that under the full pressure, outer radius over
     * that of the bore, less 1; NaN before that pressure. */
    double axial, radial;
    double welded;    /* share of the welds that holds; NaN without any */
    double residual;  /* rms resultant force over the mean contact force */
    double time_step; /* last used */
    double progress;  /* 0..1 */
};
struct gb_die_stages_report gb_die_stages_report(const struct gb_die_stages *stages,
                                                 const struct gb_bed *bed);

/* The stages into a record at a recorded point, or back; then the bed is of the law of
 * pressing.  Errors: GB_ERR_INPUT naming what does not fit. */
bool gb_die_stages_record(struct gb_die_stages *stages, const struct gb_bed *bed,
                          struct gb_record *record, struct gb_error *err);

#endif
