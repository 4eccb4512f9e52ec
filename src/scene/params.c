#include "greenbody/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/units.h"
#include "law/law_storakers.h"
#include "scene/changes.h"
#include "scene/die_scene.h"
#include "scene/dynamic_scene.h"
#include "scene/field.h"
#include "scene/keep_points.h"
#include "scene/size_table.h"
#include "scene/sizes.h"

static const char *const kinds[] = {"quasistatic", "dynamic", "die", NULL};
static const char *const dimensions[] = {"3", "2", NULL};
static const char *const distributions[] = {"mono", "lognormal", "table", NULL};
static const char *const normals[] = {"rod", "hertz", "storakers", NULL};
static const char *const storakers[] = {"capped", "printed", NULL};
static const char *const radii[] = {"deepest", "current", NULL};
static const char *const motions[] = {"half", "full", NULL};
static const char *const geometries[] = {"uniaxial", "biaxial", "isotropic", "die", NULL};
static const char *const ramps[] = {"auto", "linear", "quadratic", NULL};
static const char *const hangups[] = {"detach", "stop", NULL};
static const char *const fidelities[] = {"fast", "balanced", "reference", NULL};
static const char *const precisions[] = {"auto", "double", "single", NULL};
static const char *const relaxers[] = {"auto", "predict", "fire", "steepest", NULL};

/* Member of gb_params, as offset and size. */
#define AT(member)                                                                       \
    .offset = offsetof(struct gb_params, member),                                        \
    .size = sizeof(((struct gb_params *)0)->member)
#define RANGE(low, high) .min = (low), .max = (high)
#define AUTO(value)      .auto_allowed = true, .automatic = (value)

