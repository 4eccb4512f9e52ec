#include "pack/kernel/sweep_sized.h"

#include <math.h>

#include "pack/cell/world_private.h"
#include "pack/kernel/sweep.h"
#include "scene/unequal_pair.h"

/* A spring is cut back to a hair below its cap, so that no rounding error makes one at
 * rest slide; as in batch_laws.h. */
static const double hair = 1.0 - 0x1p-40;

/* One near pair on its way through the laws. */
struct touch {
    struct gb_law_unequal law;
    double r[3], n[3], distance, overlap;
    double turn_sum[3];   /* of arcs, see sweep_sized.h */
    double turn_apart[3]; /* difference of the rotations */
    double deepest;
    double shear[3], roll[3], pivot;
    double f_elastic;
    bool slides;
};

/* Spring turned into the tangent plane with its length kept, plus the tangential part of
 * what the pair moved. */
static void stretch(double spring[3], const double motion[3], const double n[3],
                    double share)
{
    const double along = gb_vec_dot(spring, n), moved = gb_vec_dot(motion, n);
    const double before = gb_vec_dot(spring, spring);
    double turned[3];
    for (int c = 0; c < 3; c++) {
        turned[c] = spring[c] - along * n[c];
    }
    const double after = gb_vec_dot(turned, turned);
    const double keep = after > 0.0 ? sqrt(before / after) : 0.0;
    for (int c = 0; c < 3; c++) {
        spring[c] = keep * turned[c] + share * (motion[c] - moved * n[c]);
    }
}

/* Geometry, and what the pair brings along. */
static void load(const struct gb_world *world, int64_t k, struct touch *touch)
{
    const struct gb_pair_list *near = &world->pairs.near;
    const struct gb_contacts *contacts = &world->contacts;
    const int64_t i = near->first[k], j = near->other[k];
    gb_unequal_pair_init(&touch->law, world->model, world->diameter[i],
                         world->diameter[j]);
    touch->distance = sqrt(gb_world_arm_of(world, near, i, k, touch->r));
    touch->overlap = touch->law.mean_diameter - touch->distance;
    touch->deepest = gb_contacts_deepest(contacts, k);
    touch->pivot = gb_contacts_value(contacts, contacts->pivot, k);
    for (int c = 0; c < 3; c++) {
        const double ti = world->turn[3 * i + c], tj = world->turn[3 * j + c];
        touch->n[c] = touch->r[c] / touch->distance;
        touch->turn_sum[c] = ti + tj;
        touch->turn_apart[c] = ti * touch->law.inverse_diameter[0] - tj * touch->law.inverse_diameter[1];
        touch->shear[c] = gb_contacts_value(contacts, contacts->shear[c], k);
        touch->roll[c] = gb_contacts_value(contacts, contacts->roll[c], k);
    }
}

static void store(struct gb_world *world, int64_t k, const struct touch *touch)
{
    struct gb_contacts *contacts = &world->contacts;
    gb_contacts_put(contacts, contacts->deepest, k, touch->deepest);
    gb_contacts_put(contacts, contacts->pivot, k, touch->pivot);
    for (int c = 0; c < 3; c++) {
        gb_contacts_put(contacts, contacts->shear[c], k, touch->shear[c]);
        gb_contacts_put(contacts, contacts->roll[c], k, touch->roll[c]);
        gb_contacts_put(contacts, contacts->arm[c], k, touch->r[c]);
    }
}

static void forget(struct touch *touch)
{
    touch->pivot = 0.0;
    for (int c = 0; c < 3; c++) {
        touch->shear[c] = touch->roll[c] = 0.0;
    }
}

static void drop_roll(struct touch *touch)
{
    touch->roll[0] = touch->roll[1] = touch->roll[2] = 0.0;
}

/* Overlap that the springs' contact radius belongs to. */
static double wide(const struct gb_model *model, const struct touch *touch)
{
    const bool printed = model->bridge.radius_current;
    return touch->deepest <= 0.0 ? touch->overlap
           : printed             ? touch->overlap + touch->law.bridge_length
                                 : touch->deepest;
}

/* Springs stretched by what happened since the last evaluation; arm: r_ij then. */
static void move_springs(const struct gb_model *model, struct touch *touch,
                         const double arm[3])
{
    const double share = model->slip.motion, *n = touch->n, *w = touch->turn_sum;
    const double lever = 0.5 * touch->distance / touch->law.mean_diameter;
    const double motion[3] = {touch->r[0] - arm[0] - lever * (w[1] * n[2] - w[2] * n[1]),
                              touch->r[1] - arm[1] - lever * (w[2] * n[0] - w[0] * n[2]),
                              touch->r[2] - arm[2] - lever * (w[0] * n[1] - w[1] * n[0])};
    stretch(touch->shear, motion, n, share);
    touch->pivot += share * gb_vec_dot(touch->turn_apart, n);
    stretch(touch->roll, touch->turn_apart, n, share);
}

