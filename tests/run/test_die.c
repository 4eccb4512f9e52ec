#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "common/die.h"
#include "pack/die/bed_record.h"
#include "run/checkpoint.h"
#include "run/experiment.h"
#include "run/experiment_private.h"
#include "scene/tolerances.h"

enum { POINTS_MOST = 64 };

struct curve {
    struct gb_point point[POINTS_MOST];
    int count;
    GString *events;
    enum gb_step_outcome how;
    struct gb_error err;
    uint64_t hash, filled; /* at the end, and when pressing began */
};

static void take_events(struct gb_experiment *experiment, GString *events)
{
    char text[GB_EVENT_TEXT];
    while (gb_experiment_event(experiment, NULL, text, sizeof text)) {
        g_string_append_printf(events, "%s\n", text);
    }
}

/* Runs to the end in slices of a given length. */
static struct curve run(const struct gb_params *params, int64_t slice)
{
    struct curve curve = {.events = g_string_new(NULL)};
    struct gb_experiment *experiment = NULL;
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &curve.err)) {
        g_error("%s", curve.err.text);
    }
    do {
        curve.how = gb_experiment_advance(experiment, slice, &curve.err);
        take_events(experiment, curve.events);
        if (curve.how == GB_STEP_POINT) {
            g_assert_cmpint(curve.count, <, POINTS_MOST);
            curve.filled = curve.count == 0 ? gb_bed_record_hash(experiment->loading->bed)
                                            : curve.filled;
            curve.point[curve.count++] = *gb_experiment_point(experiment);
        }
    } while (curve.how == GB_STEP_MORE || curve.how == GB_STEP_POINT);
    curve.hash = gb_bed_record_hash(experiment->loading->bed);
    gb_experiment_destroy(experiment);
    return curve;
}

static void finish(struct curve *curve)
{
    g_string_free(curve->events, TRUE);
}

/* Poured, settled, flattened, pressed: the whole experiment in small. */
static void test_whole(void)
{
    const struct gb_params params = die_params(NULL);
    struct curve curve = run(&params, 1000);
    g_assert_cmpint(curve.how, ==, GB_STEP_DONE);
    g_assert_cmpint(curve.count, ==, 11);
    const struct gb_point *point = curve.point;
    g_assert_cmpint(point[0].branch, ==, GB_BRANCH_RELAX);
    g_assert_cmpfloat(point[0].density, >, 0.45);
    g_assert_cmpfloat(point[0].density, <, 0.65);
    g_assert_cmpfloat(point[0].height_change, ==, 0.0);
    for (int i = 1; i < curve.count; i++) {
        g_assert_cmpint(point[i].branch, ==, GB_BRANCH_LOAD);
        g_assert_cmpint(point[i].step, ==, i);
        g_assert_cmpfloat(point[i].density, >, point[i - 1].density);
        g_assert_cmpfloat(point[i].height_change, <, point[i - 1].height_change);
        g_assert_cmpfloat_with_epsilon(1e-6 * point[i].target_pa, 5.0 * i, 0.02);
        g_assert_cmpfloat_with_epsilon(point[i].p_pa / point[i].target_pa, 1.0, 0.01);
        g_assert_cmpfloat_with_epsilon(point[i].floor_over_punch, 1.0, 0.05);
        g_assert_cmpfloat(point[i].px_pa, >, 0.1 * point[i].p_pa);
        g_assert_cmpfloat(point[i].px_pa, <, 1.2 * point[i].p_pa);
        g_assert_cmpfloat(point[i].central, >, point[i].density);
    }
    g_assert_cmpfloat(point[10].coordination, >, 3.0);
    finish(&curve);
}

