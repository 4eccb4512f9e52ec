#include "cli/output/bench_output.h"

#include <math.h>

#include "pack/kernel/simd.h"

static void add_row(struct gb_bench_output_rows *rows, const char *name, double value,
                    double spread, const char *unit, enum gb_bench_goal goal)
{
    if (isfinite(value)) {
        rows->row[rows->count++] = (struct gb_bench_row){name, value, spread, unit, goal};
    }
}

static void add_fact(struct gb_bench_output_rows *rows, const char *name, double value,
                     const char *unit)
{
    add_row(rows, name, value, 0.0, unit, GB_BENCH_FACT);
}

/* A time, s, in units that are `scale` s long. */
static void add_time(struct gb_bench_output_rows *rows, const char *name,
                     struct gb_bench_figure figure, double scale, const char *unit)
{
    const struct gb_bench_figure scaled = gb_bench_figure_scaled(figure, 1.0 / scale);
    add_row(rows, name, scaled.value, scaled.spread, unit, GB_BENCH_LESS);
}

static void add_cell(struct gb_bench_output_rows *rows, const struct gb_bench_cell *cell,
                     const char *one, const char *all)
{
    const double scale = 1e-6 * (double)cell->params.count;
    add_time(rows, one, cell->one, scale, "us per particle");
    add_time(rows, all, cell->all, scale, "us per particle");
}

static void add_state(struct gb_bench_output_rows *rows,
                      const struct gb_bench_state *state)
{
    const struct {
        const char *name;
        double seconds;
    } time[] = {{"checkpoint: engine blocked", state->held},
                {"checkpoint: processor time of writer", state->processor},
                {"checkpoint: time to write", state->written},
                {"checkpoint: of this the disk", state->disk}};
    add_fact(rows, "checkpoint", state->bytes_per_particle, "bytes per particle");
    for (size_t i = 0; i < G_N_ELEMENTS(time);
         i++) { /* a disk has no spread to rely on */
        add_fact(rows, time[i].name, 1e3 * time[i].seconds, "ms");
    }
}

static void add_scenes(struct gb_bench_output_rows *rows,
                       const struct gb_bench_output_figures *figures)
{
    const struct gb_bench_die *die = &figures->die;
    const struct gb_bench_figure planar = gb_bench_figure_scaled(figures->planar, 1e-6);
    const struct gb_bench_figure all = gb_bench_figure_scaled(figures->planar_all, 1e-6);
    const char *rate = "million particle-steps per s", *step = "us per particle-step";
    add_row(rows, "planar dynamic scene on one core", planar.value, planar.spread, rate,
            GB_BENCH_MORE);
    add_row(rows, "planar dynamic scene on all cores", all.value, all.spread, rate,
            GB_BENCH_MORE);
    add_fact(rows, "die at coordination", die->coordination, "");
    add_time(rows, "die: Hertz on one core", die->hertz, 1e-6, step);
    add_time(rows, "die: Hertz on all cores", die->hertz_all, 1e-6, step);
    add_time(rows, "die: Hertz with friction", die->hertz_friction, 1e-6, step);
    add_time(rows, "die: Storakers", die->storakers, 1e-6, step);
    add_time(rows, "die: Storakers with friction", die->storakers_friction, 1e-6, step);
}

void gb_bench_output_figures(const struct gb_bench_output_figures *figures,
                             struct gb_bench_output_rows *rows)
{
    const struct gb_bench_cell *scene = &figures->cell[GB_BENCH_SCENE];
    bool same_bits = true;
    rows->count = 0;
    for (int i = 0; i < GB_BENCH_CELLS; i++) {
        same_bits = same_bits && figures->cell[i].same_bits;
    }
    add_fact(rows, "particles", (double)scene->params.count, "");
    add_fact(rows, "cores", (double)g_get_num_processors(), "");
    add_fact(rows, "initial structure", scene->grow_s, "s");
    add_fact(rows, "timed at coordination", scene->coordination, "");
    add_fact(rows, "timed at density", scene->density, "");
    add_fact(rows, "same bits on one and all cores", same_bits, "(1: yes)");
    add_fact(rows, "memory", scene->bytes_per_particle, "bytes per particle");
    add_cell(rows, scene, "evaluation and move on one core",
             "evaluation and move on all cores");
    add_time(rows, "  all cores while another process has one", scene->all_busy,
             1e-6 * (double)scene->params.count, "us per particle");
    add_cell(rows, &figures->cell[GB_BENCH_SMALL], "1000 particles on one core",
             "1000 particles on all cores");
    add_cell(rows, &figures->cell[GB_BENCH_DOUBLE], "double precision on one core",
             "double precision on all cores");
    add_cell(rows, &figures->cell[GB_BENCH_SIZES], "many sizes on one core",
             "many sizes on all cores");
    add_state(rows, &figures->state);
    add_scenes(rows, figures);
}

