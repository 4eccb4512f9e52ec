#ifndef GB_SCENE_SIZES_H
#define GB_SCENE_SIZES_H

#include "greenbody/params.h"

/* The sizes of a powder, frozen from the parameters: particles.distribution and what
 * belongs to it.
 *
 * Sizes are not drawn one by one.  The distribution is cut into as many strata of equal
 * probability as there are particles, each particle stands for one of them, and the seed
 * only shuffles their order.  A bed of a given count thus holds the same sizes for every
 * seed, and beds differ by their packing alone.  Drawn independently, the volume of the
 * 1751 spheres of P3 would scatter by 4 % from seed to seed (the few largest carry most
 * of it), as much as the densities that are compared. */
struct gb_sizes {
    const struct gb_imported *packing; /* its particles; NULL: the rest */
    int distribution;                  /* enum gb_distribution */
    double median_m, sigma;            /* lognormal; mono: the diameter, 0 */
    double z_least, z_largest;         /* where it is cut, as (ln d - ln median)/sigma */
    int rows;                          /* table */
    double diameter_m[GB_SIZES_MAX];
    double below[GB_SIZES_MAX]; /* share by number up to and with this row; last: 1 */
};

struct gb_imported;

/* A scene with particles of more than one size in a periodic cell?  (Beds in a die draw
 * their sizes themselves.) */
bool gb_sizes_polydisperse(const struct gb_params *params);

/* Errors: those of gb_params_check about sizes (GB_ERR_INPUT). */
bool gb_sizes_init(struct gb_sizes *sizes, const struct gb_params *params,
                   struct gb_error *err);

/* The sizes of `count` particles, ascending; of a packing in its order.  lognormal: each stratum is represented by
 * the diameter of its mean volume, so that the volume of the powder is exact for every
 * count.  table: the row in which the middle of the stratum lies, so that only sizes of
 * the table come up, each within one particle of its share.
 *
 * diameter_m   count values */
void gb_sizes_fill(const struct gb_sizes *sizes, int64_t count, double *diameter_m);

/* The least and the largest of them, m. */
void gb_sizes_range(const struct gb_sizes *sizes, int64_t count, double *least,
                    double *largest);

/* Mean of d^power by number, m^power, power from 0 to 3 for a packing; the law's own, not
 * that of a draw. */
double gb_sizes_moment(const struct gb_sizes *sizes, int power);

/* pi/6 of the third moment, m^3. */
double gb_sizes_mean_volume(const struct gb_sizes *sizes);

#endif
