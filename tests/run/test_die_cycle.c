#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>
#include <gsl/gsl_statistics.h>

#include "common/die.h"
#include "pack/die/bed_record.h"
#include "pack/die/bed_welds.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "run/experiment_private.h"

/* The whole cycle of a die of seconds: pressed, unloaded, ejected, at rest. */

#define CYCLE "die.cycle=full", "loading.rest_time=4 us", "die.eject_speed=4 m/s"

enum { POINTS_MOST = 400 };

struct cycle {
    struct gb_point point[POINTS_MOST];
    int count;
    GString *events;
    enum gb_step_outcome how;
    uint64_t hash;
};

static struct gb_experiment *create(const struct gb_params *params)
{
    struct gb_error err = {0};
    struct gb_experiment *experiment = NULL;
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    return experiment;
}

static enum gb_step_outcome next_point(struct gb_experiment *experiment, int64_t slice)
{
    struct gb_error err = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE) {
        how = gb_experiment_advance(experiment, slice, &err);
    }
    return how;
}

static struct cycle run(const struct gb_params *params, int64_t slice)
{
    struct cycle cycle = {.events = g_string_new(NULL)};
    struct gb_experiment *experiment = create(params);
    char text[GB_EVENT_TEXT];
    while ((cycle.how = next_point(experiment, slice)) == GB_STEP_POINT) {
        g_assert_cmpint(cycle.count, <, POINTS_MOST);
        cycle.point[cycle.count++] = *gb_experiment_point(experiment);
    }
    while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        g_string_append_printf(cycle.events, "%s\n", text);
    }
    cycle.hash = gb_bed_record_hash(experiment->loading->bed);
    gb_experiment_destroy(experiment);
    return cycle;
}

/* Last point of a branch. */
static const struct gb_point *end_of(const struct cycle *cycle, int branch)
{
    for (int k = cycle->count; k > 0; k--) {
        if (cycle->point[k - 1].branch == branch) {
            return &cycle->point[k - 1];
        }
    }
    g_error("no point of branch %d: %s", branch, cycle->events->str);
    return NULL;
}

static double largest_friction(const struct cycle *cycle)
{
    double most = 0.0;
    for (int k = 0; k < cycle->count; k++) {
        if (cycle->point[k].branch == GB_BRANCH_EJECT) {
            most = fmax(most, cycle->point[k].wall_friction_n);
        }
    }
    return most;
}

/* Every stage in its order, told by an event, and what it has to leave behind. */
static void test_stages(void)
{
    static const char *const told[] = {"pressed after",   "unloaded after",
                                       "punch off after", "rested in the die after",
                                       "ejected after",   "rested outside the die"};
    static const int order[] = {GB_BRANCH_RELAX,    GB_BRANCH_LOAD,  GB_BRANCH_UNLOAD,
                                GB_BRANCH_CONFINED, GB_BRANCH_EJECT, GB_BRANCH_EJECTED};
    const struct gb_params params =
        die_params(CYCLE, "contact.mu=0.05", "die.weld_strength=800 MPa", NULL);
    struct cycle cycle = run(&params, 1000);
    g_assert_cmpint(cycle.how, ==, GB_STEP_DONE);
    size_t stage = 0;
    for (int k = 0; k < cycle.count; k++) {
        if (cycle.point[k].branch != order[stage]) {
            g_assert_cmpint(cycle.point[k].branch, ==, order[++stage]);
        }
    }
    g_assert_cmpint((int)stage, ==, (int)G_N_ELEMENTS(order) - 1);
    const char *at = cycle.events->str;
    for (size_t k = 0; k < G_N_ELEMENTS(told); k++) {
        at = strstr(at, told[k]);
        g_assert_nonnull(at);
    }
    const struct gb_point *load = end_of(&cycle, GB_BRANCH_LOAD);
    const struct gb_point *unload = end_of(&cycle, GB_BRANCH_UNLOAD);
    const struct gb_point *rest = end_of(&cycle, GB_BRANCH_CONFINED);
    const struct gb_point *ejected = end_of(&cycle, GB_BRANCH_EJECTED);
    g_assert_true(isnan(load->axial_springback));
    g_assert_cmpfloat(fabs(unload->p_pa), <, 0.02 * load->p_pa);
    g_assert_cmpfloat(unload->punch_work, <, load->punch_work);
    g_assert_cmpfloat(unload->punch_work, >, 0.0);
    g_assert_cmpfloat(rest->wall_pa, >, 1e-3 * load->wall_pa);
    g_assert_cmpfloat(rest->wall_pa, <, 0.5 * load->wall_pa);
    g_assert_cmpfloat(rest->axial_springback, >, 0.0);
    g_assert_cmpfloat(largest_friction(&cycle), >=, rest[1].wall_friction_n);
    /* while the compact slides as a whole, friction is all of mu_wall */
    const struct gb_point *slides = rest + 1;
    const double area = M_PI * params.die_diameter_m * slides->height_m;
    g_assert_cmpint(slides->branch, ==, GB_BRANCH_EJECT);
    g_assert_cmpfloat_with_epsilon(
        slides->wall_friction_n / (params.mu_wall * slides->wall_pa * area), 1.0, 0.05);
    g_assert_cmpfloat(ejected->wall_pa, ==, 0.0);
    g_assert_cmpfloat(ejected->welded, >, 0.5);
    g_assert_cmpfloat(ejected->axial_springback, >, 0.0);
    g_assert_cmpfloat(ejected->axial_springback, <, 0.1);
    g_assert_cmpfloat(fabs(ejected->radial_springback), <, 0.02);
    g_string_free(cycle.events, TRUE);
}