void gb_bench_output_csv(GString *text, const struct gb_bench_output_rows *rows)
{
    g_string_append_printf(text, "# greenbody %s, %s\nfigure,value,unit,spread\n",
                           GB_VERSION, gb_simd_name(gb_simd_width(0)));
    for (size_t i = 0; i < rows->count; i++) {
        const struct gb_bench_row *row = &rows->row[i];
        g_string_append_printf(text, "%s,%.6g,%s,%.3g\n", row->name, row->value,
                               row->unit, row->spread);
    }
}

void gb_bench_output_table(GString *text, const struct gb_bench_output_rows *rows)
{
    for (size_t i = 0; i < rows->count; i++) {
        const struct gb_bench_row *row = &rows->row[i];
        char spread[32] = "";
        if (row->spread > 0.0) {
            g_snprintf(spread, sizeof spread, "+- %.1g", row->spread);
        }
        g_string_append_printf(text, "%-42s %10.4g %-10s %s\n", row->name, row->value,
                               spread, row->unit);
    }
}

void gb_bench_output_changes(GString *text, const struct gb_bench_output_rows *rows,
                             const struct gb_bench_change *change)
{
    static const char *const verdict[] = {"", "within the noise", "better", "worse"};
    g_string_append_printf(text, "%-42s %10s %10s %7s\n", "", "before", "now", "ratio");
    for (size_t i = 0; i < rows->count; i++) {
        const struct gb_bench_row *row = &rows->row[i];
        if (isfinite(change[i].before)) {
            g_string_append_printf(text, "%-42s %10.4g %10.4g %7.3f  %s\n", row->name,
                                   change[i].before, row->value, change[i].ratio,
                                   verdict[change[i].verdict]);
        } else {
            g_string_append_printf(text, "%-42s %10s %10.4g\n", row->name, "-",
                                   row->value);
        }
    }
}

void gb_bench_output_roofline(const struct gb_bench_roofline *roofline, double particles,
                              struct gb_bench_output_rows *rows)
{
    const struct gb_bench_roofline r = *roofline;
    const double least = gb_bench_roofline_least_s(&r), time = r.evaluation.value;
    const struct gb_bench_figure peak = gb_bench_figure_scaled(r.peak, 1e-9);
    const struct gb_bench_figure copy = gb_bench_figure_scaled(r.bandwidth, 1e-9);
    const struct gb_bench_figure memory = gb_bench_figure_scaled(r.memory, 1e-9);
    rows->count = 0;
    add_fact(rows, "particles", particles, "");
    add_fact(rows, "near pairs", r.near, "per particle");
    add_fact(rows, "far pairs", r.far, "per particle");
    add_fact(rows, "counted operations", r.flops, "flops per particle");
    add_fact(rows, "counted data", r.bytes, "bytes per particle");
    add_fact(rows, "operations over data", r.flops / r.bytes, "flops per byte");
    add_time(rows, "evaluation and move on one core", r.evaluation, 1e-6,
             "us per particle");
    add_row(rows, "peak of one core", peak.value, peak.spread, "Gflop/s", GB_BENCH_MORE);
    add_row(rows, "copy of as much data", copy.value, copy.spread, "GB/s", GB_BENCH_MORE);
    add_row(rows, "copy of 256 MiB", memory.value, memory.spread, "GB/s", GB_BENCH_MORE);
    add_fact(rows, "operations reached", 1e-9 * r.flops / time, "Gflop/s");
    add_fact(rows, "data reached", 1e-9 * r.bytes / time, "GB/s");
    add_fact(rows, "least time by peak", 1e6 * r.flops / r.peak.value, "us per particle");
    add_fact(rows, "least time by copies", 1e6 * r.bytes / r.bandwidth.value,
             "us per particle");
    add_fact(rows, "share of the roof reached", least / time, "");
}
