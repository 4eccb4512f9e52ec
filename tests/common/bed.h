#ifndef GB_TESTS_BED_H
#define GB_TESTS_BED_H

#include <glib.h>
#include <math.h>

#include "pack/die/bed.h"

/* Hertz contacts of E = 1, nu = 0.3 without damping or friction. */
static inline struct gb_bed_law bed_law(void)
{
    const struct gb_elastic elastic = {1.0, 0.3};
    struct gb_bed_law law = {0};
    gb_law_hertz_init(&law.normal.hertz, &elastic, &elastic);
    law.shear = 4.0 * law.normal.hertz.shear / law.normal.hertz.modulus;
    return law;
}

/* The same with Storakers' law of exponent m and the yield point of P3. */
static inline struct gb_bed_law bed_storakers(double exponent, bool printed)
{
    const struct gb_elastic elastic = {1.0, 0.3};
    struct gb_bed_law law = bed_law();
    const double strength = gb_law_storakers_hollomon(800.0 / 180e3, 1.0, exponent);
    law.storakers = true;
    law.shear = 1.0;
    gb_law_storakers_init(&law.normal, &elastic, &elastic, strength, strength, exponent,
                          printed);
    return law;
}

/* A cylinder without a funnel. */
static inline struct gb_die bed_die(double radius)
{
    return (struct gb_die){.radius = radius};
}

static inline struct gb_bed *bed_create(int64_t count, const double *radius,
                                        const struct gb_die *die,
                                        const struct gb_bed_law *law)
{
    struct gb_bed *bed = NULL;
    struct gb_error err = {0};
    if (!gb_bed_create(&bed, count, radius, die, law, 1.0, &err)) {
        g_error("%s", err.text);
    }
    return bed;
}

static inline void bed_set_position(struct gb_bed *bed, int64_t i, double x, double y,
                                    double z)
{
    bed->position[i][0] = x;
    bed->position[i][1] = y;
    bed->position[i][2] = z;
    gb_bed_invalidate_lists(bed);
}

static inline void bed_evaluate(struct gb_bed *bed, double step)
{
    struct gb_error err = {0};
    if (!gb_bed_evaluate(bed, step, HUGE_VAL, &err)) {
        g_error("%s", err.text);
    }
}

#endif