/* Slices of other lengths give the same bits; every law presses the same bed. */
static void test_same_bits(void)
{
    const struct gb_params hertz = die_params("loading.until=10 MPa", NULL);
    const struct gb_params plastic =
        die_params("loading.until=10 MPa", "contact.normal=storakers",
                   "material.hardening=0.2", "contact.mu=0.05", NULL);
    struct curve a = run(&hertz, 1000), b = run(&hertz, 77), c = run(&plastic, 500);
    g_assert_true(a.hash == b.hash);
    g_assert_true(a.hash != c.hash);
    g_assert_cmpfloat(a.point[0].density, ==, c.point[0].density);
    g_assert_cmpfloat(a.point[0].central, ==, c.point[0].central);
    g_assert_true(a.filled == b.filled);
    finish(&a);
    finish(&b);
    finish(&c);
}

/* Nothing falls through an outlet between one and two of the largest spheres for long. */
static void test_clogged(void)
{
    const struct gb_params params =
        die_params("die.outlet=7.5 um", "die.angle=60", "particles.count=300", NULL);
    struct curve curve = run(&params, 1000);
    g_assert_cmpint(curve.how, ==, GB_STEP_STOPPED);
    g_assert_cmpint(curve.err.code, ==, GB_ERR_GUARD);
    g_assert_nonnull(strstr(curve.err.text, "clogged"));
    finish(&curve);
}

/* A step far above the critical one: halved until it holds, told, and no worse curve. */
static void test_step_above_critical(void)
{
    const struct gb_params wild =
        die_params("loading.until=20 MPa", "numerics.time_step=3 ns", NULL);
    const struct gb_params good = die_params("loading.until=20 MPa", NULL);
    struct curve a = run(&wild, 1000), b = run(&good, 1000);
    g_assert_cmpint(a.how, ==, GB_STEP_DONE);
    g_assert_nonnull(strstr(a.events->str, "time step"));
    g_assert_cmpfloat_with_epsilon(a.point[a.count - 1].density,
                                   b.point[b.count - 1].density, 0.02);
    finish(&a);
    finish(&b);
}

/* Hand-made faults: each is told in one line, and the way back is taken. */
static void check_fault(int64_t steps, void (*spoil)(struct gb_bed *bed),
                        const char *word)
{
    struct gb_error err = {0};
    const struct gb_params params = die_params(NULL);
    struct gb_experiment *experiment = NULL;
    GString *events = g_string_new(NULL);
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    while (gb_experiment_advance(experiment, 1000, &err) != GB_STEP_POINT) {
    }
    g_assert_cmpint(gb_experiment_advance(experiment, steps, &err), ==, GB_STEP_MORE);
    take_events(experiment, events);
    g_string_truncate(events, 0);
    spoil(experiment->loading->bed);
    while (gb_experiment_advance(experiment, 1000, &err) == GB_STEP_MORE) {
    }
    take_events(experiment, events);
    g_test_message("expected \"%s\" in: %s", word, events->str);
    g_assert_nonnull(strstr(events->str, word));
    g_assert_nonnull(strstr(events->str, "guard: "));
    g_assert_cmpint(gb_bed_escaped(experiment->loading->bed), ==, -1);
    g_assert_cmpfloat(gb_experiment_point(experiment)->density, >, 0.4);
    g_string_free(events, TRUE);
    gb_experiment_destroy(experiment);
}

static void spoil_number(struct gb_bed *bed)
{
    bed->position[11][1] = NAN;
    gb_bed_invalidate_lists(
        bed); /* found by the next build, or else by a check for escapes */
}

static void spoil_escape(struct gb_bed *bed)
{
    int64_t heaviest = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        heaviest = bed->mass[i] > bed->mass[heaviest] ? i : heaviest;
    }
    bed->position[heaviest][0] = 2.0 * bed->die.radius;
}

static void spoil_punch(struct gb_bed *bed)
{
    bed->die.punch_position = 0.5 * bed->die.punch_position;
}

static void test_faults(void)
{
    /* an escape just before a check: the wall throws the sphere through the powder, and the
     * powder at the punch */
    const int64_t check = 4 * GB_ESCAPE_CHECK_STEPS;
    check_fault(check - 8, spoil_number,
                "must be finite with a radius of at least 0: position (");
    check_fault(check - 1, spoil_escape, "left the die");
    check_fault(check - 8, spoil_punch, "punch is below");
}

