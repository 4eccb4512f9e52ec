#include "tui/session.h"

#include <glib.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "tui/costly.h"

void gb_session_init(struct gb_session *session, struct gb_preset *preset)
{
    memset(session, 0, sizeof *session);
    session->preset = preset;
    session->now.seconds_left = -1.0;
}

static void drop_earlier(struct gb_earlier *earlier)
{
    gb_alloc_free(earlier->density);
    gb_alloc_free(earlier->pressure_pa);
    gb_alloc_free(earlier->elapsed);
    memset(earlier, 0, sizeof *earlier);
}

void gb_session_finish(struct gb_session *session)
{
    gb_runner_destroy(session->runner);
    for (int i = 0; i < session->earlier_count; i++) {
        drop_earlier(&session->earlier[i]);
    }
    gb_preset_destroy(session->opened);
    session->runner = NULL;
    session->opened = NULL;
}

struct gb_params *gb_session_params(struct gb_session *session)
{
    return gb_preset_params(session->preset);
}

void gb_session_note(struct gb_session *session, const char *format, ...)
{
    char text[GB_SNAPSHOT_EVENT];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    char *line = session->log[session->log_count % GB_SESSION_LOG];
    snprintf(line, sizeof session->log[0], "%.1f s: %s", session->now.seconds, text);
    session->log_count++;
}

const char *gb_session_line(const struct gb_session *session, int index)
{
    const int64_t at = session->log_count - 1 - index;
    if (index < 0 || at < 0 || index >= GB_SESSION_LOG) {
        return NULL;
    }
    return session->log[at % GB_SESSION_LOG];
}

double gb_session_elapsed(int kind, const struct gb_point *point)
{
    return kind == GB_KIND_DYNAMIC ? 1e9 * point->time_s : (double)point->step;
}

/* The branches of a curve one after the other, NaN between them. */
static void copy_branches(struct gb_earlier *earlier, const struct gb_curve *curve,
                          size_t count)
{
    int branch = 0;
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        const struct gb_point *point = gb_curve_at(curve, i);
        if (i > 0 && point->branch != branch && (point->branch > 0 || branch > 0)) {
            earlier->density[n] = NAN;
            earlier->elapsed[n] = NAN;
            earlier->pressure_pa[n++] = NAN;
        }
        branch = point->branch;
        earlier->density[n] = point->density;
        earlier->elapsed[n] = gb_session_elapsed(earlier->params.kind, point);
        earlier->pressure_pa[n++] = point->p_pa;
    }
    earlier->count = n;
}

/* Keeps the curve of the run that is about to be replaced.  A run without points is not
 * worth a place; without memory it is forgotten. */
static void keep_run(struct gb_session *session)
{
    const struct gb_curve *curve = gb_runner_curve(session->runner);
    const size_t count = gb_curve_count(curve);
    if (count < 2) {
        return;
    }
    if (session->earlier_count == GB_SESSION_EARLIER) {
        drop_earlier(&session->earlier[0]);
        memmove(session->earlier, session->earlier + 1,
                (GB_SESSION_EARLIER - 1) * sizeof session->earlier[0]);
        session->earlier_count--;
    }
    struct gb_earlier *earlier = &session->earlier[session->earlier_count];
    memset(earlier, 0, sizeof *earlier);
    earlier->params = *gb_runner_params(session->runner);
    earlier->letter = (char)('a' + (session->runs - 1) % 26);
    earlier->density = gb_alloc_array(2 * count, sizeof(double), NULL);
    earlier->pressure_pa = gb_alloc_array(2 * count, sizeof(double), NULL);
    earlier->elapsed = gb_alloc_array(2 * count, sizeof(double), NULL);
    if (earlier->density == NULL || earlier->pressure_pa == NULL ||
        earlier->elapsed == NULL) {
        drop_earlier(earlier);
        return;
    }
    copy_branches(earlier, curve, count);
    session->earlier_count++;
}

static bool same_value(const struct gb_params *a, const struct gb_params *b,
                       const struct gb_field *field)
{
    char one[256];
    char other[256];
    gb_params_format(a, field, one, sizeof one);
    gb_params_format(b, field, other, sizeof other);
    return strcmp(one, other) == 0;
}

