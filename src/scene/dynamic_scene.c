#include "scene/dynamic_scene.h"

#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "law/law_viscous.h"
#include "scene/derived.h"

/* Moment of inertia J = m d^2 / 10 of a solid sphere, also for the discs of 2D scenes.
 * Source: P2 (1). */
static const double inertia_sphere = 0.1;

/* P2 fixes the rate and the end density, so a dynamic run cannot end at a pressure or
 * unload from one. */
static bool check_end(const struct gb_params *params, struct gb_error *err)
{
    char pressure[64];
    if (isnan(params->until_density)) {
        gb_units_format(params->until_pressure_pa, GB_DIM_PRESSURE, pressure,
                        sizeof pressure);
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.until = %s: must be density = ... above "
                            "structure.density = %g with scene.kind = dynamic",
                            pressure, gb_derived_structure_density(params));
    }
    if (params->unload_count > 0) {
        gb_units_format(params->unload_from_pa[0], GB_DIM_PRESSURE, pressure,
                        sizeof pressure);
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.unload_from = %s: must be empty with "
                            "scene.kind = dynamic",
                            pressure);
    }
    return true;
}

bool gb_dynamic_scene_check(const struct gb_params *params, struct gb_error *err)
{
    const double lag =
        gb_law_viscous_time(params->viscosity_pa_s, params->young_pa, params->poisson);
    if (!isfinite(lag)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "material.poisson = %g: must be above 0 with "
                            "contact.viscosity above 0 and scene.kind = dynamic",
                            params->poisson);
    }
    return check_end(params, err);
}

void gb_dynamic_scene_freeze(struct gb_model *model, const struct gb_params *params)
{
    const double unit = gb_derived_unit_time_s(params);
    const double lag =
        gb_law_viscous_time(params->viscosity_pa_s, params->young_pa, params->poisson);
    const double step = gb_derived_time_step_s(params);
    model->dynamics = (struct gb_dynamics){
        .viscous = lag / unit,
        .viscous_shear = params->viscous_forces == GB_VISCOUS_NORMAL ? 0.0 : 1.0,
        .viscous_rolling = params->viscous_forces == GB_VISCOUS_ALL ? 1.0 : 0.0,
        .rate = params->rate_per_s * unit,
        .relax = params->relax_s / unit,
        .hold = params->hold_s / unit,
        .time_step = isnan(step) ? 0.0 : step / unit,
        .step_error = params->step_error,
        .record_density = params->record_density,
        .record_time = params->record_time_s / unit,
        .second_per_time = unit,
        .inertia = inertia_sphere,
    };
}

/* Writes a reduced time in a time unit. */
static void write_time(const struct gb_dynamics *dynamics, double reduced, char *buffer,
                       size_t size)
{
    gb_units_format_short(reduced * dynamics->second_per_time, GB_DIM_TIME, 4, buffer,
                          size);
}

static void note_step(const struct gb_dynamics *dynamics, char *buffer, size_t size)
{
    char unit[48], step[48], error[48];
    write_time(dynamics, 1.0, unit, sizeof unit);
    if (dynamics->time_step > 0.0) {
        write_time(dynamics, dynamics->time_step, step, sizeof step);
        snprintf(buffer, size,
                 "Newton's equations by velocity Verlet, time step %.4g T = %s (T = %s)",
                 dynamics->time_step, step, unit);
        return;
    }
    gb_units_format_short(dynamics->step_error, GB_DIM_FRACTION, 4, error, sizeof error);
    snprintf(buffer, size,
             "Newton's equations by velocity Verlet, time step chosen for an error up to "
             "%s (T = %s)",
             error, unit);
}

static void note_viscous(const struct gb_dynamics *dynamics, char *buffer, size_t size)
{
    char lag[48];
    const char *without = dynamics->viscous_rolling > 0.0 ? ""
                          : dynamics->viscous_shear > 0.0
                              ? "; none in rolling and pivoting"
                              : "; none in shear, rolling and pivoting";
    write_time(dynamics, dynamics->viscous, lag, sizeof lag);
    if (dynamics->viscous > 0.0) {
        snprintf(buffer, size, "viscous forces: carried, A = %s%s", lag, without);
        return;
    }
    snprintf(buffer, size, "viscous forces: left out (contact.viscosity = 0)");
}

static void note_stages(const struct gb_model *model, char *buffer, size_t size)
{
    const struct gb_dynamics *dynamics = &model->dynamics;
    char relax[48], rate[48], hold[48];
    write_time(dynamics, dynamics->relax, relax, sizeof relax);
    write_time(dynamics, dynamics->hold, hold, sizeof hold);
    gb_units_format_short(dynamics->rate / dynamics->second_per_time, GB_DIM_RATE, 4,
                          rate, sizeof rate);
    snprintf(buffer, size, "stages: relax %s, compress at %s to density %.4g, hold %s",
             relax, rate, model->until_density, hold);
}

const char *gb_dynamic_scene_note(const struct gb_model *model, int index, char *buffer,
                                  size_t size)
{
    switch (index) {
    case 0:
        note_step(&model->dynamics, buffer, size);
        return buffer;
    case 1:
        note_viscous(&model->dynamics, buffer, size);
        return buffer;
    case 2:
        note_stages(model, buffer, size);
        return buffer;
    default:
        return NULL;
    }
}