/* Time steps to a point some steps behind a check for escapes, which are counted from the
 * first point on. */
static int64_t steps_to_point(const struct gb_params *params)
{
    struct gb_error err = {0};
    struct gb_experiment *experiment = NULL;
    g_assert_true(gb_experiment_create(&experiment, params, NULL, NULL, &err));
    int64_t steps = 0, first = 0, behind = 0;
    for (int points = 0; points < 3 || behind < 1 || behind > GB_ESCAPE_CHECK_STEPS / 2;
         points++) {
        enum gb_step_outcome outcome = GB_STEP_MORE;
        while (outcome == GB_STEP_MORE) {
            outcome = gb_experiment_advance(experiment, 1, &err);
            steps++;
        }
        g_assert_cmpint(outcome, ==, GB_STEP_POINT); /* not its end */
        first = points == 0 ? steps : first;
        behind = (steps - first) % GB_ESCAPE_CHECK_STEPS;
    }
    gb_experiment_destroy(experiment);
    return steps;
}

/* No point is recorded with a particle outside, also where the lists, which a resumed run
 * builds at other steps, are not built anew.  Its contacts shorten the time step: the point
 * is due a few steps later. */
static void test_escape_at_point(void)
{
    struct gb_error err = {0};
    const struct gb_params params = die_params(NULL);
    struct gb_experiment *experiment = NULL;
    GString *events = g_string_new(NULL);
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    for (int64_t left = steps_to_point(&params) - 1; left > 0; left--) {
        gb_experiment_advance(experiment, 1, &err);
    }
    take_events(experiment, events);
    g_string_truncate(events, 0);
    struct gb_bed *bed = experiment->loading->bed;
    const int64_t rebuilds = bed->rebuilds;
    for (int k = 0; k < GB_ESCAPE_CHECK_STEPS / 2 - 1 && events->len == 0; k++) {
        const double fall = bed->position[11][2] + 1e-3;
        bed->position[11][2] -= fall;
        bed->listed_position[11][2] -= fall;
        bed->built_position[11][2] -= fall;
        bed->velocity[11][2] = 0.0;
        g_assert_cmpint(gb_experiment_advance(experiment, 1, &err), ==, GB_STEP_MORE);
        take_events(experiment, events);
    }
    g_assert_cmpint(bed->rebuilds, ==, rebuilds);
    g_assert_nonnull(strstr(events->str, "left the die"));
    g_assert_cmpint(gb_bed_escaped(bed), ==, -1);
    g_string_free(events, TRUE);
    gb_experiment_destroy(experiment);
}

static int64_t highest(const struct gb_bed *bed)
{
    int64_t best = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        const double *x = bed->position[i], *y = bed->position[best];
        best = x[2] + x[3] > y[2] + y[3] ? i : best;
    }
    return best;
}

/* One small sphere high above the others is too light to be seen in any mean.  It has to
 * land before the powder is flattened and its height taken. */
static void test_straggler(void)
{
    struct gb_error err = {0};
    const struct gb_params params =
        die_params("particles.table=number: 2 um 0.1; 5 um 0.7; 7 um 0.2", NULL);
    struct gb_experiment *experiment = NULL;
    GString *events = g_string_new(NULL);
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    while (!strstr(events->str, "gravity eased")) {
        g_assert_cmpint(gb_experiment_advance(experiment, 1000, &err), ==, GB_STEP_MORE);
        take_events(experiment, events);
    }
    struct gb_bed *bed = experiment->loading->bed;
    int64_t small = 0;
    for (int64_t i = 0; i < bed->count; i++) {
        small = bed->mass[i] < bed->mass[small] ? i : small;
    }
    bed->position[small][2] = gb_bed_top(bed) + 6.0;
    gb_bed_invalidate_lists(bed);
    while (gb_experiment_advance(experiment, 1000, &err) == GB_STEP_MORE) {
    }
    const int64_t top = highest(bed);
    const double weight = bed->mass[top] * experiment->model->die.gravity;
    g_assert_cmpint(gb_experiment_point(experiment)->branch, ==, GB_BRANCH_RELAX);
    g_assert_cmpfloat(bed->force[top][2], >, 0.5 * weight);
    g_string_free(events, TRUE);
    gb_experiment_destroy(experiment);
}

