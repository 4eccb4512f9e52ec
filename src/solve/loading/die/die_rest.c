#include "solve/loading/die/die_rest.h"

#include <math.h>

#include "scene/tolerances.h"

/* True when contacts bear the highest particle; false while it falls. */
static bool top_is_supported(const struct gb_bed *bed, double gravity)
{
    int64_t highest = 0;
    double top = 0.0;
    for (int64_t i = 0; i < bed->count; i++) {
        const double reach = bed->position[i][2] + bed->position[i][3];
        highest = reach > top ? i : highest;
        top = fmax(reach, top);
    }
    return bed->force[highest][2] > GB_REST_SUPPORT_MIN * bed->mass[highest] * gravity;
}

struct gb_die_rest_state gb_die_rest_state(const struct gb_die_stages *stages,
                                           const struct gb_bed *bed)
{
    const bool pours = stages->now.stage == GB_DIE_STAGES_POUR;
    const double gravity = stages->now.leapfrog.gravity;
    const double weight = gravity * gb_bed_solid_volume(bed) / (M_PI / 6.0);
    return (struct gb_die_rest_state){
        .kinetic = gb_bed_kinetic_energy(bed).translational,
        .kinetic_limit = (pours ? GB_POURED_FALL : GB_REST_FALL) * weight,
        .unbalanced = gb_bed_unbalanced_force(bed, gravity),
        .unbalanced_limit = pours ? GB_POURED_UNBALANCED : GB_REST_UNBALANCED,
    };
}

/* Motion decays about exponentially: the share of its logarithm. */
static double share_of(const struct gb_die_rest_state *rest, double most)
{
    const double kinetic = rest->kinetic / rest->kinetic_limit;
    return most > 1.0 && kinetic < most
               ? fmin(1.0 - log(fmax(kinetic, 1.0)) / log(most), 1.0)
               : 0.0;
}

static void note_share(struct gb_die_progress *now, const struct gb_die_rest_state *rest)
{
    now->most_kinetic = fmax(now->most_kinetic, rest->kinetic / rest->kinetic_limit);
    now->rest_share = fmax(now->rest_share, share_of(rest, now->most_kinetic));
}

static bool at_rest(struct gb_die_stages *stages, const struct gb_bed *bed)
{
    const struct gb_die_rest_state rest = gb_die_rest_state(stages, bed);
    note_share(&stages->now, &rest);
    return rest.kinetic < rest.kinetic_limit && rest.unbalanced < rest.unbalanced_limit &&
           top_is_supported(bed, stages->now.leapfrog.gravity);
}

int64_t gb_die_rest_in_funnel(const struct gb_bed *bed)
{
    int64_t left = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        left += bed->position[i][2] > bed->die.height;
    }
    return left;
}

/* Duration of a fall through the die, free or with drag (T). */
static double fall_time(const struct gb_leapfrog *leapfrog, double height)
{
    const double square = height / leapfrog->gravity;
    return sqrt(2.0 * square) + leapfrog->drag * square;
}

bool gb_die_rest_check_time(const struct gb_die_stages *stages, const struct gb_bed *bed,
                            struct gb_error *err)
{
    const struct gb_die_progress *now = &stages->now;
    return now->stage_time <=
               GB_REST_FALLS_MAX * fall_time(&now->leapfrog, bed->die.height) ||
           gb_error_set(
               err, GB_ERR_GUARD,
               "the powder does not come to rest: it has moved for %.3g us, "
               "%.0f falls through the die; accepted: a smaller numerics.safety, more contact.damping",
               1e6 * now->stage_time * stages->scene.second_per_time, GB_REST_FALLS_MAX);
}

bool gb_die_rest_lasts(struct gb_die_stages *stages, const struct gb_bed *bed)
{
    struct gb_die_progress *now = &stages->now;
    if (now->steps % GB_REST_CHECK_STEPS != 0) {
        return false;
    }
    now->checks_at_rest = at_rest(stages, bed) ? now->checks_at_rest + 1 : 0;
    return now->checks_at_rest >= GB_REST_CHECKS;
}

bool gb_die_rest_check_funnel(const struct gb_bed *bed, struct gb_error *err)
{
    const int64_t left = gb_die_rest_in_funnel(bed);
    return left == 0 ||
           gb_error_set(err, GB_ERR_GUARD,
                        "the funnel is clogged: %lld particle%s in it; accepted: a larger "
                        "die.outlet or smaller particles",
                        (long long)left, left == 1 ? " rests" : "s rest");
}
