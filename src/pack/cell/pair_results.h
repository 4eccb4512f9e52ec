#ifndef GB_PACK_CELL_PAIR_RESULTS_H
#define GB_PACK_CELL_PAIR_RESULTS_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/contacts.h"
#include "scene/model.h"

/* Results of the pairs in double precision, one row per slot of a list; owned by
 * pair_results.c.  A world in single precision keeps none. */
struct gb_pair_results {
    double *wrench; /* rows per near pair: force on i, torque on j */
    int width;      /* doubles in a row: 6; of equal discs 3 (x, z, about y) */
    double *pull;   /* three per far pair: attraction on i */
    int64_t far_capacity;
    /* Dynamic scenes, per far pair: distance and attraction at the last evaluation. */
    double *far_distance, *far_pull;
};

void gb_pair_results_init(struct gb_pair_results *results, const struct gb_model *model);
void gb_pair_results_finish(struct gb_pair_results *results);

/* Room for `capacity` pairs; the contents are lost. */
bool gb_pair_results_resize_near(struct gb_pair_results *results, int64_t capacity,
                                 struct gb_error *err);
/* What is stored of a far pair. */
enum gb_pair_results_far {
    GB_PAIR_RESULTS_FAR_FORCE,
    GB_PAIR_RESULTS_FAR_WORK, /* also distance and attraction, for the work absorbed until
                               * the next evaluation (dynamic scenes) */
};

bool gb_pair_results_resize_far(struct gb_pair_results *results, int64_t capacity,
                                enum gb_real real, enum gb_pair_results_far content,
                                struct gb_error *err);

/* Rows of a scene in the x-z plane. */
static inline bool gb_pair_results_planar(const struct gb_pair_results *results)
{
    return results->width < 6;
}

/* Force of near pair k on its first particle. */
static inline void gb_pair_results_force(const struct gb_pair_results *results, int64_t k,
                                         double force[3])
{
    const double *row = results->wrench + (int64_t)results->width * k;
    const bool planar = gb_pair_results_planar(results);
    force[0] = row[0];
    force[1] = planar ? 0.0 : row[1];
    force[2] = planar ? row[1] : row[2];
}
void gb_pair_results_set_force(struct gb_pair_results *results, int64_t k,
                               const double force[3]);

/* The far pairs of a new list have no last evaluation. */
void gb_pair_results_reset_far(struct gb_pair_results *results, int64_t pairs);

#endif
