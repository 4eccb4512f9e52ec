/* Dies at the ends of their parameters: no point without a meaning is recorded, and the end
 * says why. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "common/die.h"
#include "common/scene.h"
#include "scene/tolerances.h"
#include "solve/loading/loading.h"

enum { POINTS_MOST = 200 };

struct outcome {
    struct gb_loading_report point[POINTS_MOST];
    double density[POINTS_MOST];
    int count;
    enum gb_step_outcome how;
    struct gb_error err;
    bool missed;
    char goal[512];
    GString *events;
};

static void take_events(struct gb_event_queue *queue, GString *events)
{
    char text[GB_EVENT_TEXT];
    while (gb_event_queue_take(queue, NULL, text, sizeof text)) {
        g_string_append_printf(events, "%s\n", text);
    }
}

static double density_of(const struct gb_loading *loading, double height)
{
    const struct gb_bed *bed = loading->bed;
    return gb_bed_solid_volume(bed) / (M_PI * bed->die.radius * bed->die.radius * height);
}

/* To the end, whatever that is; disturb, unless NULL, may change the bed at every point. */
static struct outcome press(const struct gb_params *params,
                            void (*disturb)(struct gb_loading *loading, int point))
{
    const struct gb_model model = scene_model(params);
    struct outcome outcome = {.how = GB_STEP_MORE, .events = g_string_new(NULL)};
    struct gb_loading *loading = NULL;
    struct gb_event_queue queue = {0};
    g_assert_true(gb_loading_create(&loading, params, &model, NULL, NULL, &outcome.err));
    while (outcome.how == GB_STEP_MORE) {
        outcome.how = loading->mode->advance(loading, 1000, &queue, &outcome.err);
        if (outcome.how == GB_STEP_POINT) {
            const struct gb_loading_report point = loading->mode->report(loading);
            g_assert_cmpint(outcome.count, <, POINTS_MOST);
            outcome.density[outcome.count] = density_of(loading, point.height);
            outcome.point[outcome.count++] = point;
            outcome.how = loading->mode->after_point(loading, &queue, &outcome.err);
            if (disturb) {
                disturb(loading, outcome.count - 1);
            }
        }
        take_events(&queue, outcome.events);
    }
    outcome.missed = loading->mode->missed(loading, outcome.goal, sizeof outcome.goal);
    g_test_message("%d points; %s; %s", outcome.count, outcome.err.text,
                   outcome.missed ? outcome.goal : "");
    gb_loading_destroy(loading);
    return outcome;
}

static void finish(struct outcome *outcome)
{
    g_string_free(outcome->events, TRUE);
}

/* Every recorded density is one of powder with pores, no lower than poured. */
static void check_densities(const struct outcome *outcome)
{
    g_assert_cmpint(outcome->count, >, 0);
    for (int i = 0; i < outcome->count; i++) {
        g_assert_cmpfloat(outcome->density[i], <=, GB_DENSITY_MAX);
        g_assert_cmpfloat(outcome->density[i], >=,
                          outcome->density[0] / (1.0 + GB_PUNCH_RISE_MAX));
    }
}

/* Pressed beyond what pores are there for, by both laws. */
static void test_dense(void)
{
    static const char *const normals[] = {"contact.normal=hertz",
                                          "contact.normal=storakers"};
    for (size_t k = 0; k < G_N_ELEMENTS(normals); k++) {
        const struct gb_params params = die_params(
            "loading.until=200 GPa", "loading.record_pressure=500 MPa", normals[k], NULL);
        struct outcome outcome = press(&params, NULL);
        g_assert_cmpint(outcome.how, ==, GB_STEP_STOPPED);
        g_assert_cmpint(outcome.err.code, ==, GB_ERR_GUARD);
        g_assert_nonnull(strstr(outcome.err.text, "relative density"));
        g_assert_nonnull(strstr(outcome.err.text, "loading.until"));
        g_assert_cmpint(outcome.count, >, 1);
        check_densities(&outcome);
        finish(&outcome);
    }
}

/* A punch a thousandth of the powder: pressed with the steps that it needs, or the end. */
static void test_light_punch(void)
{
    const struct gb_params params =
        die_params("particles.count=60", "die.punch_mass=0.001",
                   "loading.record_pressure=500 kPa", NULL);
    struct outcome outcome = press(&params, NULL);
    check_densities(&outcome);
    g_assert_true(outcome.how == GB_STEP_STOPPED || outcome.how == GB_STEP_DONE);
    if (outcome.how == GB_STEP_STOPPED) {
        g_assert_cmpint(outcome.err.code, ==, GB_ERR_GUARD);
    } else {
        g_assert_true(outcome.missed ||
                      outcome.point[outcome.count - 1].pressure[2] >
                          0.95 * outcome.point[outcome.count - 1].target_pressure);
    }
    finish(&outcome);
}

