#include "solve/loading/quasistatic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/portable.h"
#include "base/units.h"

#include "scene/tolerances.h"

void gb_quasistatic_init(struct gb_quasistatic *load, const struct gb_model *model)
{
    *load = (struct gb_quasistatic){
        .step = model->strain_step,
        .step_most = model->strain_step,
        .until_pressure = model->until_pressure,
        .until_density = model->until_density,
        .unload_count = model->unload_count,
        .branch = -1,
    };
    for (int i = 0; i < model->unload_count; i++) {
        load->unload_from[i] = model->unload_from[i];
    }
    load->axes = gb_compressed_axes_of(model);
}

bool gb_quasistatic_record(struct gb_quasistatic *load, struct gb_record *record,
                           struct gb_error *err)
{
#define AT(member) offsetof(struct gb_quasistatic, member)
    static const struct gb_record_member members[] = {
        {"load/step", GB_RECORD_DOUBLE, 1, AT(step), "1"},
        {"load/next_unload", GB_RECORD_INT32, 1, AT(next_unload), "1"},
        {"load/branch", GB_RECORD_INT32, 1, AT(branch), "1"},
        {"load/top_pressure", GB_RECORD_DOUBLE, 1, AT(top_pressure), "E"},
        {"load/last_pressure", GB_RECORD_DOUBLE, 1, AT(last_pressure), "E"},
        {"load/last_expansion", GB_RECORD_DOUBLE, 1, AT(last_expansion), "1"},
        {"load/expansions", GB_RECORD_INT32, 1, AT(expansions), "1"},
        {"load/exceeded", GB_RECORD_DOUBLE, 1, AT(exceeded), "E"},
        {"load/exceeded_by", GB_RECORD_DOUBLE, 1, AT(exceeded_by), "1"},
    };
#undef AT
    if (!gb_record_members(record, members, sizeof members / sizeof members[0], load,
                           err)) {
        return false;
    }
    if (load->next_unload < 0 || load->next_unload > load->unload_count ||
        load->branch < -1 || load->branch > load->next_unload) {
        return gb_error_set(err, GB_ERR_INPUT, "load/branch: is out of range");
    }
    return true;
}

double gb_quasistatic_pressure(const struct gb_quasistatic *load,
                               const double pressure[3])
{
    return gb_compressed_axes_mean(&load->axes, pressure);
}

/* One strain step of compression, shortened to end at until_density. */
static enum gb_quasistatic_order compress(const struct gb_quasistatic *load,
                                          double density, double factor[3])
{
    const double full = 1.0 - load->step;
    const double to_end =
        gb_portable_pow(density / load->until_density, 1.0 / load->axes.count);
    gb_compressed_axes_scale(&load->axes, fmax(full, to_end), factor);
    return GB_QUASISTATIC_STRAIN;
}

/* An unloading step: the inverse of a compression step; the last one is shortened to the
 * strain at which the pressure extrapolates to zero. */
static double expansion(struct gb_quasistatic *load, double pressure)
{
    const double full = 1.0 / (1.0 - load->step);
    double share = 1.0;
    const double drop = load->last_pressure - pressure;
    if (load->expansions > 0 && drop > 0.0) {
        const double predicted = pressure / drop * (load->last_expansion / (full - 1.0));
        share = fmin(1.0, fmax(predicted, GB_UNLOADING_SHARE_MIN));
    }
    load->last_expansion = share * (full - 1.0);
    load->last_pressure = pressure;
    load->expansions++;
    return 1.0 + load->last_expansion;
}

static bool unloaded(struct gb_quasistatic *load, double pressure)
{
    const double grown = gb_portable_pow(1.0 / (1.0 - load->step), load->expansions);
    const bool done = pressure <= GB_UNLOADED_FRACTION * load->top_pressure;
    load->endless = !done && grown > GB_UNLOADING_GROWTH_MAX;
    return done || load->endless;
}

/* False where there is no target: infinite. */
static bool exceeds(double target, double pressure)
{
    return pressure - target > fmax(GB_TARGET_EXCESS * target, GB_TARGET_EXCESS_STRESS);
}

/* An unloading branch begins at this pressure. */
static void begin_unloading(struct gb_quasistatic *load, double pressure)
{
    const double target = load->unload_from[load->next_unload];
    const double excess = pressure / target - 1.0;
    if (exceeds(target, pressure) && excess > load->exceeded_by) {
        load->exceeded = target;
        load->exceeded_by = excess;
    }
    load->branch = ++load->next_unload;
    load->top_pressure = pressure;
    load->expansions = 0;
}

