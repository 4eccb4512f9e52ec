#include "study/yield/yield_cell.h"

#include <math.h>
#include <string.h>

#include "study/compact/cells.h"
#include "study/compact/offset_probe.h"
#include "study/yield/yield_options.h"

/* Plastic strain at which the flow has been measured, in offsets. */
static const double flow_end = 1.5;

/* A cell at work. */
struct cell {
    struct gb_yield_options options;
    struct gb_keep_point mark;
    const struct gb_pool_callbacks *callbacks;
    struct gb_compact top, inside;
    struct gb_compact_elastic elastic;
    struct gb_yield_point chosen[GB_YIELD_DIRECTIONS_MAX]; /* at the chosen offset */
    GString *points, *paths;
};

static void add_number(GString *text, double value)
{
    g_string_append_c(text, ',');
    if (isfinite(value)) {
        g_string_append_printf(text, "%.10g", value);
    }
}

/* Index of the direction and of the offset, state of the compact, the point. */
static void add_point(struct cell *cell, int direction, int offset,
                      const struct gb_offset_probe *probe)
{
    const double none = (double)NAN;
    const double size = gb_yield_options_offset[offset] * cell->options.offset;
    struct gb_yield_point point = {
        .p_pa = none, .q_pa = none, .flow_volume = none, .flow_shear = none};
    const struct gb_compact_state top = gb_compact_state_of(&cell->top.point);
    gb_offset_probe_point(probe, size, flow_end, &point);
    if (offset == GB_YIELD_OFFSET_CHOSEN) {
        cell->chosen[direction] = point;
        cell->chosen[direction].density = cell->top.point.density;
        cell->chosen[direction].direction =
            gb_yield_options_direction(&cell->options, direction);
    }
    g_string_append_printf(cell->points, "%d,%d", direction, offset);
    const double number[] = {
        cell->top.point.density, top.p,           top.q, point.p_pa, point.q_pa,
        point.flow_volume,       point.flow_shear};
    for (size_t i = 0; i < G_N_ELEMENTS(number); i++) {
        add_number(cell->points, number[i]);
    }
    g_string_append_c(cell->points, '\n');
}

static void add_path(struct cell *cell, int direction,
                     const struct gb_offset_probe *probe)
{
    if (probe->outcome == GB_COMPACT_STOPPED) {
        g_string_append_printf(cell->paths, "# direction %d stopped: %s\n", direction,
                               probe->why.text);
    }
    for (guint i = 0; i < probe->state->len; i++) {
        const struct gb_compact_state *state =
            &g_array_index(probe->state, struct gb_compact_state, i);
        g_string_append_printf(cell->paths, "%d,%.9g,%.9g,%.9g,%.9g\n", direction,
                               1e-6 * state->p, 1e-6 * state->q, state->volume,
                               state->shear);
    }
}

static bool probe_one(struct cell *cell, int direction, struct gb_error *err)
{
    struct gb_offset_probe probe = {0};
    /* the largest offset, with the rest of the way over which its flow is measured */
    const struct gb_offset_probe_steps steps = {
        .step = cell->options.step,
        .strain_most = cell->options.strain_most,
        .enough = flow_end * cell->options.offset *
                  gb_yield_options_offset[GB_YIELD_OFFSETS - 1]};
    const bool good = gb_offset_probe_run(
        &probe, &cell->inside, gb_yield_options_direction(&cell->options, direction),
        &cell->elastic.plane, &steps, cell->callbacks, err);
    for (int i = 0; i < GB_YIELD_OFFSETS && good; i++) {
        add_point(cell, direction, i, &probe);
    }
    if (good) {
        add_path(cell, direction, &probe);
    }
    gb_offset_probe_finish(&probe);
    return good;
}

static bool probe_all(struct cell *cell, struct gb_error *err)
{
    g_string_append(cell->points, "direction,offset,density,top_p_Pa,top_q_Pa,p_Pa,q_Pa,"
                                  "flow_volume,flow_shear\n");
    g_string_append(cell->paths, "direction,p_MPa,q_MPa,volume,shear\n");
    for (int i = 0; i < cell->options.directions; i++) {
        if (!probe_one(cell, i, err)) {
            return false;
        }
    }
    return true;
}

static bool measure(struct cell *cell, const struct gb_params *params,
                    struct gb_error *err)
{
    if (!gb_compact_press(&cell->top, params, &cell->mark, cell->callbacks, err)) {
        return false;
    }
    cell->top.tolerance = cell->options.tolerance;
    const double pressure =
        cell->options.inside * gb_compact_state_of(&cell->top.point).p;
    return gb_compact_unload(&cell->top, pressure, cell->callbacks, &cell->inside, err) &&
           gb_compact_elastic(&cell->elastic, &cell->inside, cell->callbacks, err) &&
           probe_all(cell, err);
}

static void cell_init(struct cell *cell, const struct gb_pool_callbacks *callbacks)
{
    *cell = (struct cell){.callbacks = callbacks,
                          .points = g_string_new(NULL),
                          .paths = g_string_new(NULL)};
}

static void cell_finish(struct cell *cell)
{
    gb_compact_finish(&cell->inside);
    gb_compact_finish(&cell->top);
    g_string_free(cell->points, TRUE);
    g_string_free(cell->paths, TRUE);
}

bool gb_yield_cell_measure(struct gb_yield_point point[GB_YIELD_DIRECTIONS_MAX],
                           double top_pa[2], const struct gb_params *params,
                           const struct gb_keep_point *mark,
                           const struct gb_yield_options *options,
                           const struct gb_pool_callbacks *callbacks,
                           struct gb_error *err)
{
    struct cell cell;
    cell_init(&cell, callbacks);
    cell.options = *options;
    cell.mark = *mark;
    const bool good = measure(&cell, params, err);
    const struct gb_compact_state top = gb_compact_state_of(&cell.top.point);
    memcpy(point, cell.chosen, sizeof cell.chosen);
    top_pa[0] = top.p;
    top_pa[1] = top.q;
    cell_finish(&cell);
    return good;
}

bool gb_yield_cell_work(const struct gb_params *params, const char *path,
                        const struct gb_pool_callbacks *callbacks, struct gb_error *err)
{
    GKeyFile *question = NULL;
    struct cell cell;
    struct gb_lock lock;
    if (!gb_cells_question(&question, &lock, path, err)) {
        return false;
    }
    cell_init(&cell, callbacks);
    gb_yield_options_read(&cell.options, &cell.mark, question);
    g_key_file_free(question);
    const bool good = measure(&cell, params, err) &&
                      gb_cells_answer(path, ".paths.csv", cell.paths, err) &&
                      gb_cells_answer(path, ".csv", cell.points, err);
    cell_finish(&cell);
    gb_lock_release(&lock);
    return good;
}