/* Without the key the run ends under full pressure, to the same bits as the cycle there. */
static void test_press_alone(void)
{
    const struct gb_params alone = die_params("loading.until=10 MPa", NULL);
    const struct gb_params full = die_params("loading.until=10 MPa", CYCLE, NULL);
    struct cycle a = run(&alone, 1000), b = run(&full, 1000);
    g_assert_cmpint(a.how, ==, GB_STEP_DONE);
    g_assert_cmpint(a.point[a.count - 1].branch, ==, GB_BRANCH_LOAD);
    g_assert_cmpint(b.count, >, a.count);
    g_assert_true(memcmp(a.point, b.point, sizeof a.point[0] * (size_t)a.count) == 0);
    g_string_free(a.events, TRUE);
    g_string_free(b.events, TRUE);
}

/* Contacts that never pull leave a heap without stress. */
static void test_without_welds(void)
{
    const struct gb_params params = die_params(CYCLE, NULL);
    struct cycle cycle = run(&params, 1000);
    g_assert_cmpint(cycle.how, ==, GB_STEP_DONE);
    g_assert_true(isnan(end_of(&cycle, GB_BRANCH_EJECTED)->welded));
    g_assert_cmpfloat(end_of(&cycle, GB_BRANCH_CONFINED)->wall_pa, <,
                      1e-4 * end_of(&cycle, GB_BRANCH_LOAD)->wall_pa);
    g_string_free(cycle.events, TRUE);
}

/* A run goes on from a point of every stage to the same bits. */
static void test_resume(void)
{
    static struct gb_record record[GB_BRANCH_LOAD - GB_BRANCH_LEAST + 1], whole, resumed;
    struct gb_error err = {0};
    int taken = 0;
    int64_t row = 0;
    const struct gb_params params = die_params(
        "loading.until=10 MPa", "contact.normal=storakers", "material.hardening=0.1",
        "contact.mu=0.05", "die.weld_strength=800 MPa", "die.cycle=full",
        "loading.rest_time=1 us", "die.eject_speed=20 m/s", "loading.unload_time=4 us",
        NULL);
    struct gb_experiment *experiment = create(&params);
    for (int branch = GB_BRANCH_RELAX; next_point(experiment, 1000) == GB_STEP_POINT;) {
        const struct gb_point *point = gb_experiment_point(experiment);
        if (point->branch != branch) {
            branch = point->branch;
            g_assert_true(gb_checkpoint_take(experiment, &record[taken++], &err));
        }
    }
    g_assert_cmpint(taken, ==, 5);
    g_assert_true(gb_checkpoint_take(experiment, &whole, &err));
    for (int k = 0; k < taken; k++) {
        struct gb_experiment *second = NULL;
        if (!gb_experiment_resume(&second, &params, &record[k], &err)) {
            g_error("%s", err.text);
        }
        while (next_point(second, 333) == GB_STEP_POINT) {
        }
        g_assert_true(gb_checkpoint_take(second, &resumed, &err));
        const char *different = gb_record_difference(&whole, &resumed, &row);
        if (different != NULL) {
            g_error("resumed at %d: %s, row %d differs", k, different, (int)row);
        }
        gb_experiment_destroy(second);
        gb_record_finish(&record[k]);
    }
    gb_experiment_destroy(experiment);
    gb_record_finish(&whole);
    gb_record_finish(&resumed);
}

