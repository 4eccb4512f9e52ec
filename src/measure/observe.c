#include "measure/observe.h"

#include <math.h>
#include <string.h>

#include "base/team.h"
#include "base/vec.h"
#include "pack/cell/world.h"
#include "pack/kernel/pair_forces.h"
#include "scene/unequal_pair.h"

double gb_observe_density(const struct gb_world *world)
{
    return gb_world_density(world);
}

void gb_observe_pressure(const struct gb_world *world, double pressure[3][3])
{
    gb_world_pressure(world, pressure);
}

/* Energy in the springs of a contact of radius a; their loads act over the whole relative
 * motion. */
static double spring_energy(const struct gb_model *model,
                            const struct gb_contacts *contacts, int64_t k, double a)
{
    const struct gb_law_slip *slip = &model->slip;
    double shear2 = 0.0, roll2 = 0.0;
    for (int c = 0; c < (model->record_dimension == 3 ? 3 : 1); c++) {
        const double shear = gb_contacts_value(contacts, contacts->shear[c], k);
        const double roll = gb_contacts_value(contacts, contacts->roll[c], k);
        shear2 += shear * shear;
        roll2 += roll * roll;
    }
    const double pivot = model->record_dimension == 3
                             ? gb_contacts_value(contacts, contacts->pivot, k)
                             : 0.0;
    return 0.5 / slip->motion *
           (gb_law_slip_shear_stiffness(slip, a) * shear2 +
            gb_law_slip_roll_stiffness(slip, a) * roll2 +
            gb_law_slip_pivot_stiffness(slip, a) * pivot * pivot);
}

/* The laws of a pair, and where its attraction is cut off. */
struct bond {
    struct gb_law_unequal law;
    double reach, base; /* energy at the reach */
};

static struct bond bond_of(const struct gb_model *model, double first, double second)
{
    struct bond bond;
    gb_unequal_pair_init(&bond.law, model, first, second);
    bond.reach = bond.law.mean_diameter + model->numerics.cutoff - 1.0;
    bond.base = gb_law_unequal_attraction_energy(&bond.law, bond.reach);
    return bond;
}

/* Energy of pair k of a list: attraction, and where it touches, along its normal (below
 * h_min the area under the line counts) and in its springs.  equal: the bond of all pairs
 * where particles have one size. */
static double pair_energy(const struct gb_world *world, const struct gb_pair_list *list,
                          int64_t i, int64_t k, const struct bond *equal)
{
    const struct gb_model *model = gb_world_model(world);
    const struct gb_contacts *contacts = gb_world_contacts(world);
    const bool near = list == &gb_world_pairs(world)->near;
    const struct bond bond = model->polydisperse
                                 ? bond_of(model, gb_world_diameter(world, i),
                                           gb_world_diameter(world, list->other[k]))
                                 : *equal;
    double r[3], sum = 0.0;
    gb_world_branch_vector(world, list, i, k, r);
    const double length = gb_vec_length(r), h = bond.law.mean_diameter - length;
    if (near && gb_contacts_touch(contacts, k)) {
        const double deepest = gb_contacts_deepest(contacts, k);
        const bool printed = deepest > 0.0 && model->bridge.radius_current;
        const double wide = printed ? h + bond.law.bridge_length : fmax(deepest, 0.0);
        sum = gb_law_unequal_elastic_energy(&bond.law, deepest, h) +
              spring_energy(model, contacts, k,
                            gb_law_unequal_radius(&bond.law, deepest > 0.0 ? wide : h));
    }
    if (model->terms.attraction && length < bond.reach) {
        sum += gb_law_unequal_attraction_energy(&bond.law, length) - bond.base;
    }
    return sum;
}

double gb_observe_elastic(const struct gb_world *world)
{
    const struct gb_neighbour_list *pairs = gb_world_pairs(world);
    const struct bond equal = bond_of(gb_world_model(world), 1.0, 1.0);
    double sum = 0.0;
    for (int64_t i = 0; i < gb_world_model(world)->count; i++) {
        for (int64_t k = pairs->near.start[i]; k < pairs->near.start[i + 1]; k++) {
            sum += pair_energy(world, &pairs->near, i, k, &equal);
        }
        for (int64_t k = pairs->far.start[i]; k < pairs->far.start[i + 1]; k++) {
            sum += pair_energy(world, &pairs->far, i, k, &equal);
        }
    }
    return sum;
}