/* What does not fit is refused before any work, naming the key. */
static void test_refused(void)
{
    static const struct {
        const char *assignment, *word;
    } cases[] = {
        {"particles.table=number: 5 um 0.5; 26 um 0.5", "die.diameter"},
        {"die.outlet=6 um", "die.outlet"},
        {"die.outlet=30 um", "die.outlet"},
        {"die.height=20 um", "particles.count"},
        {"die.central=26 um", "die.central"},
        {"die.gravity=300000", "die.gravity"},
        {"loading.geometry=uniaxial", "loading.geometry"},
        {"loading.until=density = 0.7", "loading.until"},
        {"contact.normal=rod", "contact.normal"},
        {"scene.dimension=2", "scene.dimension"},
        {"loading.unload_from=10 MPa", "loading.unload_from"},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        struct gb_error err = {0};
        struct gb_experiment *experiment = NULL;
        const struct gb_params params = die_params(cases[k].assignment, NULL);
        g_assert_false(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        if (!strstr(err.text, cases[k].word)) {
            g_error("%s: %s", cases[k].assignment, err.text);
        }
    }
}

/* The state for pictures: true sizes, inside their box. */
static void test_state(void)
{
    struct gb_error err = {0};
    const struct gb_params params = die_params("loading.until=5 MPa", NULL);
    struct gb_experiment *experiment = NULL;
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE || how == GB_STEP_POINT) {
        how = gb_experiment_advance(experiment, 5000, &err);
        struct gb_state *state = NULL;
        g_assert_true(gb_experiment_state(experiment, &state, &err));
        g_assert_cmpfloat_with_epsilon(state->die_radius, 2.5, 1e-12);
        for (int64_t i = 0; i < state->count; i++) {
            for (int k = 0; k < 3; k++) {
                g_assert_cmpfloat(state->position[3 * i + k], >, 0.0);
                g_assert_cmpfloat(state->position[3 * i + k], <, state->cell[k]);
            }
        }
        for (int64_t p = 0; p < state->pair_count; p++) {
            g_assert_cmpfloat(state->pair_normal[p], >=, 0.0);
        }
        gb_state_destroy(state);
    }
    g_assert_cmpint(how, ==, GB_STEP_DONE);
    gb_experiment_destroy(experiment);
}

static bool next_point(struct gb_experiment *experiment, int64_t moves)
{
    struct gb_error err = {0};
    enum gb_step_outcome how = GB_STEP_MORE;
    while (how == GB_STEP_MORE) {
        how = gb_experiment_advance(experiment, moves, &err);
    }
    if (how == GB_STEP_STOPPED) {
        g_error("%s", err.text);
    }
    return how == GB_STEP_POINT;
}

/* Stopped at each of its points and gone on from its record: the next point has the same bits
 * and records. */