/* A bridge whose shear or pivoting cap is reached shrinks or is gone, P1 below (5). */
static void fail(const struct gb_model *model, struct touch *touch)
{
    const struct gb_law_slip *slip = &model->slip;
    const double a = gb_law_unequal_radius(&touch->law, wide(model, touch));
    const double shear = gb_law_slip_shear_stiffness(slip, a) *
                         sqrt(gb_vec_dot(touch->shear, touch->shear));
    const double pivot = gb_law_slip_pivot_stiffness(slip, a) * fabs(touch->pivot);
    if (shear > gb_law_slip_bridge_shear_cap(slip, a) ||
        pivot > gb_law_slip_bridge_pivot_cap(slip, a)) {
        const bool stays = touch->overlap > touch->law.bridge_length;
        touch->deepest = stays ? touch->overlap : 0.0;
    }
}

static void advance(const struct gb_world *world, int64_t k, struct touch *touch)
{
    const struct gb_model *model = world->model;
    const double before = touch->deepest;
    if (touch->overlap <= 0.0) {
        touch->deepest = -1.0;
        forget(touch);
        return;
    }
    struct gb_law_bridge bridge = model->bridge;
    bridge.length = touch->law.bridge_length;
    touch->deepest =
        model->terms.bridges
            ? gb_law_bridge_deepest(&bridge, fmax(before, 0.0), touch->overlap)
            : 0.0;
    if (before < 0.0) {
        forget(touch);
    } else if (model->terms.friction) {
        const struct gb_contacts *contacts = &world->contacts;
        const double arm[3] = {gb_contacts_value(contacts, contacts->arm[0], k),
                               gb_contacts_value(contacts, contacts->arm[1], k),
                               gb_contacts_value(contacts, contacts->arm[2], k)};
        move_springs(model, touch, arm);
    }
    if (touch->deepest > 0.0) {
        fail(model, touch);
    }
    if (touch->deepest <= 0.0) {
        drop_roll(touch);
    }
}

/* Share of a spring that its cap leaves. */
static double cut(double carries, double cap)
{
    return carries > cap ? hair * cap / carries : 1.0;
}

/* Springs at their caps, and their loads: T on i, and the moment on i. */
static void load_springs(const struct gb_model *model, struct touch *touch,
                         double shear[3], double moment[3])
{
    const struct gb_law_slip *slip = &model->slip;
    const bool held = touch->deepest > 0.0;
    const double a = gb_law_unequal_radius(&touch->law, wide(model, touch));
    const double strength = gb_law_slip_bridge_shear_cap(slip, a);
    const double twisting = gb_law_slip_bridge_pivot_cap(slip, a);
    const double cap = held ? strength : fmin(slip->mu * touch->f_elastic, strength);
    const double turn_cap =
        held ? twisting
             : fmin(slip->mu_pivot * gb_law_unequal_moment(&touch->law, touch->overlap),
                    twisting);
    const double ks = gb_law_slip_shear_stiffness(slip, a);
    const double kp = gb_law_slip_pivot_stiffness(slip, a);
    const double kr = gb_law_slip_roll_stiffness(slip, a);
    const double keep = cut(ks * sqrt(gb_vec_dot(touch->shear, touch->shear)), cap);
    const double hold = cut(kr * sqrt(gb_vec_dot(touch->roll, touch->roll)),
                            gb_law_slip_roll_cap(a, touch->f_elastic));
    touch->slides = keep < 1.0;
    touch->pivot *= cut(kp * fabs(touch->pivot), turn_cap);
    for (int c = 0; c < 3; c++) {
        touch->shear[c] *= keep;
        touch->roll[c] *= hold;
        shear[c] = -ks * touch->shear[c];
        moment[c] = -kp * touch->pivot * touch->n[c] - kr * touch->roll[c];
    }
}

/* Row of a pair: force on i, arcs' torque on i, on j. */
static void push(const struct gb_model *model, struct touch *touch, double row[9])
{
    double shear[3] = {0.0, 0.0, 0.0}, moment[3] = {0.0, 0.0, 0.0};
    const double *n = touch->n, lever = 0.5 * touch->distance / touch->law.mean_diameter;
    touch->f_elastic =
        gb_law_unequal_elastic(&touch->law, touch->deepest, touch->overlap, NULL);
    if (model->terms.friction) {
        load_springs(model, touch, shear, moment);
    }
    for (int c = 0; c < 3; c++) {
        const int u = (c + 1) % 3, v = (c + 2) % 3;
        const double both = -lever * (n[u] * shear[v] - n[v] * shear[u]);
        row[c] = (touch->f_elastic - touch->law.adhesion) * n[c] + shear[c];
        row[3 + c] = both - moment[c] * touch->law.inverse_diameter[1];
        row[6 + c] = both + moment[c] * touch->law.inverse_diameter[0];
    }
}