/* Shares of particles with n contacts, the last bin for those with more. */
static void share_out(const int32_t *degree, int64_t count, double *share, int bins)
{
    for (int b = 0; b < bins; b++) {
        share[b] = 0.0;
    }
    for (int64_t i = 0; i < count; i++) {
        const int n = degree[i];
        share[n < bins ? n : bins - 1] += 1.0 / (double)count;
    }
}

/* Counts over a part of the particles. */
struct part_counts {
    int64_t touching, bridged, rattlers;
};

struct counting {
    const struct gb_world *world;
    const int32_t *degree;
    struct part_counts *part;
};

enum { PARTS = 32 };

static void count_part(void *data, int64_t p)
{
    const struct counting *counting = data;
    const struct gb_pair_list *pairs = &gb_world_pairs(counting->world)->near;
    const struct gb_contacts contacts = *gb_world_contacts(counting->world);
    const int64_t count = gb_world_model(counting->world)->count;
    const int64_t begin = count * p / PARTS, end = count * (p + 1) / PARTS;
    struct part_counts part = {0};
    for (int64_t i = begin; i < end; i++) {
        part.rattlers += counting->degree[i] < 2;
    }
    for (int64_t k = pairs->start[begin]; k < pairs->start[end]; k++) {
        const double deepest = gb_contacts_deepest(&contacts, k);
        part.touching += deepest >= 0.0;
        part.bridged += deepest > 0.0;
    }
    counting->part[p] = part;
}

void gb_observe_contacts(const struct gb_world *world, struct gb_contact_counts *counts,
                         double *share, int bins, int32_t *each)
{
    const int64_t count = gb_world_model(world)->count;
    const int32_t *degree = gb_world_coordination(world);
    struct part_counts part[PARTS];
    struct counting counting = {.world = world, .degree = degree, .part = part};
    int64_t touching = 0, bridged = 0, rattlers = 0;
    gb_team_run(gb_world_team(world), PARTS, count_part, &counting);
    for (int p = 0; p < PARTS; p++) {
        touching += part[p].touching;
        bridged += part[p].bridged;
        rattlers += part[p].rattlers;
    }
    if (each) {
        memcpy(each, degree, (size_t)count * sizeof *each);
    }
    if (share) {
        share_out(degree, count, share, bins);
    }
    *counts = (struct gb_contact_counts){.contacts = touching,
                                         .bridged = bridged,
                                         .rattlers = rattlers,
                                         .coordination =
                                             2.0 * (double)touching / (double)count};
}

void gb_observe_rose(const struct gb_world *world, int bins, double *mean)
{
    const struct gb_pair_list *pairs = &gb_world_pairs(world)->near;
    const int64_t count = gb_world_model(world)->count;
    const struct gb_contacts *contacts = gb_world_contacts(world);
    enum { BINS_MOST = 360 };
    double sum[BINS_MOST] = {0};
    int64_t hits[BINS_MOST] = {0};
    struct gb_pair_forces forces;
    gb_pair_forces_init(&forces, world, GB_PAIR_FORCES_NEAR);
    bins = bins < BINS_MOST ? bins : BINS_MOST;
    for (int64_t i = 0; i < count; i++) {
        for (int64_t k = pairs->start[i]; k < pairs->start[i + 1]; k++) {
            if (gb_contacts_touch(contacts, k)) {
                double r[3];
                gb_world_branch_vector(world, pairs, i, k, r);
                const double length = gb_vec_length(r);
                const double angle = acos(fmin(1.0, fabs(r[2]) / length));
                const int b = (int)(angle / (0.5 * M_PI) * bins);
                const int bin = b < bins ? b : bins - 1;
                double force[3];
                gb_pair_forces_at(&forces, k, force);
                sum[bin] += gb_vec_dot(force, r) / length;
                hits[bin]++;
            }
        }
    }
    for (int b = 0; b < bins; b++) {
        mean[b] = hits[b] > 0 ? sum[b] / (double)hits[b] : NAN;
    }
}