static void check_resumed(const struct gb_params *params, int least)
{
    enum { POINTS = 16 };
    static struct gb_record record[POINTS], resumed;
    struct gb_experiment *whole = NULL, *second = NULL;
    struct gb_error err = {0};
    int points = 0;
    g_assert_true(gb_experiment_create(&whole, params, NULL, NULL, &err));
    while (next_point(whole, 1000)) {
        g_assert_cmpint(points, <, POINTS);
        g_assert_true(gb_checkpoint_take(whole, &record[points++], &err));
    }
    g_assert_cmpint(points, >=, least);
    for (int k = 0; k + 1 < points; k++) {
        int64_t row = 0;
        if (!gb_experiment_resume(&second, params, &record[k], &err)) {
            g_error("%s", err.text);
        }
        g_assert_true(next_point(second, 333));
        g_assert_true(gb_checkpoint_take(second, &resumed, &err));
        const char *different = gb_record_difference(&record[k + 1], &resumed, &row);
        if (different != NULL) {
            g_error("from point %d: %s: row %d differs", k, different, (int)row);
        }
        if (k + 2 == points) {
            g_assert_true(gb_bed_record_hash(whole->loading->bed) ==
                          gb_bed_record_hash(second->loading->bed));
        }
        gb_experiment_destroy(second);
    }
    gb_experiment_destroy(whole);
    gb_record_finish(&resumed);
    for (int k = 0; k < points; k++) {
        gb_record_finish(&record[k]);
    }
}

static void test_resume(void)
{
    const struct gb_params rough =
        die_params("loading.until=10 MPa", "contact.normal=storakers",
                   "material.hardening=0.1", "contact.mu=0.05", NULL);
    const struct gb_params few = die_params("particles.count=20", "loading.until=10 MPa",
                                            "loading.record_pressure=1 MPa", NULL);
    check_resumed(&rough, 3);
    check_resumed(&few, 11);
}

/* Steps of a stage, from its event; the events stand in the order of the stages. */
static int64_t steps_of(const GString *events, const char *stage, const char **from)
{
    double us = 0.0;
    int64_t steps = 0;
    char *form = g_strdup_printf("%s after %%lf us, %%" G_GINT64_FORMAT " steps", stage);
    const char *line = strstr(*from, stage);
    if (!line || sscanf(line, form, &us, &steps) != 2) {
        g_error("%s: no such event behind the others in\n%s", stage, events->str);
    }
    *from = line;
    g_free(form);
    return steps;
}

/* Powder is flattened under a raised gravity: that and the rest behind it take about as many
 * steps as pouring, not some times as many; it rests under the lower one when it is
 * pressed. */
static void test_filling_steps(void)
{
    struct gb_error err = {0};
    const struct gb_params params = die_params(NULL);
    struct gb_experiment *experiment = NULL;
    GString *events = g_string_new(NULL);
    g_assert_true(gb_experiment_create(&experiment, &params, NULL, NULL, &err));
    while (gb_experiment_advance(experiment, 1000, &err) != GB_STEP_POINT) {
    }
    take_events(experiment, events);
    const char *from = events->str;
    const int64_t poured = steps_of(events, "poured", &from);
    (void)steps_of(events, "gravity eased", &from);
    (void)steps_of(events, "settled", &from);
    const int64_t flattened = steps_of(events, "flattened", &from);
    const int64_t rest = steps_of(events, "at rest", &from);
    g_test_message("steps: poured %d, flattened %d, at rest %d", (int)poured,
                   (int)flattened, (int)rest);
    g_assert_cmpint(flattened + rest, <, poured + poured / 2);
    const struct gb_bed *bed = experiment->loading->bed;
    const double gravity = experiment->model->die.gravity;
    const double weight = gravity * gb_bed_solid_volume(bed) / (M_PI / 6.0);
    g_assert_cmpfloat(gb_bed_kinetic_energy(bed).translational, <, GB_REST_FALL * weight);
    g_string_free(events, TRUE);
    gb_experiment_destroy(experiment);
}

/* What a display is told of a run, slice by slice. */
struct told {
    bool seen[GB_STAGES];
    enum gb_stage stage;
    double progress, timed;
    int64_t poured;
};

