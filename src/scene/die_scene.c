#include "scene/die_scene.h"

#include <math.h>
#include <stdio.h>

#include "base/units.h"
#include "scene/derived.h"
#include "scene/loading_kind.h"
#include "scene/tolerances.h"

/* Standard gravity, m/s2. */
static const double standard_gravity = 9.80665;

/* Density of the powder placed at random in the funnel. */
static const double loose_density = 0.2;

static bool refuse_length(const char *key, double value, const char *relation,
                          double bound, struct gb_error *err)
{
    char given[64], limit[64];
    gb_units_format(value, GB_DIM_LENGTH, given, sizeof given);
    gb_units_format(bound, GB_DIM_LENGTH, limit, sizeof limit);
    return gb_error_set(err, GB_ERR_INPUT, "%s = %s: must be %s %s", key, given, relation,
                        limit);
}

/* The largest size that the keys give; 0 for a distribution without an upper limit. */
static double largest_named(const struct gb_params *params)
{
    switch (params->distribution) {
    case GB_DISTRIBUTION_TABLE:
        return params->sizes.row[params->sizes.count - 1].diameter_m;
    case GB_DISTRIBUTION_LOGNORMAL:
        return isnan(params->diameter_max_m) ? 0.0 : params->diameter_max_m;
    default:
        return params->diameter_m;
    }
}

static bool check_lengths(const struct gb_params *params, struct gb_error *err)
{
    const double largest = largest_named(params), die = params->die_diameter_m;
    const double outlet = params->die_outlet_m;
    if (largest >= die) {
        return refuse_length("die.diameter", die, "above the largest particle diameter,",
                             largest, err);
    }
    if (outlet > die) {
        return refuse_length("die.outlet", outlet, "at most die.diameter,", die, err);
    }
    return params->central_m <= die || refuse_length("die.central", params->central_m,
                                                     "at most die.diameter,", die, err);
}

static bool check_scene(const struct gb_params *params, struct gb_error *err)
{
    if (params->dimension != 3) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "scene.dimension = 2: must be 3 with scene.kind = die");
    }
    if (params->geometry != GB_GEOMETRY_DIE) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.geometry: must be die with scene.kind = die");
    }
    if (!gb_loading_kind_check_normal(params, err)) {
        return false;
    }
    if (isnan(params->until_pressure_pa)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.until = density = %g: must be a pressure with "
                            "scene.kind = die, where the punch pressure is prescribed",
                            params->until_density);
    }
    return params->unload_count == 0 ||
           gb_error_set(err, GB_ERR_INPUT,
                        "loading.unload_from: must be empty with scene.kind = die");
}

bool gb_die_scene_check(const struct gb_params *params, struct gb_error *err)
{
    if (!check_scene(params, err) || !check_lengths(params, err)) {
        return false;
    }
    if (params->rest_gravity > params->fill_gravity) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "die.gravity = %g: must be at most die.fill_gravity = %g",
                            params->rest_gravity, params->fill_gravity);
    }
    return true;
}