/* A fault in a stage is told, and the way back is taken: the cycle ends as usual. */
static void test_fault(void)
{
    const struct gb_params params =
        die_params("loading.until=10 MPa", CYCLE, "die.weld_strength=800 MPa", NULL);
    struct gb_experiment *experiment = create(&params);
    GString *events = g_string_new(NULL);
    char text[GB_EVENT_TEXT];
    struct gb_error err = {0};
    enum gb_step_outcome how;
    while (next_point(experiment, 1000) == GB_STEP_POINT &&
           gb_experiment_point(experiment)->branch != GB_BRANCH_EJECT) {
    }
    g_assert_cmpint(gb_experiment_advance(experiment, 50, &err), ==, GB_STEP_MORE);
    experiment->loading->bed->position[11][1] = NAN;
    while ((how = next_point(experiment, 1000)) == GB_STEP_POINT) {
    }
    g_assert_cmpint(how, ==, GB_STEP_DONE);
    while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        g_string_append_printf(events, "%s\n", text);
    }
    g_assert_nonnull(strstr(events->str, "guard: "));
    g_assert_cmpint(gb_bed_escaped(experiment->loading->bed), ==, -1);
    g_assert_cmpint(gb_experiment_point(experiment)->branch, ==, GB_BRANCH_EJECTED);
    g_string_free(events, TRUE);
    gb_experiment_destroy(experiment);
}

/* Elastic energy of a contact at its normal force: Hertz from h0 on, 2/5 F (h - h0). */
static double elastic(const struct gb_bed_list *list, double modulus,
                      const struct gb_bed *bed)
{
    double sum = 0.0;
    for (int64_t slot = 0; slot < list->count; slot++) {
        const double force = list->contacts.normal[slot];
        const double ri = bed->position[list->first[slot]][3];
        const double rj =
            list == &bed->walls ? HUGE_VAL : bed->position[list->other[slot]][3];
        const double hertz = 4.0 / 3.0 * modulus * sqrt(gb_law_hertz_radius(ri, rj));
        sum += force > 0.0 ? 0.4 * force * cbrt(pow(force / hertz, 2.0)) : 0.0;
    }
    return sum;
}

struct unloading {
    double stored, returned, work, springback;
};

/* Pressed with damping, unloaded without any friction or damping. */
static struct unloading unload(const char *normal, const char *time, const char *seed)
{
    struct gb_error err = {0};
    const struct gb_params params =
        die_params("contact.mu_wall=0", normal, time, "material.hardening=0",
                   "loading.time=40 us", "numerics.safety=0.2", seed, CYCLE, NULL);
    struct gb_experiment *experiment = create(&params);
    const struct gb_point *point = gb_experiment_point(experiment);
    struct unloading result = {0};
    while (next_point(experiment, 1000) == GB_STEP_POINT &&
           point->target_pa < 0.9999 * params.until_pressure_pa) {
    }
    struct gb_bed *bed = experiment->loading->bed;
    const double joule =
        experiment->model->newton_per_force * experiment->model->metre_per_length;
    const double modulus = bed->law.normal.hertz.modulus;
    result.stored =
        joule * (elastic(&bed->pairs, modulus, bed) + elastic(&bed->walls, modulus, bed));
    result.work = point->punch_work;
    bed->law.damping = 0.0;
    for (int64_t k = 0; k < bed->pairs.count; k++) {
        bed->pairs.contacts.damping[k] = 0.0;
    }
    for (int64_t k = 0; k < bed->walls.count; k++) {
        bed->walls.contacts.damping[k] = 0.0;
    }
    while (next_point(experiment, 1000) == GB_STEP_POINT &&
           point->branch == GB_BRANCH_UNLOAD) {
        result.returned = result.work - point->punch_work;
        result.springback = point->axial_springback;
    }
    (void)err;
    gb_experiment_destroy(experiment);
    g_test_message("%s: work %.4g, stored %.4g, returned %.4g nJ (%.4f), springback %.5f",
                   normal, 1e9 * result.work, 1e9 * result.stored, 1e9 * result.returned,
                   result.returned / result.stored, result.springback);
    return result;
}

/* Medians of three beds: in one of ten a small sphere bounces between the punch and its
 * neighbours, which adds a percent to the work. */
struct unloading_shares {
    double returned, stored; /* over what was stored, and over the work */
    double springback;
};