/* THE field table: everything a preset can say. */
static const struct gb_field fields[] = {
    {"scene", "title", GB_FIELD_TEXT, AT(title), .fallback = "",
     .meaning = "name of the scene in figures and run directories", .source = "user"},
    {"scene", "kind", GB_FIELD_CHOICE, AT(kind), .choices = kinds,
     .fallback = "quasistatic",
     .meaning = "relaxed after every strain step; Newton's equations; powder in a die",
     .source = "P1 III, P2 (1), P3 5"},
    {"scene", "dimension", GB_FIELD_CHOICE, AT(dimension), .choices = dimensions,
     .fallback = "3", .meaning = "spheres in space, or discs in the x-z plane",
     .source = "P1, P2"},

    {"material", "name", GB_FIELD_TEXT, AT(material), .fallback = "alumina",
     .meaning = "name of the material", .source = "user"},
    {"material", "young", GB_FIELD_NUMBER, AT(young_pa), .dimension = GB_DIM_PRESSURE,
     RANGE(1e3, 1e13), .fallback = "382 GPa", .meaning = "Young's modulus E",
     .source = "P1 V"},
    {"material", "poisson", GB_FIELD_NUMBER, AT(poisson), RANGE(0.0, 0.49),
     .fallback = "0.25", .meaning = "Poisson's ratio nu", .source = "P1 V"},
    {"material", "density", GB_FIELD_NUMBER, AT(density_kg_m3),
     .dimension = GB_DIM_MASS_DENSITY, RANGE(1.0, 1e5), .fallback = "3990 kg/m3",
     .meaning = "mass density of the solid (no effect in quasi-static runs)",
     .source = "handbook value for alumina"},
    {"material", "d0", GB_FIELD_NUMBER, AT(d0_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-11, 1e-8), .fallback = "0.392 nm",
     .meaning = "molecular diameter of the dispersion law", .source = "P1 (3)"},
    {"material", "n_d0_cubed", GB_FIELD_NUMBER, AT(n_d0_cubed), RANGE(0.0, 10.0),
     .fallback = "1.4142135623730951",
     .meaning = "number of molecules per d0^3; sqrt 2 is close packing",
     .source = "P1 (3)"},
    {"material", "epsilon", GB_FIELD_NUMBER, AT(epsilon_j), .dimension = GB_DIM_ENERGY,
     RANGE(0.0, 1e5 * GB_BOLTZMANN_J_K), .fallback = "1224 kB",
     .meaning = "energy of the dispersion law; 0 switches attraction off",
     .source = "P1 (3)"},
    {"material", "yield", GB_FIELD_NUMBER, AT(yield_pa), .dimension = GB_DIM_PRESSURE,
     RANGE(1e3, 1e12), .fallback = "800 MPa",
     .meaning = "yield stress sigma_Y of pressed metal", .source = "P3 Table 2"},
    {"material", "hardening", GB_FIELD_NUMBER, AT(hardening), RANGE(0.0, 0.5),
     .fallback = "0", .meaning = "exponent m of Hollomon's sigma = sigma_0 eps^m",
     .source = "P3 (15)"},
    {"material", "hollomon", GB_FIELD_NUMBER, AT(hollomon_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(1e3, 1e13), AUTO(NAN), .fallback = "auto",
     .meaning = "strength coefficient sigma_0; auto is yield (young/yield)^hardening",
     .source = "P3 (15), 4"},
    {"material", "young_j", GB_FIELD_NUMBER, AT(young_j_pa), .dimension = GB_DIM_PRESSURE,
     RANGE(1e3, 1e13), AUTO(NAN), .fallback = "auto",
     .meaning = "Young's modulus of the second body of a pair; auto is young",
     .source = "P3 (3)"},
    {"material", "poisson_j", GB_FIELD_NUMBER, AT(poisson_j), RANGE(0.0, 0.49), AUTO(NAN),
     .fallback = "auto",
     .meaning = "Poisson's ratio of the second body of a pair; auto is poisson",
     .source = "P3 (3)"},
    {"material", "density_j", GB_FIELD_NUMBER, AT(density_j_kg_m3),
     .dimension = GB_DIM_MASS_DENSITY, RANGE(1.0, 1e5), AUTO(NAN), .fallback = "auto",
     .meaning = "mass density of the second body of a pair; auto is density",
     .source = "P3 (8)"},
    {"material", "yield_j", GB_FIELD_NUMBER, AT(yield_j_pa), .dimension = GB_DIM_PRESSURE,
     RANGE(1e3, 1e12), AUTO(NAN), .fallback = "auto",
     .meaning = "yield stress of the second body of a pair; auto is yield",
     .source = "P3 (18)"},

    {"particles", "count", GB_FIELD_INTEGER, AT(count), RANGE(10.0, 1e7),
     .fallback = "8000", .meaning = "number of particles in the periodic cell",
     .source = "P1 III"},
    {"particles", "diameter", GB_FIELD_NUMBER, AT(diameter_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1e-3), .fallback = "10 nm", .meaning = "particle diameter d",
     .source = "P1 V"},
    {"particles", "distribution", GB_FIELD_CHOICE, AT(distribution),
     .choices = distributions, .fallback = "mono",
     .meaning = "one size, a log-normal law by number, or a table of sizes",
     .source = "P1 III, P1 (17), P3 5"},
    {"particles", "median", GB_FIELD_NUMBER, AT(median_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1e-3), AUTO(NAN), .fallback = "auto",
     .meaning = "median of a log-normal law, exp(m) in P1; auto is particles.diameter",
     .source = "P1 (17)"},
    {"particles", "sigma", GB_FIELD_NUMBER, AT(sigma), RANGE(1e-3, 1.0),
     .fallback = "0.5", .meaning = "standard deviation of ln d in a log-normal law",
     .source = "P1 (17)"},
    {"particles", "least", GB_FIELD_NUMBER, AT(diameter_min_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1e-3), AUTO(NAN), .fallback = "auto",
     .meaning = "diameter below which a log-normal law is cut; auto: not cut",
     .source = "P3 5"},
    {"particles", "largest", GB_FIELD_NUMBER, AT(diameter_max_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1e-3), AUTO(NAN), .fallback = "auto",
     .meaning = "diameter above which a log-normal law is cut; auto: not cut",
     .source = "P3 5"},
    {"particles", "table", GB_FIELD_SIZES, AT(sizes), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1e-3), .fallback = "",
     .meaning = "diameters and their shares for distribution = table; kept as one line",
     .source = "P3 5"},

    {"contact", "normal", GB_FIELD_CHOICE, AT(normal), .choices = normals,
     .fallback = "rod",
     .meaning = "law of the normal force: rod model with attraction and bridges, or dry "
                "grains: Hertz, in a die also Storakers",
     .source = "P1 (1); P3 (2), (16)"},
    {"contact", "alpha", GB_FIELD_NUMBER, AT(alpha), RANGE(0.05, 10.0),
     .fallback = "0.24", .meaning = "least gap in the dispersion law, in d0",
     .source = "P1 (3), V"},
    {"contact", "mu", GB_FIELD_NUMBER, AT(mu), RANGE(0.0, 2.0), .fallback = "0.1",
     .meaning = "friction coefficient in shear", .source = "P1 (5), V"},
    {"contact", "mu_wall", GB_FIELD_NUMBER, AT(mu_wall), RANGE(0.0, 2.0),
     .fallback = "0.02",
     .meaning = "friction coefficient of the walls of a die, in filling and pressing",
     .source = "P3 5"},
    {"contact", "mu_pivot", GB_FIELD_NUMBER, AT(mu_pivot), RANGE(0.0, 2.0), AUTO(NAN),
     .fallback = "auto", .meaning = "friction coefficient in pivoting; auto is mu",
     .source = "P1 (8)"},
    {"contact", "bridge_length", GB_FIELD_RELATIVE, AT(bridge_length),
     .dimension = GB_DIM_LENGTH, .relative = "d", RANGE(1e-5, HUGE_VAL),
     .fallback = "0.008 d",
     .meaning = "overlap at which a solid bridge forms; 1 d or more: no bridges",
     .source = "P1 (2), V"},
    {"contact", "shear_strength", GB_FIELD_RELATIVE, AT(shear_strength),
     .dimension = GB_DIM_PRESSURE, .relative = "E", RANGE(0.0, 1.0), AUTO(NAN),
     .fallback = "auto",
     .meaning = "shear strength sigma_b; auto is 0.018 E, and no limit without bridges",
     .source = "P1 (4), (5), V"},
    {"contact", "bridge_radius", GB_FIELD_CHOICE, AT(bridge_radius), .choices = radii,
     .fallback = "deepest",
     .meaning = "bridge radius from the deepest overlap, or as printed from the current",
     .source = "P1 II.A"},
    {"contact", "relative_motion", GB_FIELD_CHOICE, AT(relative_motion),
     .choices = motions, .fallback = "half",
     .meaning = "share of the relative motion that a tangential spring sees",
     .source = "P1 II.B"},
    {"contact", "viscosity", GB_FIELD_NUMBER, AT(viscosity_pa_s),
     .dimension = GB_DIM_VISCOSITY, RANGE(0.0, 1e3), .fallback = "1 mPa s",
     .meaning =
         "shear viscosity eta of the solid in dynamic scenes; 0: no viscous forces",
     .source = "P2 (3)"},
    {"contact", "damping", GB_FIELD_NUMBER, AT(damping), RANGE(0.0, 10.0),
     .fallback = "0.9",
     .meaning = "normal damping xi of hertz and storakers, as a share of the critical",
     .source = "P3 (7), 5"},
    {"contact", "shear_ratio", GB_FIELD_NUMBER, AT(shear_ratio), RANGE(0.01, 100.0),
     .fallback = "1", .meaning = "tangential over normal stiffness with storakers",
     .source = "P3 (21)"},
    {"contact", "storakers", GB_FIELD_CHOICE, AT(storakers), .choices = storakers,
     .fallback = "capped",
     .meaning = "capped by Hertz' force, or as printed, which can give energy away",
     .source = "P3 (16), 4"},
    {"contact", "radius_i", GB_FIELD_NUMBER, AT(radius_i_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-10, 1e-2), .infinite = "wall", AUTO(NAN), .fallback = "auto",
     .meaning = "radius of the first body of a pair; auto is half the diameter",
     .source = "P3 (4)"},
    {"contact", "radius_j", GB_FIELD_NUMBER, AT(radius_j_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-10, 1e-2), .infinite = "wall", AUTO(NAN), .fallback = "auto",
     .meaning = "radius of the second body of a pair; auto is half the diameter",
     .source = "P3 (4)"},

    {"structure", "density", GB_FIELD_NUMBER, AT(structure_density), RANGE(0.01, 0.74),
     AUTO(NAN), .fallback = "auto",
     .meaning = "density of the initial structure; auto is 0.24 in 3D, 0.5 in 2D",
     .source = "P1 III, P2"},
    {"structure", "base", GB_FIELD_RELATIVE, AT(base), .dimension = GB_DIM_LENGTH,
     .relative = "d", RANGE(3.0, 1e4), AUTO(0.0), .fallback = "auto",
     .meaning = "edges x and y of the cell; auto is P1's aspect ratio, a square in 2D",
     .source = "P1 III"},
    {"structure", "r_meso", GB_FIELD_RELATIVE, AT(r_meso), .dimension = GB_DIM_LENGTH,
     .relative = "d", RANGE(1.0, 10.0), .fallback = "2 d",
     .meaning = "reach within which the growth counts neighbours", .source = "P1 III"},
    {"structure", "seed", GB_FIELD_SEED, AT(seed), .fallback = "1",
     .meaning = "seed of the random numbers: same seed, same structure",
     .source = "numerical"},

    {"die", "diameter", GB_FIELD_NUMBER, AT(die_diameter_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1.0), .fallback = "58 um", .meaning = "diameter of the cylinder",
     .source = "P3 5"},
    {"die", "height", GB_FIELD_NUMBER, AT(die_height_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 10.0), AUTO(NAN), .fallback = "auto",
     .meaning = "height of the funnel over the floor; auto: room for a loose filling",
     .source = "numerical"},
    {"die", "outlet", GB_FIELD_NUMBER, AT(die_outlet_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1.0), AUTO(NAN), .fallback = "auto",
     .meaning = "diameter of the funnel's outlet; auto: 3/4 of the die",
     .source = "numerical"},
    {"die", "angle", GB_FIELD_NUMBER, AT(die_angle_deg), RANGE(5.0, 80.0),
     .fallback = "35", .meaning = "angle between the funnel's wall and its axis, degrees",
     .source = "numerical"},
    {"die", "fill_gravity", GB_FIELD_NUMBER, AT(fill_gravity), RANGE(1.0, 1e8),
     .fallback = "200000",
     .meaning = "gravity while powder is poured, in g; real g takes days",
     .source = "numerical"},
    {"die", "gravity", GB_FIELD_NUMBER, AT(rest_gravity), RANGE(1e-3, 1e8),
     .fallback = "200", .meaning = "gravity of the powder at rest and pressed, in g",
     .source = "numerical"},
    {"die", "ease", GB_FIELD_NUMBER, AT(gravity_ramp_s), .dimension = GB_DIM_TIME,
     RANGE(1e-9, 1.0), .fallback = "20 us",
     .meaning = "time in which gravity goes down from filling to rest",
     .source = "numerical"},
    {"die", "flatten", GB_FIELD_NUMBER, AT(flatten_m), .dimension = GB_DIM_LENGTH,
     RANGE(0.0, 1.0), .fallback = "3 um",
     .meaning = "way of the punch down from its first contact, before it is lifted",
     .source = "P3 5"},
    {"die", "punch_mass", GB_FIELD_NUMBER, AT(punch_mass), RANGE(1e-3, 100.0),
     .fallback = "0.1",
     .meaning = "mass of the punch in masses of the powder; above 1 it lags behind",
     .source = "numerical"},
    {"die", "central", GB_FIELD_NUMBER, AT(central_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1.0), .fallback = "54 um",
     .meaning = "diameter of the sphere in the middle that measures the central density",
     .source = "P3 5"},

    {"loading", "geometry", GB_FIELD_CHOICE, AT(geometry), .choices = geometries,
     .fallback = "uniaxial",
     .meaning = "axes compressed: z, or y and z, or all; or a die",
     .source = "P1 III, VI"},
    {"loading", "step", GB_FIELD_NUMBER, AT(strain_step), .dimension = GB_DIM_FRACTION,
     RANGE(1e-6, 0.02), .fallback = "0.1 %",
     .meaning = "shrinkage of an axis per step, of its current length",
     .source = "P1 III"},
    {"loading", "until", GB_FIELD_UNTIL, AT(until_pressure_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(1e3, 1e12), .fallback = "1 GPa",
     .meaning = "pressure or density at which loading ends", .source = "P1 V"},
    {"loading", "unload_from", GB_FIELD_PRESSURES, AT(unload_from_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(1e3, 1e12), .fallback = "",
     .meaning = "pressures from which branches of unloading start", .source = "P1 V, VI"},
    {"loading", "changes", GB_FIELD_TEXT, AT(changes), .fallback = "",
     .meaning = "what changes behind which recorded step, as 120 contact.mu=0.3; "
                "200 loading.geometry=isotropic",
     .source = "user"},
    {"loading", "rate", GB_FIELD_NUMBER, AT(rate_per_s), .dimension = GB_DIM_RATE,
     RANGE(1.0, 1e12), .fallback = "680 1/us",
     .meaning = "densification rate (1/rho) d rho/dt of dynamic scenes",
     .source = "P2 2, v1"},
    {"loading", "relax", GB_FIELD_NUMBER, AT(relax_s), .dimension = GB_DIM_TIME,
     RANGE(0.0, 1.0), .fallback = "10 ns",
     .meaning = "time a dynamic scene relaxes before it is compressed", .source = "P2 3"},
    {"loading", "hold", GB_FIELD_NUMBER, AT(hold_s), .dimension = GB_DIM_TIME,
     RANGE(0.0, 1.0), .fallback = "30 ns",
     .meaning = "time a dynamic scene is held at the end density", .source = "P2 3"},
    {"loading", "record", GB_FIELD_NUMBER, AT(record_density),
     .dimension = GB_DIM_FRACTION, RANGE(1e-6, 0.1), .fallback = "0.1 %",
     .meaning = "growth of density between recorded points of a dynamic scene",
     .source = "numerical"},
    {"loading", "record_time", GB_FIELD_NUMBER, AT(record_time_s),
     .dimension = GB_DIM_TIME, RANGE(1e-15, 1.0), .fallback = "20 ps",
     .meaning = "time between recorded points of relax and hold in a dynamic scene",
     .source = "numerical"},
    {"loading", "ramp", GB_FIELD_CHOICE, AT(ramp), .choices = ramps, .fallback = "auto",
     .meaning = "pressure of a punch against time: t or t^2; auto: quadratic when fast",
     .source = "P3 5; numerical"},
    {"loading", "time", GB_FIELD_NUMBER, AT(ramp_s), .dimension = GB_DIM_TIME,
     RANGE(1e-9, 1.0), AUTO(NAN), .fallback = "auto",
     .meaning = "time in which a punch reaches its pressure; auto: 100 us, fast 20 us",
     .source = "P3 5; numerical"},
    {"loading", "record_pressure", GB_FIELD_NUMBER, AT(record_pressure_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(1.0, 1e12), .fallback = "500 kPa",
     .meaning = "growth of pressure between recorded points of a die",
     .source = "numerical"},

    {"numerics", "fidelity", GB_FIELD_CHOICE, AT(fidelity), .choices = fidelities,
     .fallback = "balanced", .meaning = "picks every number of this group left at auto",
     .source = "numerical"},
    {"numerics", "relaxer", GB_FIELD_TEXT, AT(relaxer), .choices = relaxers,
     .fallback = "auto", .meaning = "how a strain step is brought to equilibrium",
     .source = "P1 (15); numerical"},
    {"numerics", "tolerance", GB_FIELD_NUMBER, AT(tolerance), RANGE(1e-12, 0.1),
     AUTO(NAN), .fallback = "auto",
     .meaning = "rms residual force over the force scale at which a step is relaxed; "
                "predict: a share of it under light loads",
     .source = "numerical"},
    {"numerics", "strain_part", GB_FIELD_NUMBER, AT(strain_part),
     .dimension = GB_DIM_FRACTION, RANGE(1e-6, 0.02), AUTO(NAN), .fallback = "auto",
     .meaning = "largest strain of an axis relaxed at once: a strain step is taken in "
                "equal parts",
     .source = "numerical"},
    {"numerics", "cutoff", GB_FIELD_RELATIVE, AT(cutoff), .dimension = GB_DIM_LENGTH,
     .relative = "d", RANGE(1.0, 3.0), AUTO(NAN), .fallback = "auto",
     .meaning = "distance beyond which attraction is left out", .source = "numerical"},
    {"numerics", "precision", GB_FIELD_CHOICE, AT(precision), .choices = precisions,
     .fallback = "auto",
     .meaning =
         "of forces and contact histories; auto is single where the tolerance allows "
         "it, in quasi-static scenes in 3D",
     .source = "numerical"},
    {"numerics", "threads", GB_FIELD_INTEGER, AT(threads), RANGE(1.0, 1024.0), AUTO(-1.0),
     .fallback = "auto",
     .meaning = "threads of the force sweep; results do not depend on it",
     .source = "numerical"},
    {"numerics", "max_evaluations", GB_FIELD_INTEGER, AT(max_evaluations),
     RANGE(1.0, 1e9), AUTO(-1.0), .fallback = "auto",
     .meaning = "force evaluations after which a strain step is given up",
     .source = "numerical"},
    {"numerics", "time_step", GB_FIELD_RELATIVE, AT(time_step), .dimension = GB_DIM_TIME,
     .relative = "T", RANGE(1e-6, 10.0), AUTO(NAN), .fallback = "auto",
     .meaning =
         "time step of dynamic scenes, T = sqrt(pi rho d^2/(6 E)); auto: step_error",
     .source = "P2 2 (0.04 T)"},
    {"numerics", "step_error", GB_FIELD_NUMBER, AT(step_error),
     .dimension = GB_DIM_FRACTION, RANGE(1e-8, 0.5), .fallback = "0.1 %",
     .meaning = "error in end pressure and energy that an automatic time step may make",
     .source = "numerical"},
    {"numerics", "safety", GB_FIELD_NUMBER, AT(safety), RANGE(1e-4, 10.0), AUTO(NAN),
     .fallback = "auto",
     .meaning =
         "share of the critical time step taken in a die; auto: 0.5, reference 0.1",
     .source = "P3 (26)"},
    {"numerics", "inertia_scale", GB_FIELD_NUMBER, AT(inertia_scale), RANGE(1.0, 1e4),
     .fallback = "10",
     .meaning = "factor on the rotational inertia of particles in a die",
     .source = "P3 3.4"},

    {"output", "snapshots_at", GB_FIELD_TEXT, AT(snapshots_at), .fallback = "",
     .meaning =
         "where states are kept while loading, as 100 MPa; density = 0.5; every 20 "
         "(points)",
     .source = "user"},
    {"output", "checkpoint_every", GB_FIELD_NUMBER, AT(checkpoint_every_s),
     .dimension = GB_DIM_TIME, RANGE(0.1, 604800.0), .fallback = "60 s",
     .meaning = "time between checkpoints of a run", .source = "numerical"},
    {"output", "on_hangup", GB_FIELD_CHOICE, AT(on_hangup), .choices = hangups,
     .fallback = "detach",
     .meaning =
         "when the terminal goes away: the run goes on, or stops with a checkpoint",
     .source = "numerical"},
};

const struct gb_field *gb_params_fields(size_t *count)
{
    *count = G_N_ELEMENTS(fields);
    return fields;
}

const struct gb_field *gb_params_find(const char *group, const char *key)
{
    for (size_t i = 0; i < G_N_ELEMENTS(fields); i++) {
        if (strcmp(fields[i].group, group) == 0 && strcmp(fields[i].key, key) == 0) {
            return &fields[i];
        }
    }
    return NULL;
}

void gb_params_init(struct gb_params *params)
{
    memset(params, 0, sizeof *params);
    for (size_t i = 0; i < G_N_ELEMENTS(fields); i++) {
        struct gb_error err;
        if (!gb_field_read(&fields[i], params, fields[i].fallback, &err)) {
            g_assert_not_reached(); /* a row of the table is wrong; the tests read it */
        }
    }
}

bool gb_params_set(struct gb_params *params, const struct gb_field *field,
                   const char *text, struct gb_error *err)
{
    return gb_field_read(field, params, text, err);
}

char *gb_params_format(const struct gb_params *params, const struct gb_field *field,
                       char *buffer, size_t size)
{
    return gb_field_write(field, params, buffer, size);
}

char *gb_params_accepted(const struct gb_field *field, char *buffer, size_t size)
{
    return gb_field_accepted(field, buffer, size);
}

/* Lists the keys of a group, or all groups when there is no such group. */
static bool unknown_key(const char *group, const char *key, struct gb_error *err)
{
    GString *keys = g_string_new(NULL), *groups = g_string_new(NULL);
    const char *last = "";
    for (size_t i = 0; i < G_N_ELEMENTS(fields); i++) {
        if (strcmp(fields[i].group, group) == 0) {
            g_string_append_printf(keys, "%s%s", keys->len ? ", " : "", fields[i].key);
        }
        if (strcmp(fields[i].group, last) != 0) {
            last = fields[i].group;
            g_string_append_printf(groups, "%s%s", groups->len ? ", " : "", last);
        }
    }
    gb_error_set(err, GB_ERR_INPUT, "%.40s.%.40s: no such %s; accepted %s", group, key,
                 keys->len ? "key" : "group", keys->len ? keys->str : groups->str);
    g_string_free(keys, TRUE);
    g_string_free(groups, TRUE);
    return false;
}

static bool assign_parts(struct gb_params *params, char *name, const char *value,
                         struct gb_error *err)
{
    char *dot = strchr(name, '.');
    if (!dot) {
        return gb_error_set(err, GB_ERR_INPUT, "%.80s: accepted group.key=value", name);
    }
    *dot = '\0';
    const char *key = dot + 1;
    const struct gb_field *field = gb_params_find(name, key);
    return field ? gb_params_set(params, field, value, err) : unknown_key(name, key, err);
}

bool gb_params_assign(struct gb_params *params, const char *assignment,
                      struct gb_error *err)
{
    char *name = g_strdup(assignment);
    char *equals = strchr(name, '=');
    bool good = false;
    if (equals) {
        *equals = '\0';
        good = assign_parts(params, g_strstrip(name), equals + 1, err);
    } else {
        gb_error_set(err, GB_ERR_INPUT, "%.80s: accepted group.key=value", assignment);
    }
    g_free(name);
    return good;
}

/* sigma_b when the preset leaves it open, in E.  With bridges: P1's set II.  Without: P1
 * calls mu the only free parameter of such scenes, and with 0.018 E the strength, not mu,
 * would limit the friction of the finest powders (density differences at 100 MPa come out
 * a fifth too small). No shear spring ever carries E. */
static const double strength_bridged = 0.018, strength_unlimited = 1.0;

double gb_params_bridge_length_m(const struct gb_params *params)
{
    return gb_field_absolute(gb_params_find("contact", "bridge_length"), params);
}

double gb_params_shear_strength_pa(const struct gb_params *params)
{
    if (isnan(params->shear_strength.value)) {
        const bool bridges =
            gb_params_bridge_length_m(params) < gb_params_reference_m(params);
        return (bridges ? strength_bridged : strength_unlimited) * params->young_pa;
    }
    return gb_field_absolute(gb_params_find("contact", "shear_strength"), params);
}

double gb_params_median_m(const struct gb_params *params)
{
    return isnan(params->median_m) ? params->diameter_m : params->median_m;
}

double gb_params_hollomon_pa(const struct gb_params *params)
{
    return isnan(params->hollomon_pa)
               ? gb_law_storakers_hollomon(params->yield_pa, params->young_pa,
                                           params->hardening)
               : params->hollomon_pa;
}

double gb_params_structure_density(const struct gb_params *params)
{
    if (!isnan(params->structure_density)) {
        return params->structure_density;
    }
    return params->dimension == 2 ? 0.5 : 0.24;
}

double gb_params_unit_time_s(const struct gb_params *params)
{
    return params->diameter_m *
           sqrt(M_PI * params->density_kg_m3 / (6.0 * params->young_pa));
}

double gb_params_time_step_s(const struct gb_params *params)
{
    return gb_field_absolute(gb_params_find("numerics", "time_step"), params);
}

double gb_params_reference_m(const struct gb_params *params)
{
    struct gb_sizes sizes;
    return gb_sizes_polydisperse(params) && gb_sizes_init(&sizes, params, NULL)
               ? gb_sizes_moment(&sizes, 1)
               : params->diameter_m;
}

/* Mean of (diameter/d)^3. */
static double mean_cube(const struct gb_params *params)
{
    struct gb_sizes sizes;
    return gb_sizes_polydisperse(params) && gb_sizes_init(&sizes, params, NULL)
               ? gb_sizes_moment(&sizes, 3) / pow(gb_sizes_moment(&sizes, 1), 3.0)
               : 1.0;
}

/* Base of the initial cell in diameters.  auto in 3D: P1's 18 d for 8000 particles at
 * density 0.24 and the same aspect ratio for other volumes. */
static double base_edge(const struct gb_params *params, double volume)
{
    if (params->base.relative && params->base.value == 0.0) {
        const double share = (double)params->count * mean_cube(params) / 8000.0 *
                             (0.24 / gb_params_structure_density(params));
        return params->dimension == 2 ? sqrt(volume) : 18.0 * cbrt(share);
    }
    return params->base.relative ? params->base.value
                                 : params->base.value / gb_params_reference_m(params);
}

void gb_params_cell(const struct gb_params *params, double edges[3])
{
    const double particle = params->dimension == 2 ? M_PI / 4.0 : M_PI / 6.0;
    const double volume = (double)params->count * mean_cube(params) * particle /
                          gb_params_structure_density(params);
    const double base = base_edge(params, volume);
    edges[0] = base;
    edges[1] = params->dimension == 2 ? 1.0 : base;
    edges[2] = volume / (edges[0] * edges[1]);
}

/* A program may have filled the struct itself: every value against its own row. */
bool gb_params_check_fields(const struct gb_params *params, struct gb_error *err)
{
    for (size_t i = 0; i < G_N_ELEMENTS(fields); i++) {
        if (!gb_field_valid(&fields[i], params)) {
            char value[256], accepted[256];
            gb_params_format(params, &fields[i], value, sizeof value);
            gb_params_accepted(&fields[i], accepted, sizeof accepted);
            return gb_error_set(err, GB_ERR_INPUT, "%s.%s = %.80s: accepted %s",
                                fields[i].group, fields[i].key, value, accepted);
        }
    }
    return true;
}

/* Of the diameters of the particles. */
static double largest_over_mean(const struct gb_params *params)
{
    struct gb_sizes sizes;
    double least = 1.0, largest = 1.0;
    if (!gb_sizes_polydisperse(params) || !gb_sizes_init(&sizes, params, NULL)) {
        return 1.0;
    }
    gb_sizes_range(&sizes, params->count, &least, &largest);
    return largest / gb_sizes_moment(&sizes, 1);
}

/* Two particles must meet through one periodic image only: an edge has room for twice the
 * reach of the neighbour list. */
static bool check_cell(const struct gb_params *params, struct gb_error *err)
{
    static const char axes[] = "xyz";
    double reach = 1.5;
    if (!isnan(params->cutoff.value)) {
        const double cutoff =
            gb_field_absolute(gb_params_find("numerics", "cutoff"), params);
        reach = fmax(reach, cutoff / gb_params_reference_m(params));
    }
    reach += largest_over_mean(params) - 1.0;
    double edges[3];
    gb_params_cell(params, edges);
    for (int k = 0; k < 3; k++) {
        if ((params->dimension == 3 || k != 1) && !(edges[k] >= 2.0 * reach)) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "particles.count = %" G_GINT64_FORMAT
                                " and structure.base give a cell of %.3g d along %c: "
                                "accepted %g d or more",
                                params->count, edges[k], axes[k], 2.0 * reach);
        }
    }
    return true;
}

static bool check_programme(const struct gb_params *params, struct gb_error *err)
{
    const double start = gb_params_structure_density(params);
    if (!isnan(params->until_density) && !(params->until_density > start)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.until = density = %g: accepted above "
                            "structure.density = %g",
                            params->until_density, start);
    }
    if (!isnan(params->until_pressure_pa) && params->unload_count > 0) {
        char from[64], until[64];
        const double last = params->unload_from_pa[params->unload_count - 1];
        if (last > params->until_pressure_pa) {
            gb_units_format(last, GB_DIM_PRESSURE, from, sizeof from);
            gb_units_format(params->until_pressure_pa, GB_DIM_PRESSURE, until,
                            sizeof until);
            return gb_error_set(err, GB_ERR_INPUT,
                                "loading.unload_from = %s: accepted up to "
                                "loading.until = %s",
                                from, until);
        }
    }
    if (params->dimension == 2 && params->geometry == GB_GEOMETRY_BIAXIAL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "loading.geometry = biaxial: accepted uniaxial or isotropic "
                            "with scene.dimension = 2, which has x and z only");
    }
    return true;
}

