#ifndef GB_SOLVE_PROGRAMME_H
#define GB_SOLVE_PROGRAMME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/record.h"
#include "greenbody/model.h"
#include "pack/bed.h"

/* P3's experiment: powder falls through a funnel into the die, settles, is flattened by a
 * punch that is lifted again, and pressed.  Gravity is raised while it falls and eased
 * afterwards: a fall of a tenth of a millimetre would take a hundred times the pressing.
 * Steps of gb_leap between recorded points, guards on the way.  It owns no bed. */
struct gb_programme;

enum gb_programme_stage {
    GB_PROGRAMME_POUR,    /* until nothing is left in the funnel */
    GB_PROGRAMME_EASE,    /* gravity down to its value at rest */
    GB_PROGRAMME_SETTLE,  /* until the powder is at rest */
    GB_PROGRAMME_FLATTEN, /* punch down by a little, slowly */
    GB_PROGRAMME_LIFT,    /* and up again */
    GB_PROGRAMME_REST,    /* until the powder is at rest: its height is H0 */
    GB_PROGRAMME_PRESS,   /* the punch carries the pressure of the ramp */
    GB_PROGRAMME_OVER
};

enum gb_programme_outcome {
    GB_PROGRAMME_MORE,   /* the slice is used up */
    GB_PROGRAMME_POINT,  /* time to record */
    GB_PROGRAMME_DONE,   /* the ramp has ended */
    GB_PROGRAMME_STOPPED /* err says why; the bed is back at the last good state */
};

/* The bed lies loose in its funnel and obeys the law of filling; `law` is that of
 * pressing. */
bool gb_programme_create(struct gb_programme **out, const struct gb_die_scene *scene,
                         const struct gb_bed_law *law, struct gb_error *err);
void gb_programme_destroy(struct gb_programme *programme); /* NULL is fine */

/* Begins with the ramp, on a bed that lies filled, flattened and at rest: every law can
 * press the same one.  Errors: as of gb_bed_evaluate. */
bool gb_programme_begin(struct gb_programme *programme, struct gb_bed *bed,
                        struct gb_error *err);

/* At most max_steps time steps.  text (size bytes) receives one line when a stage ended
 * or a guard acted. */
enum gb_programme_outcome gb_programme_advance(struct gb_programme *programme,
                                               struct gb_bed *bed, int64_t max_steps,
                                               char *text, size_t size,
                                               struct gb_error *err);

/* What goes into a recorded point, reduced units. */
struct gb_programme_report {
    enum gb_programme_stage stage;
    double time;    /* since the start */
    double pressed; /* time of the ramp so far */
    int64_t steps;  /* since the last point */
    double height;  /* of the powder: of its highest particle, or of the punch */
    double height0; /* H0; 0 before it is known */
    double wanted;  /* pressure of the ramp */
    double carried; /* by the powder under the punch, mean since the last point */
    double floor_over_punch; /* forces, likewise; NaN without a punch */
    double side[2];          /* mean pressure on the side wall, x and y */
    double residual;         /* rms resultant force over the mean contact force */
    double time_step;        /* last used */
    double progress;         /* 0..1 */
};
struct gb_programme_report gb_programme_report(const struct gb_programme *programme,
                                               const struct gb_bed *bed);

/* The programme into a record at a recorded point, or back; then the bed is of the law of
 * pressing.  Errors: GB_ERR_INPUT naming what does not fit. */
bool gb_programme_record(struct gb_programme *programme, struct gb_record *record,
                         struct gb_error *err);

#endif
