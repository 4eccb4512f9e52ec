#include "measure/observe_die.h"

#include <math.h>

#include "base/portable.h"
#include "base/vec.h"
#include "measure/ball.h"

double gb_observe_die_density(const struct gb_bed *bed, double height)
{
    const double area = M_PI * bed->die.radius * bed->die.radius;
    return height > 0.0 ? gb_bed_solid_volume(bed) / (area * height) : (double)NAN;
}

double gb_observe_die_central(const struct gb_bed *bed, double height, double radius)
{
    const double centre[3] = {0.0, 0.0, 0.5 * height};
    double solid = 0.0;
    if (height < 2.0 * radius) {
        return (double)NAN;
    }
    for (int64_t i = 0; i < bed->count; i++) {
        double r[3] = {0.0, 0.0, 0.0};
        gb_vec_add(r, 1.0, bed->position[i]);
        gb_vec_add(r, -1.0, centre);
        solid += gb_ball_shared_volume(bed->position[i][3], radius, gb_vec_length(r));
    }
    return solid / gb_ball_volume(radius);
}

static bool touches(const struct gb_bed_list *list, int64_t slot)
{
    return list->contacts.normal[slot] >= 0.0;
}

/* Contacts of every particle with others into each, or with walls too. */
static void count_each(const struct gb_bed *bed, bool walls, int32_t *each)
{
    for (int64_t i = 0; i < bed->count; i++) {
        each[i] = 0;
    }
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        if (touches(&bed->pairs, slot)) {
            each[bed->pairs.first[slot]]++;
            each[bed->pairs.other[slot]]++;
        }
    }
    for (int64_t slot = 0; walls && slot < bed->walls.count; slot++) {
        each[bed->walls.first[slot]] += touches(&bed->walls, slot);
    }
}

void gb_observe_die_contacts(const struct gb_bed *bed, struct gb_contact_counts *counts,
                             double *share, int bins, int32_t *each)
{
    int32_t *held = bed->counts;
    *counts = (struct gb_contact_counts){0};
    count_each(bed, true, held);
    for (int64_t i = 0; i < bed->count; i++) {
        counts->rattlers += held[i] < 2;
    }
    count_each(bed, false, held);
    for (int b = 0; share && b < bins; b++) {
        share[b] = 0.0;
    }
    for (int64_t i = 0; i < bed->count; i++) {
        counts->contacts += held[i];
        if (share) {
            share[held[i] < bins ? held[i] : bins - 1] += 1.0 / (double)bed->count;
        }
        if (each) {
            each[i] = held[i];
        }
    }
    counts->contacts /= 2;
    counts->coordination = 2.0 * (double)counts->contacts / (double)bed->count;
}

double gb_observe_die_filled(const struct gb_bed *bed)
{
    double top = 0.0;
    count_each(bed, true, bed->counts);
    for (int64_t i = 0; i < bed->count; i++) {
        const double *x = bed->position[i];
        if (bed->counts[i] > 0 && x[2] < bed->die.height) {
            top = fmax(top, x[2] + x[3]);
        }
    }
    return top;
}

void gb_observe_die_wall(const struct gb_bed *bed, double height, int bands,
                         double *pressure)
{
    const double area = 2.0 * M_PI * bed->die.radius * height / bands;
    for (int b = 0; b < bands; b++) {
        pressure[b] = height > 0.0 ? 0.0 : (double)NAN;
    }
    for (int64_t slot = 0; height > 0.0 && slot < bed->walls.count; slot++) {
        const double *x = bed->position[bed->walls.first[slot]];
        double unit[3];
        if (bed->walls.other[slot] != GB_DIE_SIDE || !touches(&bed->walls, slot)) {
            continue;
        }
        gb_die_overlap(&bed->die, GB_DIE_SIDE, x, x[3], unit);
        const double radial = gb_portable_hypot(unit[0], unit[1]);
        const int b = (int)(x[2] / height * bands);
        pressure[b < bands ? b : bands - 1] +=
            bed->walls.contacts.normal[slot] * radial / area;
    }
}

void gb_observe_die_force(const struct gb_bed *bed, int64_t slot, double unit[3],
                          double force[3])
{
    const struct gb_bed_contacts *contacts = &bed->pairs.contacts;
    const double *xi = bed->position[bed->pairs.first[slot]];
    const double *xj = bed->position[bed->pairs.other[slot]];
    for (int k = 0; k < 3; k++) {
        unit[k] = xi[k] - xj[k];
    }
    gb_vec_scale(unit, 1.0 / gb_vec_length(unit));
    for (int k = 0; k < 3; k++) {
        force[k] = contacts->normal[slot] * unit[k] + contacts->shear[k][slot];
    }
}

void gb_observe_die_rose(const struct gb_bed *bed, int bins, double *mean)
{
    enum { BINS_MOST = 360 };
    double sum[BINS_MOST] = {0};
    int64_t hits[BINS_MOST] = {0};
    bins = bins < BINS_MOST ? bins : BINS_MOST;
    for (int64_t slot = 0; slot < bed->pairs.count; slot++) {
        if (touches(&bed->pairs, slot)) {
            double unit[3], force[3];
            gb_observe_die_force(bed, slot, unit, force);
            const int b =
                (int)(acos(fmin(1.0, fabs(unit[2]))) / (0.5 * M_PI) * (double)bins);
            sum[b < bins ? b : bins - 1] += bed->pairs.contacts.normal[slot];
            hits[b < bins ? b : bins - 1]++;
        }
    }
    for (int b = 0; b < bins; b++) {
        mean[b] = hits[b] > 0 ? sum[b] / (double)hits[b] : (double)NAN;
    }
}
