/* Measures of a packing right after an evaluation: tensors and their invariants, contacts,
 * energies, roses; of periodic cells, then of beds in a die. */
#include "measure/observe.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/mat.h"
#include "base/portable.h"
#include "base/team.h"
#include "base/vec.h"
#include "measure/ball.h"
#include "pack/cell/world.h"
#include "pack/die/bed.h"
#include "pack/kernel/fabric_sums.h"
#include "pack/kernel/pair_forces.h"
#include "scene/unequal_pair.h"

/* Invariants of a tensor of stresses or of fabric, in 3D or in the x-z plane (dimension 2:
 * row and column y do not count). */

static double counted(int k, int dimension)
{
    return dimension == 3 || k != 1 ? 1.0 : 0.0;
}

double gb_observe_mean(const double tensor[3][3], int dimension)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        sum += counted(k, dimension) * tensor[k][k];
    }
    return sum / dimension;
}

/* Deviator of the symmetric part; returns s:s. */
static double deviator(const double tensor[3][3], int dimension, double s[3][3])
{
    const double mean = gb_observe_mean(tensor, dimension);
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        for (int l = 0; l < 3; l++) {
            const double normal = k == l ? mean : 0.0;
            s[k][l] = counted(k, dimension) * counted(l, dimension) *
                      (0.5 * (tensor[k][l] + tensor[l][k]) - normal);
            square += s[k][l] * s[k][l];
        }
    }
    return square;
}

double gb_observe_deviatoric(const double tensor[3][3], int dimension)
{
    double s[3][3];
    return sqrt((dimension == 3 ? 1.5 : 2.0) * deviator(tensor, dimension, s));
}

double gb_observe_asymmetry(const double tensor[3][3], int dimension)
{
    const double xz = tensor[0][2] - tensor[2][0];
    const double xy = counted(1, dimension) * (tensor[0][1] - tensor[1][0]);
    const double yz = counted(1, dimension) * (tensor[1][2] - tensor[2][1]);
    const double mean = gb_observe_mean(tensor, dimension);
    return mean != 0.0 ? sqrt(0.5 * (xy * xy + xz * xz + yz * yz)) / fabs(mean)
                       : (double)NAN;
}

/* The eigenvalues of a deviator in 3D are 2 sqrt(J2/3) cos(phi + 2 pi k/3), where
 * cos(3 phi) = (3 sqrt(3)/2) J3/J2^1.5. */
double gb_observe_largest_deviator(const double tensor[3][3], int dimension)
{
    double s[3][3];
    const double j2 = 0.5 * deviator(tensor, dimension, s);
    if (dimension == 2 || j2 == 0.0) {
        return sqrt(j2);
    }
    const double j3 = gb_mat_determinant((const double(*)[3])s);
    const double cosine = 1.5 * sqrt(3.0) * j3 / (j2 * sqrt(j2));
    return 2.0 * sqrt(j2 / 3.0) * cos(acos(fmax(-1.0, fmin(1.0, cosine))) / 3.0);
}

/* Sum over weight; NaN without a weight. */
static void mean_tensor(const struct gb_fabric_sums *sums, int kind, double tensor[3][3])
{
    static const int component[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    for (int a = 0; a < 9; a++) {
        tensor[a / 3][a % 3] =
            sums->tensor[kind][component[a / 3][a % 3]] / sums->weight[kind];
    }
}

void gb_observe_fabric(const struct gb_world *world, double pressure[3][3],
                       struct gb_fabric *fabric)
{
    const int dimension = gb_world_model(world)->dimension;
    struct gb_fabric_sums sums = {.weight = {0}};
    gb_world_tensors(world, pressure, &sums);
    for (int kind = 0; kind < GB_FABRIC_KINDS; kind++) {
        double tensor[3][3];
        mean_tensor(&sums, kind, tensor);
        fabric->anisotropy[kind] =
            (dimension == 3 ? 1.5 : 2.0) *
            gb_observe_largest_deviator((const double(*)[3])tensor, dimension);
    }
    for (int k = 0; k < 6; k++) {
        fabric->all[k] = sums.tensor[GB_FABRIC_ALL][k] / sums.weight[GB_FABRIC_ALL];
    }
}

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

/* Measures of a bed in a die right after an evaluation; reduced units. */

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