/* A ramp of a few time steps: the punch has not come to the powder, which carries nothing
 * and is not said to. */
static void test_sudden(void)
{
    const struct gb_params params = die_params("loading.time=1 ns", NULL);
    struct outcome outcome = press(&params, NULL);
    g_assert_cmpint(outcome.how, ==, GB_STEP_DONE);
    g_assert_true(outcome.missed);
    g_assert_nonnull(strstr(outcome.events->str, "not quasi-static"));
    for (int i = 1; i < outcome.count; i++) {
        const struct gb_loading_report *point = &outcome.point[i];
        g_assert_cmpfloat(point->target_pressure, >, 0.0);
        g_assert_cmpfloat(fabs(point->pressure[2]), <, 0.01 * point->target_pressure);
        g_assert_cmpfloat(fabs(point->floor), <, 0.01 * point->target_pressure);
    }
    finish(&outcome);
}

/* A heavy punch is knocked up at the last point but one, at 5 m/s. */
static void knock(struct gb_loading *loading, int point)
{
    const struct gb_model *model = loading->model;
    if (point == 39) {
        loading->bed->die.punch_velocity =
            5.0 * model->die.second_per_time / model->metre_per_length;
    }
}

/* The pressure was carried nearly to the end, and not at the end.  A ramp of many vibrations of
 * this punch on the powder: the pressure then ends where it should. */
static void check_bounce(int seed)
{
    struct gb_params params =
        die_params("die.punch_mass=100", "loading.until=20 MPa",
                   "loading.record_pressure=500 kPa", "loading.time=100 us", NULL);
    params.seed = (uint64_t)seed;
    struct outcome calm = press(&params, NULL), outcome = press(&params, knock);
    g_assert_cmpint(calm.how, ==, GB_STEP_DONE);
    g_assert_false(calm.missed);
    g_assert_cmpint(outcome.how, ==, GB_STEP_DONE);
    g_assert_cmpint(outcome.count, ==, calm.count);
    g_assert_true(outcome.missed);
    g_assert_null(strstr(outcome.goal, "at most"));
    g_assert_cmpfloat(outcome.point[outcome.count - 1].pressure[2], <,
                      0.5 * calm.point[calm.count - 1].pressure[2]);
    finish(&calm);
    finish(&outcome);
}

static void test_bounce(void)
{
    for (int seed = 1; seed <= 4; seed++) {
        check_bounce(seed);
    }
}

/* The same punch is driven into the powder, which carries more than was asked for. */
static void shove(struct gb_loading *loading, int point)
{
    const struct gb_model *model = loading->model;
    if (point == 38) {
        loading->bed->die.punch_velocity =
            -0.5 * model->die.second_per_time / model->metre_per_length;
    }
}

/* Whether the present state says that forces on floor and punch are in equilibrium. */
static bool settles_last(const GString *events)
{
    const char *again = g_strrstr(events->str, "quasi-static again");
    return again != NULL && strstr(again, "not quasi-static") == NULL;
}

static void test_exceeded(void)
{
    const struct gb_params params =
        die_params("die.punch_mass=100", "loading.until=20 MPa",
                   "loading.record_pressure=500 kPa", "loading.time=100 us", NULL);
    struct outcome outcome = press(&params, shove);
    const struct gb_loading_report *last = &outcome.point[outcome.count - 1];
    g_assert_cmpint(outcome.how, ==, GB_STEP_DONE);
    g_assert_true(outcome.missed);
    g_assert_true(g_str_has_prefix(outcome.goal, "exceeded: loading.until = 20 MPa; the "
                                                 "powder carried up to "));
    g_assert_true(fabs(last->pressure[2] / last->target_pressure - 1.0) <=
                      GB_DIE_GOAL_TOLERANCE ||
                  !settles_last(outcome.events));
    finish(&outcome);
}

/* Contacts and walls without dissipation keep the poured powder moving. */
static void test_restless(void)
{
    const struct gb_params params =
        die_params("particles.count=20", "contact.damping=0", "contact.mu_wall=0", NULL);
    struct outcome outcome = press(&params, NULL);
    g_assert_cmpint(outcome.how, ==, GB_STEP_STOPPED);
    g_assert_cmpint(outcome.err.code, ==, GB_ERR_GUARD);
    g_assert_nonnull(strstr(outcome.err.text, "does not come to rest"));
    g_assert_cmpint(outcome.count, ==, 0);
    finish(&outcome);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/die/extremes/dense", test_dense);
    g_test_add_func("/die/extremes/light_punch", test_light_punch);
    g_test_add_func("/die/extremes/sudden", test_sudden);
    g_test_add_func("/die/extremes/bounce", test_bounce);
    g_test_add_func("/die/extremes/exceeded", test_exceeded);
    g_test_add_func("/die/extremes/restless", test_restless);
    return g_test_run();
}