enum gb_quasistatic_order gb_quasistatic_next(struct gb_quasistatic *load,
                                              const double pressure[3], double density,
                                              double factor[3])
{
    const double p = gb_quasistatic_pressure(load, pressure);
    if (load->branch > 0) {
        if (unloaded(load, p)) {
            load->branch = 0;
            return GB_QUASISTATIC_RESTORE;
        }
        gb_compressed_axes_scale(&load->axes, expansion(load, p), factor);
        return GB_QUASISTATIC_STRAIN;
    }
    load->branch = 0;
    if (load->next_unload < load->unload_count &&
        p >= load->unload_from[load->next_unload]) {
        begin_unloading(load, p);
        gb_compressed_axes_scale(&load->axes, expansion(load, p), factor);
        return GB_QUASISTATIC_UNLOAD;
    }
    if (p >= load->until_pressure ||
        density >= load->until_density * (1.0 - GB_DENSITY_END_TOLERANCE)) {
        return GB_QUASISTATIC_END;
    }
    return compress(load, density, factor);
}

void gb_quasistatic_halve(struct gb_quasistatic *load, double factor[3])
{
    load->step *= 0.5;
    for (int k = 0; k < 3; k++) {
        factor[k] = sqrt(factor[k]);
    }
}

void gb_quasistatic_recover(struct gb_quasistatic *load)
{
    load->step = fmin(2.0 * load->step, load->step_most);
}

/* Appends "loading.unload_from = 100 MPa; 1 GPa", of those pressures not reached. */
static void name_unloadings(const struct gb_quasistatic *load,
                            const struct gb_params *params, char *text, size_t size)
{
    const char *before = "loading.unload_from = ";
    for (int k = load->next_unload; k < load->unload_count; k++) {
        char pressure[64];
        const size_t used = strlen(text);
        gb_units_format_short(params->unload_from_pa[k], GB_DIM_PRESSURE, 6, pressure,
                              sizeof pressure);
        snprintf(text + used, size - used, "%s%s", before, pressure);
        before = "; ";
    }
}

static void add_excess(const char *key, double target_pa, double excess, char *text,
                       size_t size)
{
    char target[64];
    const size_t used = strlen(text);
    gb_units_format_short(target_pa, GB_DIM_PRESSURE, 6, target, sizeof target);
    snprintf(text + used, size - used, "%s%s = %s by %.3g %%", used > 0 ? ", " : "", key,
             target, 100.0 * excess);
}

bool gb_quasistatic_missed(const struct gb_quasistatic *load,
                           const struct gb_params *params, double pascal_per_stress,
                           double pressure, double density, char *text, size_t size)
{
    char unreached[256] = "", exceeded[256] = "", at[64];
    const double until_pa = params->until_pressure_pa; /* NaN: until a density */
    const double pressure_pa = pressure * pascal_per_stress;
    const bool until = until_pa > pressure_pa;
    if (until) {
        gb_units_format_short(until_pa, GB_DIM_PRESSURE, 6, at, sizeof at);
        snprintf(unreached, sizeof unreached, "loading.until = %s%s", at,
                 load->next_unload < load->unload_count ? ", " : "");
    }
    name_unloadings(load, params, unreached, sizeof unreached);
    if (exceeds(load->until_pressure, pressure)) {
        add_excess("loading.until", until_pa, pressure_pa / until_pa - 1.0, exceeded,
                   sizeof exceeded);
    }
    if (load->exceeded_by > 0.0) {
        add_excess("loading.unload_from", load->exceeded * pascal_per_stress,
                   load->exceeded_by, exceeded, sizeof exceeded);
    }
    text[0] = '\0';
    if (unreached[0] == '\0' && exceeded[0] == '\0') {
        return false;
    }
    gb_units_format_short(pressure_pa, GB_DIM_PRESSURE, 4, at, sizeof at);
    snprintf(text, size, "%s%s%s%s%s; ended at %s, density %.4f%s%s",
             unreached[0] != '\0' ? "not reached: " : "", unreached,
             unreached[0] != '\0' && exceeded[0] != '\0' ? "; " : "",
             exceeded[0] != '\0' ? "exceeded: " : "", exceeded, at, density,
             until ? " (all space is filled)" : "",
             exceeded[0] != '\0' ? " (a smaller loading.step comes nearer)" : "");
    return true;
}

double gb_quasistatic_progress(const struct gb_quasistatic *load, double pressure,
                               double density, double start_density)
{
    /* time goes with the number of strain steps, that is with the logarithm of density */
    const double end =
        load->until_density < 1.0 ? load->until_density : GB_PROGRESS_END_DENSITY;
    const double by_density =
        gb_portable_log(density / start_density) / gb_portable_log(end / start_density);
    const double by_pressure =
        isfinite(load->until_pressure) ? pressure / load->until_pressure : 0.0;
    return fmin(1.0, fmax(0.0, fmax(fmin(by_density, GB_PROGRESS_MAX),
                                    by_pressure * by_pressure)));
}