static void check_stage(const struct gb_stage_report *now, const struct told *before)
{
    g_assert_cmpint(now->stage, >=, before->stage);
    g_assert_cmpint(now->measure, !=, GB_STAGE_MEASURE_NONE);
    g_assert_true(now->share >= 0.0 && now->share <= 1.0);
    g_assert_true(now->time_s >= 0.0 && now->kinetic_j >= 0.0 && now->height_m >= 0.0);
    g_assert_cmpint(now->poured, <=, 150);
    switch (now->stage) {
    case GB_STAGE_FILLING:
        g_assert_cmpfloat(now->goal, ==, 150.0);
        g_assert_cmpfloat(now->value, ==, (double)now->poured);
        break;
    case GB_STAGE_RESTING:
        g_assert_cmpfloat(now->goal, ==, 1.0);
        break;
    case GB_STAGE_FLATTENING:
        g_assert_cmpfloat(now->value, <, 1.01 * now->goal);
        break;
    case GB_STAGE_PRESS:
        g_assert_cmpint(now->measure, ==, GB_STAGE_MEASURE_PRESSURE);
        g_assert_cmpfloat_with_epsilon(now->goal, 50e6, 1.0);
        break;
    default:
        break;
    }
    /* The time left is estimated from pressing on alone; how far the punch is drawn off is known
     * when pressing has ended. */
    const double known = now->stage > before->stage ? 0.05 : 0.0;
    g_assert_true(now->stage >= GB_STAGE_PRESS ? now->timed >= before->timed - known
                                               : isnan(now->timed));
}

static struct told tell(const struct gb_params *params)
{
    struct told told = {.stage = GB_STAGE_NONE};
    static struct gb_snapshot shot;
    struct gb_error err = {0};
    struct gb_experiment *experiment = NULL;
    enum gb_step_outcome how = GB_STEP_MORE;
    if (!gb_experiment_create(&experiment, params, NULL, NULL, &err)) {
        g_error("%s", err.text);
    }
    while ((how = gb_experiment_advance(experiment, 1000, &err)) <= GB_STEP_POINT) {
        gb_experiment_observe(experiment, &shot);
        g_assert_cmpfloat(shot.progress, >=, told.progress - 1e-12);
        told.progress = shot.progress;
        if (shot.stage.stage != GB_STAGE_NONE) {
            check_stage(&shot.stage, &told);
            told.stage = shot.stage.stage;
            told.timed = told.stage < GB_STAGE_PRESS ? 0.0 : shot.stage.timed;
            told.seen[told.stage] = true;
            g_assert_cmpint(shot.stage.poured, >=, told.poured);
            told.poured = shot.stage.poured;
        }
    }
    g_assert_cmpint(how, ==, GB_STEP_DONE);
    gb_experiment_destroy(experiment);
    return told;
}

/* Every stage is told, in its order, with a measure of its own; progress never falls. */
static void test_stages(void)
{
    const struct gb_params params = die_params(NULL);
    const struct told told = tell(&params);
    for (int k = GB_STAGE_FILLING; k <= GB_STAGE_PRESS; k++) {
        g_assert_true(told.seen[k]);
    }
    g_assert_false(told.seen[GB_STAGE_UNLOADING]);
    g_assert_cmpint(told.poured, ==, 150);
    g_assert_cmpfloat(told.timed, >, 0.98);
    const struct gb_params whole = die_params("die.cycle=full", "loading.rest_time=4 us",
                                              "die.eject_speed=4 m/s", NULL);
    const struct told cycle = tell(&whole);
    for (int k = GB_STAGE_FILLING; k < GB_STAGES; k++) {
        g_assert_true(cycle.seen[k]);
    }
    g_assert_cmpfloat(cycle.timed, >, 0.98);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/die/whole", test_whole);
    g_test_add_func("/die/same_bits", test_same_bits);
    g_test_add_func("/die/stages", test_stages);
    g_test_add_func("/die/filling_steps", test_filling_steps);
    g_test_add_func("/die/clogged", test_clogged);
    g_test_add_func("/die/step_above_critical", test_step_above_critical);
    g_test_add_func("/die/faults", test_faults);
    g_test_add_func("/die/escape-at-point", test_escape_at_point);
    g_test_add_func("/die/straggler", test_straggler);
    g_test_add_func("/die/refused", test_refused);
    g_test_add_func("/die/state", test_state);
    g_test_add_func("/die/resume", test_resume);
    return g_test_run();
}