/* "mu 0.1, alpha 0.24": what tells an earlier run from the one under way. */
static void describe(struct gb_earlier *earlier, const struct gb_params *now)
{
    size_t count = 0;
    const struct gb_field *field = gb_params_fields(&count);
    GString *text = g_string_new(NULL);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(field[i].key, "title") != 0 &&
            !same_value(&earlier->params, now, &field[i])) {
            char value[256];
            gb_params_format(&earlier->params, &field[i], value, sizeof value);
            g_string_append_printf(text, "%s%s %s", text->len > 0 ? ", " : "",
                                   field[i].key, value);
        }
    }
    g_strlcpy(earlier->difference, text->len > 0 ? text->str : "same parameters",
              sizeof earlier->difference);
    g_string_free(text, TRUE);
}

bool gb_session_costly(struct gb_session *session, char *text, size_t size)
{
    return gb_costly_question(gb_session_params(session), session->particle_steps_per_s,
                              text, size);
}

bool gb_session_start(struct gb_session *session, struct gb_error *err)
{
    const struct gb_params *params = gb_session_params(session);
    struct gb_runner *runner = NULL;
    if (!gb_runner_create(&runner, params, err)) {
        return false;
    }
    if (session->runner != NULL) {
        keep_run(session);
        gb_runner_destroy(session->runner);
    }
    session->runner = runner;
    session->runs++;
    session->frozen = false;
    session->pause_wanted = false;
    session->waiting = false;
    session->engine = GB_RUN_PACKING;
    session->points = 0;
    session->events_seen = 0;
    memset(&session->now, 0, sizeof session->now);
    session->now.seconds_left = -1.0;
    for (int i = 0; i < session->earlier_count; i++) {
        describe(&session->earlier[i], params);
    }
    gb_session_note(session, "run %d started", session->runs);
    return true;
}

bool gb_session_open(struct gb_session *session, const char *name, struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    if (!gb_preset_load(&preset, name, err)) {
        return false;
    }
    gb_preset_destroy(session->opened);
    session->opened = preset;
    session->preset = preset;
    return true;
}

static void take_events(struct gb_session *session)
{
    char text[GB_SNAPSHOT_EVENT];
    while (session->events_seen < session->now.events) {
        if (gb_runner_event(session->runner, session->events_seen, text, sizeof text)) {
            gb_session_note(session, "%s", text);
        }
        session->events_seen++;
    }
}

/* The newest snapshot becomes what the screen shows. */
static void show(struct gb_session *session, const struct gb_snapshot *snapshot)
{
    session->now = *snapshot;
    session->points = gb_curve_count(gb_runner_curve(session->runner));
    take_events(session);
}

/* What the next run is foretold by. */
static void take_rate(struct gb_session *session, const struct gb_snapshot *snapshot)
{
    if (gb_runner_params(session->runner)->kind == GB_KIND_DYNAMIC &&
        snapshot->particle_evaluations_per_s > 0.0) {
        session->particle_steps_per_s = snapshot->particle_evaluations_per_s;
    }
}

bool gb_session_refresh(struct gb_session *session)
{
    if (session->runner == NULL) {
        return false;
    }
    bool changed = false;
    const struct gb_snapshot *snapshot = gb_runner_snapshot(session->runner, &changed);
    take_rate(session, snapshot);
    const bool other_state = snapshot->state != session->engine;
    if (other_state) {
        session->engine = snapshot->state;
        session->waiting = false;
    }
    if (changed && !session->frozen) {
        show(session, snapshot);
        return true;
    }
    return other_state;
}

void gb_session_toggle_pause(struct gb_session *session)
{
    if (!gb_session_live(session)) {
        return;
    }
    const bool wanted = !session->pause_wanted;
    if (gb_runner_send(session->runner, wanted ? GB_COMMAND_PAUSE : GB_COMMAND_RESUME)) {
        session->pause_wanted = wanted;
        session->waiting = true;
    }
}

void gb_session_toggle_freeze(struct gb_session *session)
{
    session->frozen = !session->frozen;
    if (!session->frozen && session->runner != NULL) {
        show(session, gb_runner_snapshot(session->runner, NULL));
    }
}

bool gb_session_live(const struct gb_session *session)
{
    return session->runner != NULL && session->engine <= GB_RUN_PAUSED;
}

bool gb_session_busy(const struct gb_session *session)
{
    return session->runner != NULL &&
           (session->engine <= GB_RUN_RUNNING || session->waiting);
}

bool gb_session_differs(struct gb_session *session, const struct gb_field *field)
{
    return session->runner != NULL &&
           !same_value(gb_session_params(session), gb_runner_params(session->runner),
                       field);
}

int gb_session_changes(struct gb_session *session)
{
    size_t count = 0;
    int changes = 0;
    const struct gb_field *field = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        changes += gb_session_differs(session, &field[i]);
    }
    return changes;
}