/* A pair across a gap: the pull on i. */
static void pull_apart(const struct gb_model *model, const struct gb_law_unequal *law,
                       const double r[3], double distance, double force[3])
{
    const bool reached =
        model->terms.attraction && distance - law->mean_diameter < model->numerics.cutoff - 1.0;
    const double pull = reached ? gb_law_unequal_attraction(law, distance) / distance : 0.0;
    for (int c = 0; c < 3; c++) {
        force[c] = -pull * r[c];
    }
}

/* What a near pair adds to the tally stands behind its row until it is summed up. */
enum { NORMAL = 9, SHARE = 10, SLIDES = 11 };
_Static_assert(SLIDES + 1 == GB_SIZED_ROW, "a row holds these");

static void sweep_near(struct gb_world *world, int64_t k)
{
    struct touch touch = {0};
    double *row = world->wrench + GB_SIZED_ROW * k;
    load(world, k, &touch);
    advance(world, k, &touch);
    for (int c = 0; c < GB_SIZED_ROW; c++) {
        row[c] = 0.0;
    }
    if (touch.deepest >= 0.0) {
        push(world->model, &touch, row);
        row[NORMAL] = fabs(touch.f_elastic - touch.law.adhesion);
        row[SLIDES] = touch.slides;
    } else {
        pull_apart(world->model, &touch.law, touch.r, touch.distance, row);
    }
    row[SHARE] = touch.overlap / touch.law.mean_diameter;
    store(world, k, &touch);
}

static void sweep_far(struct gb_world *world, int64_t k)
{
    const struct gb_pair_list *far = &world->pairs.far;
    const int64_t i = far->first[k], j = far->other[k];
    struct gb_law_unequal law;
    double r[3];
    gb_unequal_pair_init(&law, world->model, world->diameter[i], world->diameter[j]);
    const double distance = sqrt(gb_world_arm_of(world, far, i, k, r));
    pull_apart(world->model, &law, r, distance, world->pull + 3 * k);
}

/* Sums in the order of the lists, by one thread; the turns have been seen. */
static void sum_up(struct gb_world *world)
{
    const struct gb_pair_list *near = &world->pairs.near, *far = &world->pairs.far;
    struct gb_tally tally = {0};
    for (int64_t i = 0; i < 3 * world->count; i++) {
        world->force[i] = world->torque[i] = world->turn[i] = 0.0;
    }
    for (int64_t k = 0; k < near->pair_count; k++) {
        const int64_t i = 3 * (int64_t)near->first[k], j = 3 * (int64_t)near->other[k];
        const double *row = world->wrench + GB_SIZED_ROW * k;
        for (int c = 0; c < 3; c++) {
            world->force[i + c] += row[c];
            world->force[j + c] -= row[c];
            world->torque[i + c] += row[6 + c];
            world->torque[j + c] += row[3 + c];
        }
        tally.contacts += gb_contacts_touch(&world->contacts, k);
        tally.normal_sum += row[NORMAL];
        tally.sliding += row[SLIDES] > 0.0;
        tally.deepest = fmax(tally.deepest, row[SHARE]);
    }
    for (int64_t k = 0; k < far->pair_count; k++) {
        for (int c = 0; c < 3; c++) {
            world->force[3 * (int64_t)far->first[k] + c] += world->pull[3 * k + c];
            world->force[3 * (int64_t)far->other[k] + c] -= world->pull[3 * k + c];
        }
    }
    world->tally = tally;
}

bool gb_sweep_sized_run(struct gb_world *world, double *travel)
{
    gb_neighbour_list_shifts(&world->cell, world->shift);
    if (!gb_sweep_list_holds(world, travel)) {
        return false;
    }
    const int64_t near = world->pairs.near.pair_count, far = world->pairs.far.pair_count;
#pragma omp parallel num_threads(world->threads) if (world->threads > 1)
    {
#pragma omp for schedule(static) nowait
        for (int64_t k = 0; k < near; k++) {
            sweep_near(world, k);
        }
#pragma omp for schedule(static)
        for (int64_t k = 0; k < far; k++) {
            sweep_far(world, k);
        }
    }
    sum_up(world);
    struct gb_force_sums sums;
    gb_sweep_sum(world, 0, world->count, &sums);
    gb_sweep_conclude(world, &sums);
    return true;
}