/* Spheres and walls of a die press on each other by Hertz and Storakers; the periodic
 * cells of P1 and P2 carry the rod model, those at rest also dry grains of one size. */
static bool check_normal(const struct gb_params *params, struct gb_error *err)
{
    const bool still = params->kind == GB_KIND_QUASISTATIC;
    if (params->normal == GB_NORMAL_ROD ||
        (params->normal == GB_NORMAL_HERTZ && still && !gb_sizes_polydisperse(params))) {
        return true;
    }
    if (params->normal == GB_NORMAL_HERTZ && still) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "contact.normal = hertz: accepted rod with "
                            "particles.distribution = %s",
                            distributions[params->distribution]);
    }
    return gb_error_set(
        err, GB_ERR_INPUT, "contact.normal = %s: accepted rod%s with scene.kind = %s",
        normals[params->normal], still ? " or hertz" : "", kinds[params->kind]);
}

bool gb_params_check(const struct gb_params *params, struct gb_error *err)
{
    struct gb_keep_points marks;
    if (!gb_params_check_fields(params, err) ||
        !gb_size_table_check_params(params, err) ||
        !gb_keep_points_parse(params->snapshots_at, &marks, err)) {
        return false;
    }
    if (params->kind == GB_KIND_DIE) {
        return gb_die_scene_check(params, err) && gb_changes_check(params, err);
    }
    return check_normal(params, err) && check_cell(params, err) &&
           check_programme(params, err) && gb_dynamic_scene_check(params, err) &&
           gb_changes_check(params, err);
}
