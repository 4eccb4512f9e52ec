#include "law/law_storakers.h"

#include "law/real_exact.h"

#include "law/storakers.h"

double gb_law_storakers_hollomon(double yield, double young, double exponent)
{
    return yield * gb_portable_pow(young / yield, exponent);
}

double gb_law_storakers_strength(double strength_i, double strength_j, double exponent)
{
    const double weak = fmin(strength_i, strength_j);
    const double strong = fmax(strength_i, strength_j);
    if (exponent <= 0.0 || !(weak > 0.0)) {
        return weak;
    }
    /* (18) divided by the term of the weaker body, so that nothing overflows at small m
     */
    return weak * gb_portable_pow(1.0 + gb_portable_pow(weak / strong, 1.0 / exponent),
                                  -exponent);
}

void gb_law_storakers_init(struct gb_law_storakers *law, const struct gb_elastic *i,
                           const struct gb_elastic *j, double strength_i,
                           double strength_j, double exponent, bool printed)
{
    gb_law_hertz_init(&law->hertz, i, j);
    law->exponent = exponent;
    law->strength = gb_law_storakers_strength(strength_i, strength_j, exponent);
    const double shape = gb_portable_pow(2.0, 1.0 - 0.5 * exponent) *
                         gb_portable_pow(3.0, 1.0 - exponent) * M_PI;
    law->factor = shape * 1.43 * gb_portable_exp(-0.97 * exponent);
    law->c = gb_portable_pow(law->factor / shape, 1.0 / (2.0 + exponent));
    law->printed = printed;
}

double gb_law_storakers_transition(const struct gb_law_storakers *law, double radius)
{
    const double ratio = 0.75 * law->factor * law->strength / law->hertz.modulus;
    return radius * gb_portable_pow(ratio, 2.0 / (1.0 - law->exponent));
}

/* Elastic part of overlap h above 0 on the curve (16). */
static double elastic_part_on_16(const struct gb_law_storakers *law, double transition,
                                 double h)
{
    return transition * gb_portable_pow(h / transition, elastic_power(law->exponent));
}

double gb_law_storakers_plastic(const struct gb_law_storakers *law, double radius,
                                double h)
{
    if (!(h > 0.0)) {
        return 0.0;
    }
    const double transition = gb_law_storakers_transition(law, radius);
    return gb_law_hertz_force(&law->hertz, radius,
                              elastic_part_on_16(law, transition, h));
}

/* Elastic part of overlap h on the loading curve. */
static double elastic_part(const struct gb_law_storakers *law, double radius, double h)
{
    const double transition = gb_law_storakers_transition(law, radius);
    return loaded_part(law->printed, h / transition,
                       elastic_part_on_16(law, transition, h), h);
}

struct gb_law_branch gb_law_storakers_loading(const struct gb_law_storakers *law,
                                              double radius, double h)
{
    if (!(h > 0.0)) {
        return (struct gb_law_branch){0.0, 0.0};
    }
    const double part = elastic_part(law, radius, h);
    const double force = gb_law_hertz_force(&law->hertz, radius, part);
    return (struct gb_law_branch){
        force, part == h && !law->printed ? gb_law_hertz_stiffness(&law->hertz, radius, h)
                                          : plastic_slope(law->exponent, force, h)};
}

double gb_law_storakers_contact(const struct gb_law_storakers *law, double radius,
                                double h)
{
    if (!(h > 0.0)) {
        return 0.0;
    }
    const bool plastic = law->printed || h > gb_law_storakers_transition(law, radius);
    return plastic ? law->c * sqrt(2.0 * radius * h) : sqrt(radius * h);
}

double gb_law_storakers_load(const struct gb_law_storakers *law, double radius, double h)
{
    return gb_law_storakers_loading(law, radius, h).force;
}

double gb_law_storakers_recovery(const struct gb_law_storakers *law, double radius,
                                 double deepest)
{
    /* in the elastic range this is exactly `deepest`: the contact unloads along its
     * loading curve */
    return deepest > 0.0 ? elastic_part(law, radius, deepest) : 0.0;
}

/* h - h0: the overlap in Hertz' law when the contact is below its deepest overlap. */
static double elastic_overlap(const struct gb_law_storakers *law, double radius,
                              double deepest, double h)
{
    const double rebound = gb_law_storakers_recovery(law, radius, deepest);
    return rebound == deepest ? h : rebound - (deepest - h);
}

struct gb_law_branch gb_law_storakers_update(const struct gb_law_storakers *law,
                                             double radius, double h, double *deepest)
{
    if (!(h > 0.0)) {
        *deepest = 0.0;
        return (struct gb_law_branch){0.0, 0.0};
    }
    if (h >= *deepest) {
        *deepest = h;
        return gb_law_storakers_loading(law, radius, h);
    }
    const double elastic = elastic_overlap(law, radius, *deepest, h);
    return (struct gb_law_branch){gb_law_hertz_force(&law->hertz, radius, elastic),
                                  gb_law_hertz_stiffness(&law->hertz, radius, elastic)};
}

/* Integral of (16) from 0 to h. */
static double plastic_work(const struct gb_law_storakers *law, double radius, double h)
{
    return gb_law_storakers_plastic(law, radius, h) * h / (2.0 + 0.5 * law->exponent);
}

double gb_law_storakers_loading_work(const struct gb_law_storakers *law, double radius,
                                     double h)
{
    if (law->printed) {
        return plastic_work(law, radius, h);
    }
    const double border = fmin(h, gb_law_storakers_transition(law, radius));
    return gb_law_hertz_energy(&law->hertz, radius, border) +
           (plastic_work(law, radius, h) - plastic_work(law, radius, border));
}

double gb_law_storakers_unloading_energy(const struct gb_law_storakers *law,
                                         double radius, double deepest, double h)
{
    if (!(h > 0.0)) {
        return 0.0;
    }
    /* a printed contact opens with a force left; that energy is not returned */
    const double from = elastic_overlap(law, radius, deepest, h);
    const double to = elastic_overlap(law, radius, deepest, 0.0);
    return gb_law_hertz_energy(&law->hertz, radius, from) -
           gb_law_hertz_energy(&law->hertz, radius, to);
}