static double given_or(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

static double safety_of(enum gb_fidelity fidelity)
{
    return fidelity == GB_FIDELITY_REFERENCE  ? GB_SAFETY_REFERENCE
           : fidelity == GB_FIDELITY_BALANCED ? GB_SAFETY_BALANCED
                                              : GB_SAFETY_FAST;
}

void gb_die_scene_freeze(struct gb_model *model, const struct gb_params *params)
{
    const double d = params->diameter_m, unit = gb_derived_unit_time_s(params);
    const double gravity = standard_gravity * unit * unit / d;
    const bool fast = params->fidelity == GB_FIDELITY_FAST;
    const double step = gb_derived_time_step_s(params);
    const double ramp_s = given_or(params->ramp_s, fast ? 20e-6 : 100e-6);
    model->die = (struct gb_die_scene){
        .radius = 0.5 * params->die_diameter_m / d,
        .height = given_or(params->die_height_m, 0.0) / d,
        .outlet = 0.5 * given_or(params->die_outlet_m, 0.75 * params->die_diameter_m) / d,
        .angle = params->die_angle_deg * M_PI / 180.0,
        .loose_density = loose_density,
        .fill_gravity = params->fill_gravity * gravity,
        .gravity = params->rest_gravity * gravity,
        .gravity_ramp = params->gravity_ramp_s / unit,
        .flatten_travel = params->flatten_m / d,
        .ramp_time = ramp_s / unit,
        .pressure = params->until_pressure_pa / params->young_pa,
        .quadratic =
            params->ramp == GB_RAMP_QUADRATIC || (params->ramp == GB_RAMP_AUTO && fast),
        .record = params->record_pressure_pa / params->young_pa,
        .punch_mass = params->punch_mass,
        .full_cycle = params->die_cycle == GB_DIE_CYCLE_FULL,
        .unload_time = given_or(params->unload_s, ramp_s) / unit,
        .rest_time = params->rest_s / unit,
        .eject_speed = params->eject_m_s * unit / d,
        .weld_strength = params->weld_strength_pa / params->young_pa,
        .safety = given_or(params->safety, safety_of((enum gb_fidelity)params->fidelity)),
        .time_step = isnan(step) ? 0.0 : step / unit,
        .inertia_scale = params->inertia_scale,
        .central_radius = 0.5 * params->central_m / d,
        .second_per_time = unit,
    };
}

static void write_time(const struct gb_die_scene *die, double reduced, char *buffer,
                       size_t size)
{
    gb_units_format_short(reduced * die->second_per_time, GB_DIM_TIME, 4, buffer, size);
}

static void note_step(const struct gb_die_scene *die, char *buffer, size_t size)
{
    char step[48];
    if (die->time_step > 0.0) {
        write_time(die, die->time_step, step, sizeof step);
        snprintf(buffer, size, "central differences, time step %s", step);
        return;
    }
    snprintf(buffer, size, "central differences, time step %g of the critical one",
             die->safety);
}

static void note_ramp(const struct gb_model *model, char *buffer, size_t size)
{
    const struct gb_die_scene *die = &model->die;
    char time[48], pressure[48];
    write_time(die, die->ramp_time, time, sizeof time);
    gb_units_format_short(die->pressure * model->pascal_per_stress, GB_DIM_PRESSURE, 4,
                          pressure, sizeof pressure);
    snprintf(buffer, size, "punch of %g powder masses: 0 to %s in %s, %s",
             die->punch_mass, pressure, time,
             die->quadratic ? "with the square of time" : "linear");
}

static void note_cycle(const struct gb_model *model, char *buffer, size_t size)
{
    const struct gb_die_scene *die = &model->die;
    char unload[48], rest[48], speed[48], strength[48] = "no cold welds";
    write_time(die, die->unload_time, unload, sizeof unload);
    write_time(die, die->rest_time, rest, sizeof rest);
    gb_units_format_short(die->eject_speed * model->metre_per_length /
                              die->second_per_time,
                          GB_DIM_SPEED, 4, speed, sizeof speed);
    if (die->weld_strength > 0.0) {
        char value[32];
        gb_units_format_short(die->weld_strength * model->pascal_per_stress,
                              GB_DIM_PRESSURE, 4, value, sizeof value);
        snprintf(strength, sizeof strength, "cold welds of %s", value);
    }
    snprintf(buffer, size, "unload in %s, punch off, rest %s, eject at %s, rest; %s",
             unload, rest, speed, strength);
}

const char *gb_die_scene_note(const struct gb_model *model, int index, char *buffer,
                              size_t size)
{
    const struct gb_die_scene *die = &model->die;
    switch (index) {
    case 0:
        note_step(die, buffer, size);
        return buffer;
    case 1:
        snprintf(buffer, size,
                 "pour under %.3g times the gravity at rest, frictionless Hertz contacts "
                 "for every law of pressing; settle, flatten, press",
                 die->fill_gravity / die->gravity);
        return buffer;
    case 2:
        note_ramp(model, buffer, size);
        return buffer;
    case 3:
        snprintf(buffer, size, "rotational inertia: %g times the spheres' own",
                 die->inertia_scale);
        return buffer;
    case 4:
        if (die->full_cycle) {
            note_cycle(model, buffer, size);
            return buffer;
        }
        snprintf(buffer, size, "cycle ends at full pressure; die.cycle = full continues");
        return buffer;
    default:
        return NULL;
    }
}
