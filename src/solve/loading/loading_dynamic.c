/* The mode `dynamic`: a periodic cell compressed at a rate, solve/loading/dynamic.h. */
#include "solve/loading/dynamic.h"
#include "solve/loading/loading.h"
#include "solve/loading/loading_cell.h"

struct dynamic_loading {
    struct gb_loading base;
    struct gb_dynamic *motion;
};

static struct dynamic_loading *own(struct gb_loading *loading)
{
    return (struct dynamic_loading *)(void *)loading;
}

static const struct gb_dynamic *motion_of(const struct gb_loading *loading)
{
    return ((const struct dynamic_loading *)(const void *)loading)->motion;
}

static bool build(struct gb_loading *loading, bool (*cancelled)(void *data), void *data,
                  struct gb_error *err)
{
    return gb_loading_cell_grow(loading, cancelled, data, err) &&
           gb_dynamic_create(&own(loading)->motion, loading->world, err);
}

static bool build_from(struct gb_loading *loading, struct gb_record *record,
                       struct gb_error *err)
{
    return gb_loading_cell_load(loading, record, err) &&
           gb_dynamic_create(&own(loading)->motion, loading->world, err);
}

static void finish(struct gb_loading *loading)
{
    gb_dynamic_destroy(own(loading)->motion);
}

static enum gb_step_outcome advance(struct gb_loading *loading, int64_t max_evaluations,
                                    struct gb_event_queue *events, struct gb_error *err)
{
    char text[GB_EVENT_TEXT];
    const enum gb_step_outcome outcome = gb_dynamic_advance(
        own(loading)->motion, loading->world, max_evaluations, text, sizeof text, err);
    gb_event_queue_add(events, text);
    return outcome;
}

/* The next steps are planned when they begin. */
static enum gb_step_outcome after_point(struct gb_loading *loading,
                                        struct gb_event_queue *events,
                                        struct gb_error *err)
{
    (void)loading;
    (void)events;
    (void)err;
    return GB_STEP_MORE;
}

static bool record_motion(struct gb_loading *loading, struct gb_record *record,
                          struct gb_error *err)
{
    return gb_dynamic_record(own(loading)->motion, record, err);
}

static struct gb_loading_report report(const struct gb_loading *loading)
{
    static const enum gb_loading_stage stages[] = {
        [GB_DYNAMIC_RELAX] = GB_LOADING_RELAX,
        [GB_DYNAMIC_LOAD] = GB_LOADING_LOAD,
        [GB_DYNAMIC_HOLD] = GB_LOADING_HOLD,
        [GB_DYNAMIC_OVER] = GB_LOADING_HOLD,
    };
    const struct gb_dynamic_report motion = gb_dynamic_report(motion_of(loading));
    struct gb_loading_report report = gb_loading_empty_report();
    report.stage = stages[motion.stage];
    report.iterations = report.evaluations = motion.steps;
    report.residual = gb_world_residual(loading->world);
    report.time_step = motion.time_step;
    report.time = motion.time;
    report.kinetic = motion.kinetic;
    report.work = motion.work;
    report.absorbed = motion.absorbed;
    return report;
}

static const struct gb_verlet *verlet(const struct gb_loading *loading)
{
    return gb_dynamic_verlet(motion_of(loading));
}

static double progress(const struct gb_loading *loading, double pressure, double density)
{
    (void)pressure;
    (void)density;
    return gb_dynamic_report(motion_of(loading)).progress;
}

const struct gb_loading_mode gb_loading_dynamic = {
    .size = sizeof(struct dynamic_loading),
    .build = build,
    .build_from = build_from,
    .finish = finish,
    .advance = advance,
    .after_point = after_point,
    .record = record_motion,
    .report = report,
    .motion = verlet,
    .progress = progress,
};