static struct unloading_shares unload_three(const char *normal)
{
    static const char *const seed[] = {"structure.seed=1", "structure.seed=2",
                                       "structure.seed=3"};
    double returned[3], stored[3], springback[3];
    for (int k = 0; k < 3; k++) {
        const struct unloading one = unload(normal, "loading.unload_time=60 us", seed[k]);
        returned[k] = one.returned / one.stored;
        g_assert_cmpfloat_with_epsilon(returned[k], 1.0, 0.015);
        stored[k] = one.stored / one.work;
        springback[k] = one.springback;
    }
    return (struct unloading_shares){gsl_stats_median(returned, 1, 3),
                                     gsl_stats_median(stored, 1, 3),
                                     gsl_stats_median(springback, 1, 3)};
}

/* Smooth elastic spheres give back all that they store, plastic contacts keep their
 * part. */
static void test_work(void)
{
    const struct unloading_shares hertz = unload_three("contact.normal=hertz");
    const struct unloading_shares plastic = unload_three("contact.normal=storakers");
    g_assert_cmpfloat_with_epsilon(hertz.returned, 1.0, 0.004);
    g_assert_cmpfloat_with_epsilon(plastic.returned, 1.0, 0.004);
    g_assert_cmpfloat(plastic.stored, <, 0.95 * hertz.stored);
    g_assert_cmpfloat(plastic.springback, <, hertz.springback);
}

/* The friction that a wall exerts on a bed, at most the given one, over that; and floor over
 * punch. */
static double press_on_wall(double mu_wall, int seed, double *floor_over_punch)
{
    char friction[64], which[64];
    snprintf(friction, sizeof friction, "contact.mu_wall=%g", mu_wall);
    snprintf(which, sizeof which, "structure.seed=%d", seed);
    const struct gb_params params =
        die_params(friction, which, "contact.mu=0.5", "loading.time=100 us", NULL);
    struct cycle cycle = run(&params, 1000);
    const struct gb_point *load = end_of(&cycle, GB_BRANCH_LOAD);
    const double ratio = load->floor_over_punch;
    const double area = M_PI * params.die_diameter_m * load->height_m;
    const double exerted = -load->wall_friction_n / (load->wall_pa * area);
    const double axial = load->p_pa * (ratio - 1.0) / log(ratio);
    const double power =
        4.0 * load->wall_pa / axial * load->height_m / params.die_diameter_m;
    g_test_message("%s, %s: exerted %.4f; floor over punch %.4f, Janssen %.4f, with all "
                   "of the friction %.4f",
                   friction, which, exerted, ratio, exp(-exerted * power),
                   exp(-mu_wall * power));
    g_assert_cmpfloat_with_epsilon(ratio, exp(-exerted * power), 0.01);
    g_assert_cmpfloat(exerted, >, 0.6 * mu_wall);
    g_assert_cmpfloat(exerted, <, 0.95 * mu_wall);
    g_string_free(cycle.events, TRUE);
    *floor_over_punch = ratio;
    return exerted / mu_wall;
}

/* All of it is exerted where powder has slid far enough: 0.8 of it in the mean of beds of 150 spheres,
 * which scatter by 0.05, alike in steps of 0.25 to 0.9 of the critical one. */
static void test_janssen(void)
{
    enum { BEDS = 6 };
    static const double mu_wall[] = {0.05, 0.1, 0.2};
    double last = 1.0;
    for (size_t k = 0; k < G_N_ELEMENTS(mu_wall); k++) {
        double mean = 0.0, share = 0.0, ratio = 0.0;
        for (int seed = 1; seed <= BEDS; seed++) {
            share += press_on_wall(mu_wall[k], seed, &ratio) / BEDS;
            mean += ratio / BEDS;
        }
        g_test_message("mu_wall %g: %.3f of it", mu_wall[k], share);
        g_assert_cmpfloat_with_epsilon(share, 0.82, 0.08);
        g_assert_cmpfloat(mean, <, last);
        last = mean;
    }
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/cycle/stages", test_stages);
    g_test_add_func("/cycle/press_alone", test_press_alone);
    g_test_add_func("/cycle/without_welds", test_without_welds);
    g_test_add_func("/cycle/resume", test_resume);
    g_test_add_func("/cycle/fault", test_fault);
    if (g_test_slow()) {
        g_test_add_func("/cycle/slow/work", test_work);
        g_test_add_func("/cycle/slow/janssen", test_janssen);
    }
    return g_test_run();
}
