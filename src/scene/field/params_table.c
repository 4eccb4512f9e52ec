#include "scene/field/params_table.h"

#include <math.h>
#include <stddef.h>

#include <glib.h>

#include "base/units.h"
#include "scene/derived.h"
#include "scene/imported/imported.h"
#include "scene/loading_kind.h"

static const char *const kinds[] = {"quasistatic", "dynamic", "die", NULL};
static const char *const dimensions[] = {"3", "2", NULL};
static const char *const distributions[] = {"mono", "lognormal", "table", NULL};
static const char *const normals[] = {"rod", "hertz", "storakers", NULL};
static const char *const storakers[] = {"capped", "printed", NULL};
static const char *const structures[] = {"grown",   "sc",     "fcc",       "bcc",
                                         "diamond", "square", "hexagonal", NULL};
static const char *const radii[] = {"deepest", "current", NULL};
static const char *const motions[] = {"half", "full", NULL};
static const char *const viscous[] = {"all", "translation", "normal", NULL};
static const char *const geometries[] = {"uniaxial", "biaxial", "isotropic", "die", NULL};
static const char *const cycles[] = {"press", "full", NULL};
static const char *const ramps[] = {"auto", "linear", "quadratic", NULL};
static const char *const exports[] = {"none", "extxyz", "lammps-dump", "lammps-data",
                                      "csv",  "vtkhdf", NULL};
static const char *const hangups[] = {"detach", "stop", NULL};
static const char *const collapses[] = {"stop", "strain", NULL};
static const char *const fidelities[] = {"fast", "balanced", "reference", NULL};
static const char *const precisions[] = {"auto", "double", "single", NULL};
static const char *const tolerance_scales[] = {"contact", "attraction", "displacement",
                                               NULL};
static const char *const relaxers[] = {"auto", "predict", "fire", "steepest", NULL};

/* Member of gb_params, as offset and size. */
#define AT(member)                                                                       \
    .offset = offsetof(struct gb_params, member),                                        \
    .size = sizeof(((struct gb_params *)0)->member)
#define RANGE(low, high) .min = (low), .max = (high)
#define AUTO(value)      .auto_allowed = true, .automatic = (value)

/* Kinds of scenes and laws that use a key. */
enum {
    QUASISTATIC = 1u << GB_KIND_QUASISTATIC,
    DYNAMIC = 1u << GB_KIND_DYNAMIC,
    CELL = QUASISTATIC | DYNAMIC,
    DIE = 1u << GB_KIND_DIE,
    ROD = 1u << GB_NORMAL_ROD,
    STORAKERS = 1u << GB_NORMAL_STORAKERS
};

/* Further conditions for a scene to use a key (.applies). */
static bool mono(const struct gb_params *params)
{
    return params->distribution == GB_DISTRIBUTION_MONO;
}

static bool lognormal(const struct gb_params *params)
{
    return params->distribution == GB_DISTRIBUTION_LOGNORMAL;
}

static bool table(const struct gb_params *params)
{
    return params->distribution == GB_DISTRIBUTION_TABLE;
}

static bool with_path(const struct gb_params *params)
{
    return gb_loading_kind_follows_path(params);
}

static bool without_path(const struct gb_params *params)
{
    return !with_path(params);
}

static bool generated(const struct gb_params *params)
{
    return !gb_imported_given(params);
}

static bool grown(const struct gb_params *params)
{
    return generated(params) && params->structure == GB_STRUCTURE_GROWN;
}

static bool lattice(const struct gb_params *params)
{
    return generated(params) && !grown(params);
}

static bool bridged(const struct gb_params *params)
{
    return gb_derived_bridge_length_m(params) < gb_derived_reference_m(params);
}

/* Keys of the second body of `greenbody law`; scenes have one material. */
static bool never(const struct gb_params *params)
{
    (void)params;
    return false;
}

/* One row per preset key; the order is that of preset files and of `greenbody params`. */
static const struct gb_field rows[] = {
    {"scene", "title", GB_FIELD_TEXT, AT(title), .fallback = "",
     .meaning = "name of the scene in figures and run directories", .source = "user",
     .no_result = true},
    {"scene", "kind", GB_FIELD_CHOICE, AT(kind), .choices = kinds,
     .fallback = "quasistatic",
     .meaning = "quasi-static strain steps; Newton's equations of motion; die compaction",
     .source = "P1 III, P2 (1), P3 5", .words = "quasi-static, dynamics, die compaction"},
    {"scene", "dimension", GB_FIELD_CHOICE, AT(dimension), .choices = dimensions,
     .fallback = "3", .meaning = "spheres in space, or discs in the x-z plane",
     .source = "P1, P2", .words = "2D, 3D, discs, spheres", .kinds = CELL},

    {"material", "name", GB_FIELD_TEXT, AT(material), .fallback = "alumina",
     .meaning = "name of the material, a label: material=NAME sets all keys of it",
     .source = "user"},
    {"material", "young", GB_FIELD_NUMBER, AT(young_pa), .dimension = GB_DIM_PRESSURE,
     RANGE(1e3, 1e13), .fallback = "382 GPa", .meaning = "Young's modulus E",
     .source = "P1 V", .symbol = "<i>E</i>",
     .words = "E, Young, elastic modulus, modulus, stiffness"},
    {"material", "poisson", GB_FIELD_NUMBER, AT(poisson), RANGE(0.0, 0.49),
     .fallback = "0.25", .meaning = "Poisson's ratio nu", .source = "P1 V",
     .symbol = "<i>ν</i>", .words = "nu, Poisson ratio"},
    {"material", "density", GB_FIELD_NUMBER, AT(density_kg_m3),
     .dimension = GB_DIM_MASS_DENSITY, RANGE(1.0, 1e5), .fallback = "3990 kg/m3",
     .meaning = "mass density of the solid (no effect in quasi-static runs)",
     .source = "handbook value for alumina", .symbol = "<i>ρ</i><sub>s</sub>",
     .words = "rho, true density, mass density", .kinds = DYNAMIC | DIE},
    {"material", "d0", GB_FIELD_NUMBER, AT(d0_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-11, 1e-8), .fallback = "0.392 nm",
     .meaning = "molecular diameter of the dispersion law", .source = "P1 (3)",
     .symbol = "<i>d</i><sub>0</sub>", .laws = ROD},
    {"material", "n_d0_cubed", GB_FIELD_NUMBER, AT(n_d0_cubed), RANGE(0.0, 10.0),
     .fallback = "1.4142135623730951",
     .meaning = "number of molecules per d0^3; sqrt 2 is close packing",
     .source = "P1 (3)",
     .symbol = "<i>n</i><sub>0</sub> <i>d</i><sub>0</sub><sup>3</sup>", .laws = ROD},
    {"material", "epsilon", GB_FIELD_NUMBER, AT(epsilon_j), .dimension = GB_DIM_ENERGY,
     RANGE(0.0, 1e5 * GB_BOLTZMANN_J_K), .fallback = "1224 kB",
     .meaning = "energy of the dispersion law; 0: no attraction", .source = "P1 (3)",
     .symbol = "<i>ε</i>",
     .words = "attraction, adhesion, cohesion, van der Waals, dispersion, surface energy",
     .laws = ROD},
    {"material", "yield", GB_FIELD_NUMBER, AT(yield_pa), .dimension = GB_DIM_PRESSURE,
     RANGE(1e3, 1e12), .fallback = "800 MPa",
     .meaning = "yield stress sigma_Y of a plastic material", .source = "P3 Table 2",
     .symbol = "<i>σ</i><sub>Y</sub>",
     .words = "sigma_Y, yield strength, plasticity, hardness", .laws = STORAKERS},
    {"material", "hardening", GB_FIELD_NUMBER, AT(hardening), RANGE(0.0, 0.5),
     .fallback = "0", .meaning = "exponent m of Hollomon's sigma = sigma_0 eps^m",
     .source = "P3 (15)", .symbol = "<i>m</i>", .words = "m, strain hardening",
     .laws = STORAKERS},
    {"material", "hollomon", GB_FIELD_NUMBER, AT(hollomon_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(1e3, 1e13), AUTO(NAN), .fallback = "auto",
     .meaning = "strength coefficient sigma_0; auto is yield (young/yield)^hardening",
     .source = "P3 (15), 4", .symbol = "<i>σ</i><sub>0</sub>",
     .words = "sigma_0, strength coefficient", .laws = STORAKERS},
    {"material", "young_j", GB_FIELD_NUMBER, AT(young_j_pa), .dimension = GB_DIM_PRESSURE,
     RANGE(1e3, 1e13), AUTO(NAN), .fallback = "auto",
     .meaning = "Young's modulus of the second body of a pair; auto is young",
     .source = "P3 (3)", .applies = never},
    {"material", "poisson_j", GB_FIELD_NUMBER, AT(poisson_j), RANGE(0.0, 0.49), AUTO(NAN),
     .fallback = "auto",
     .meaning = "Poisson's ratio of the second body of a pair; auto is poisson",
     .source = "P3 (3)", .applies = never},
    {"material", "density_j", GB_FIELD_NUMBER, AT(density_j_kg_m3),
     .dimension = GB_DIM_MASS_DENSITY, RANGE(1.0, 1e5), AUTO(NAN), .fallback = "auto",
     .meaning = "mass density of the second body of a pair; auto is density",
     .source = "P3 (8)", .applies = never},
    {"material", "yield_j", GB_FIELD_NUMBER, AT(yield_j_pa), .dimension = GB_DIM_PRESSURE,
     RANGE(1e3, 1e12), AUTO(NAN), .fallback = "auto",
     .meaning = "yield stress of the second body of a pair; auto is yield",
     .source = "P3 (18)", .applies = never},

    {"particles", "count", GB_FIELD_INTEGER, AT(count), RANGE(10.0, 1e7),
     .fallback = "8000", .meaning = "number of particles in the periodic cell",
     .source = "P1 III", .symbol = "<i>N</i>",
     .words = "N, number of particles, particle number"},
    {"particles", "diameter", GB_FIELD_NUMBER, AT(diameter_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1e-3), .fallback = "10 nm", .meaning = "particle diameter d",
     .source = "P1 V", .symbol = "<i>d</i>",
     .words = "d, size, particle size, grain size, radius", .applies = mono},
    {"particles", "distribution", GB_FIELD_CHOICE, AT(distribution),
     .choices = distributions, .fallback = "mono",
     .meaning = "one size, a log-normal law by number, or a table of sizes",
     .source = "P1 III, P1 (17), P3 5",
     .words = "size, size distribution, sizes, polydispersity", .applies = generated},
    {"particles", "median", GB_FIELD_NUMBER, AT(median_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1e-3), AUTO(NAN), .fallback = "auto",
     .meaning = "median of a log-normal law, exp(m) in P1; auto is particles.diameter",
     .source = "P1 (17)", .symbol = "<i>d</i><sub>50,0</sub>",
     .words = "size, d50, log-normal", .applies = lognormal},
    {"particles", "sigma", GB_FIELD_NUMBER, AT(sigma), RANGE(1e-3, 1.0),
     .fallback = "0.5", .meaning = "standard deviation of ln d in a log-normal law",
     .source = "P1 (17)", .symbol = "<i>s</i>",
     .words = "size, width, standard deviation, polydispersity, log-normal",
     .applies = lognormal},
    {"particles", "least", GB_FIELD_NUMBER, AT(diameter_min_m),
     .dimension = GB_DIM_LENGTH, RANGE(1e-9, 1e-3), AUTO(NAN), .fallback = "auto",
     .meaning = "diameter below which a log-normal law is cut; auto: not cut",
     .source = "P3 5", .symbol = "<i>d</i><sub>min</sub>",
     .words = "size, smallest size, log-normal", .applies = lognormal},
    {"particles", "largest", GB_FIELD_NUMBER, AT(diameter_max_m),
     .dimension = GB_DIM_LENGTH, RANGE(1e-9, 1e-3), AUTO(NAN), .fallback = "auto",
     .meaning = "diameter above which a log-normal law is cut; auto: not cut",
     .source = "P3 5", .symbol = "<i>d</i><sub>max</sub>",
     .words = "size, largest size, log-normal", .applies = lognormal},
    {"particles", "table", GB_FIELD_SIZES, AT(sizes), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1e-3), .fallback = "",
     .meaning = "diameters and their shares for distribution = table; kept as one line",
     .source = "P3 5", .words = "size, size table, sieve", .applies = table},

    {"contact", "normal", GB_FIELD_CHOICE, AT(normal), .choices = normals,
     .fallback = "rod",
     .meaning =
         "normal force law: rod model with attraction and bridges, or cohesionless: "
         "Hertz, in a die also Storakers",
     .source = "P1 (1); P3 (2), (16)",
     .words = "contact law, force law, Hertz, rod model"},
    {"contact", "alpha", GB_FIELD_NUMBER, AT(alpha), RANGE(0.05, 10.0),
     .fallback = "0.24",
     .meaning = "minimum surface gap alpha of the dispersion force, in d0",
     .source = "P1 (3), V", .symbol = "<i>α</i>",
     .words = "surface gap, attraction, adhesion, cohesion, dispersion", .laws = ROD,
     .may_change = true},
    {"contact", "mu", GB_FIELD_NUMBER, AT(mu), RANGE(0.0, 2.0), .fallback = "0.1",
     .meaning = "friction coefficient of sliding", .source = "P1 (5), V",
     .symbol = "<i>μ</i>", .words = "friction, friction coefficient, sliding, slip",
     .may_change = true},
    {"contact", "mu_wall", GB_FIELD_NUMBER, AT(mu_wall), RANGE(0.0, 2.0),
     .fallback = "0.02",
     .meaning = "friction coefficient of the walls of a die, in filling and pressing",
     .source = "P3 5", .symbol = "<i>μ</i><sub>w</sub>",
     .words = "wall friction, die friction", .kinds = DIE},
    {"contact", "mu_pivot", GB_FIELD_NUMBER, AT(mu_pivot), RANGE(0.0, 2.0), AUTO(NAN),
     .fallback = "auto", .meaning = "friction coefficient in pivoting; auto is mu",
     .source = "P1 (8)", .symbol = "<i>μ</i><sub>p</sub>",
     .words = "pivoting, twisting, torsion, pivoting friction", .laws = ROD,
     .may_change = true},
    {"contact", "bridge_length", GB_FIELD_RELATIVE, AT(bridge_length),
     .dimension = GB_DIM_LENGTH, .relative = "d", RANGE(1e-5, HUGE_VAL),
     .fallback = "0.008 d",
     .meaning = "overlap at which a solid bridge forms; 1 d or more: no bridges",
     .source = "P1 (2), V", .symbol = "Δ<i>r</i><sub>ch</sub>",
     .words = "bridge, solid bridge, neck, sintering, d_r,ch", .laws = ROD,
     .may_change = true},
    {"contact", "shear_strength", GB_FIELD_RELATIVE, AT(shear_strength),
     .dimension = GB_DIM_PRESSURE, .relative = "E", RANGE(0.0, 1.0), AUTO(NAN),
     .fallback = "auto",
     .meaning = "shear strength sigma_b; auto is 0.018 E, and no limit without bridges",
     .source = "P1 (4), (5), V", .symbol = "<i>σ</i><sub>b</sub>",
     .words = "sigma_b, bridge strength, bond strength, neck", .laws = ROD,
     .may_change = true},
    {"contact", "bridge_radius", GB_FIELD_CHOICE, AT(bridge_radius), .choices = radii,
     .fallback = "deepest",
     .meaning =
         "bridge radius from the largest overlap so far, or from the current overlap",
     .source = "P1 II.A", .words = "neck radius", .laws = ROD, .applies = bridged},
    {"contact", "relative_motion", GB_FIELD_CHOICE, AT(relative_motion),
     .choices = motions, .fallback = "half",
     .meaning = "share of the relative motion applied to a tangential spring",
     .source = "P1 II.B", .laws = ROD},
    {"contact", "viscosity", GB_FIELD_NUMBER, AT(viscosity_pa_s),
     .dimension = GB_DIM_VISCOSITY, RANGE(0.0, 1e3), .fallback = "1 mPa s",
     .meaning =
         "shear viscosity eta of the solid in dynamic scenes; 0: no viscous forces",
     .source = "P2 (3)", .symbol = "<i>η</i>",
     .words = "eta, viscous forces, dissipation", .kinds = DYNAMIC},
    {"contact", "viscous_forces", GB_FIELD_CHOICE, AT(viscous_forces), .choices = viscous,
     .fallback = "all",
     .meaning =
         "forces with a viscous partner: all, all but rolling and pivoting, or the "
         "normal one",
     .source = "P2 (3)", .kinds = DYNAMIC},
    {"contact", "damping", GB_FIELD_NUMBER, AT(damping), RANGE(0.0, 10.0),
     .fallback = "0.9",
     .meaning = "normal damping xi of hertz and storakers, as a fraction of the critical",
     .source = "P3 (7), 5", .symbol = "<i>ξ</i>", .words = "xi, restitution, dissipation",
     .kinds = DIE},
    {"contact", "shear_ratio", GB_FIELD_NUMBER, AT(shear_ratio), RANGE(0.01, 100.0),
     .fallback = "1", .meaning = "tangential over normal stiffness with storakers",
     .source = "P3 (21)", .symbol = "<i>k</i><sub>t</sub> / <i>k</i><sub>n</sub>",
     .laws = STORAKERS},
    {"contact", "storakers", GB_FIELD_CHOICE, AT(storakers), .choices = storakers,
     .fallback = "capped",
     .meaning = "capped by Hertz' force, or as printed, which can generate energy",
     .source = "P3 (16), 4", .laws = STORAKERS},
    {"contact", "radius_i", GB_FIELD_NUMBER, AT(radius_i_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-10, 1e-2), .infinite = "wall", AUTO(NAN), .fallback = "auto",
     .meaning = "radius of the first body of a pair; auto is half the diameter",
     .source = "P3 (4)", .words = "size", .applies = never},
    {"contact", "radius_j", GB_FIELD_NUMBER, AT(radius_j_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-10, 1e-2), .infinite = "wall", AUTO(NAN), .fallback = "auto",
     .meaning = "radius of the second body of a pair; auto is half the diameter",
     .source = "P3 (4)", .words = "size", .applies = never},

    {"structure", "kind", GB_FIELD_CHOICE, AT(structure), .choices = structures,
     .fallback = "grown",
     .meaning = "initial structure: grown from chains, or a lattice of whole unit cells",
     .source = "P1 III; crystallography", .words = "initial structure, lattice, crystal",
     .kinds = CELL, .applies = generated},
    {"structure", "from", GB_FIELD_PACKING, AT(from), .fallback = "",
     .meaning = "file of a packing to press: particles and cell are taken from it",
     .source = "user", .words = "import, tomography, LAMMPS, Yade"},
    {"structure", "overlap", GB_FIELD_NUMBER, AT(overlap), RANGE(1e-6, 0.45),
     .fallback = "0.01", .meaning = "overlap of nearest neighbours in a lattice, h/d",
     .source = "user", .symbol = "<i>h</i> / <i>d</i>", .kinds = CELL,
     .applies = lattice},
    {"structure", "density", GB_FIELD_NUMBER, AT(structure_density), RANGE(0.01, 0.74),
     AUTO(NAN), .fallback = "auto",
     .meaning =
         "relative density of the initial structure; auto is 0.24 in 3D, 0.5 in 2D",
     .source = "P1 III, P2", .symbol = "<i>ρ</i><sub>0</sub>",
     .words = "initial density, packing fraction, porosity", .kinds = CELL,
     .applies = grown},
    {"structure", "base", GB_FIELD_RELATIVE, AT(base), .dimension = GB_DIM_LENGTH,
     .relative = "d", RANGE(3.0, 1e4), AUTO(0.0), .fallback = "auto",
     .meaning = "edges x and y of the cell; auto is P1's aspect ratio, a square in 2D",
     .source = "P1 III", .words = "cell size, cell width, aspect ratio", .kinds = CELL,
     .applies = grown},
    {"structure", "r_meso", GB_FIELD_RELATIVE, AT(r_meso), .dimension = GB_DIM_LENGTH,
     .relative = "d", RANGE(1.0, 10.0), .fallback = "2 d",
     .meaning = "radius within which neighbours are counted in aggregate growth",
     .source = "P1 III", .symbol = "<i>r</i><sub>meso</sub>",
     .words = "aggregates, agglomerates", .kinds = CELL, .applies = grown},
    {"structure", "single_contact", GB_FIELD_NUMBER, AT(single_contact), RANGE(0.0, 1.0),
     .fallback = "0",
     .meaning = "share of the particles that growth places in contact with one other "
                "particle, not two",
     .source = "P1 III: 0", .kinds = CELL, .applies = grown},
    {"structure", "seed", GB_FIELD_SEED, AT(seed), .fallback = "1",
     .meaning = "seed of the random number generator", .source = "numerical",
     .words = "random number"},

    {"die", "diameter", GB_FIELD_NUMBER, AT(die_diameter_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1.0), .fallback = "58 um", .meaning = "diameter of the cylinder",
     .source = "P3 5", .symbol = "<i>D</i>", .words = "bore, die size", .kinds = DIE},
    {"die", "height", GB_FIELD_NUMBER, AT(die_height_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 10.0), AUTO(NAN), .fallback = "auto",
     .meaning = "height of the funnel over the floor; auto: room for a loose filling",
     .source = "numerical", .words = "funnel height", .kinds = DIE},
    {"die", "outlet", GB_FIELD_NUMBER, AT(die_outlet_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1.0), AUTO(NAN), .fallback = "auto",
     .meaning = "diameter of the funnel's outlet; auto: 3/4 of the die",
     .source = "numerical", .words = "funnel outlet", .kinds = DIE},
    {"die", "angle", GB_FIELD_NUMBER, AT(die_angle_deg), RANGE(5.0, 80.0),
     .fallback = "35", .meaning = "angle between the funnel's wall and its axis, degrees",
     .source = "numerical", .words = "funnel angle, hopper", .kinds = DIE},
    {"die", "fill_gravity", GB_FIELD_NUMBER, AT(fill_gravity), RANGE(1.0, 1e8),
     .fallback = "200000",
     .meaning = "gravity during filling, in g; computing time grows as it falls",
     .source = "numerical", .words = "filling", .kinds = DIE},
    {"die", "gravity", GB_FIELD_NUMBER, AT(rest_gravity), RANGE(1e-3, 1e8),
     .fallback = "200", .meaning = "gravity at rest and during compaction, in g",
     .source = "numerical", .words = "weight", .kinds = DIE},
    {"die", "ease", GB_FIELD_NUMBER, AT(gravity_ramp_s), .dimension = GB_DIM_TIME,
     RANGE(1e-9, 1.0), .fallback = "20 us",
     .meaning = "time over which gravity is reduced after filling", .source = "numerical",
     .kinds = DIE},
    {"die", "flatten", GB_FIELD_NUMBER, AT(flatten_m), .dimension = GB_DIM_LENGTH,
     RANGE(0.0, 1.0), .fallback = "3 um",
     .meaning = "punch travel from first contact when the surface is flattened",
     .source = "P3 5", .kinds = DIE},
    {"die", "punch_mass", GB_FIELD_NUMBER, AT(punch_mass), RANGE(1e-3, 100.0),
     .fallback = "0.1",
     .meaning =
         "mass of the punch over the mass of the powder; above 1 its inertia delays it",
     .source = "numerical", .words = "punch", .kinds = DIE},
    {"die", "central", GB_FIELD_NUMBER, AT(central_m), .dimension = GB_DIM_LENGTH,
     RANGE(1e-9, 1.0), .fallback = "54 um",
     .meaning = "diameter of the sphere of the central relative density",
     .source = "P3 5", .words = "central region", .kinds = DIE},
    {"die", "cycle", GB_FIELD_CHOICE, AT(die_cycle), .choices = cycles,
     .fallback = "press",
     .meaning = "press: the run ends at full pressure; full: unloading, punch off, "
                "ejection and rest follow",
     .source = "numerical", .words = "ejection, springback", .kinds = DIE},
    {"die", "eject_speed", GB_FIELD_NUMBER, AT(eject_m_s), .dimension = GB_DIM_SPEED,
     RANGE(1e-6, 100.0), .fallback = "1 m/s",
     .meaning = "speed at which the compact is pushed out of the die, and the punch "
                "taken off",
     .source = "numerical", .symbol = "<i>v</i><sub>e</sub>", .words = "ejection",
     .kinds = DIE},
    {"die", "weld_strength", GB_FIELD_NUMBER, AT(weld_strength_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(0.0, 1e12), .fallback = "0 Pa",
     .meaning = "tensile strength of cold welds that contacts form under the full "
                "pressure of a full cycle; 0: none, the ejected compact falls apart",
     .source = "Potyondy & Cundall 2004", .symbol = "<i>σ</i><sub>w</sub>",
     .words = "cold weld, weld, green strength", .kinds = DIE},

    {"loading", "geometry", GB_FIELD_CHOICE, AT(geometry), .choices = geometries,
     .fallback = "uniaxial", .meaning = "compressed axes: z; y and z; all; or a die",
     .source = "P1 III, VI", .words = "loading mode, compression mode",
     .applies = without_path, .may_change = true},
    {"loading", "step", GB_FIELD_NUMBER, AT(strain_step), .dimension = GB_DIM_FRACTION,
     RANGE(1e-6, 0.02), .fallback = "0.1 %",
     .meaning = "strain step: shrinkage of an axis over its current length",
     .source = "P1 III", .symbol = "Δ<i>ε</i>", .words = "strain step, strain increment",
     .kinds = QUASISTATIC, .may_change = true},
    {"loading", "until", GB_FIELD_UNTIL, AT(until_pressure_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(1e3, 1e12), .fallback = "1 GPa",
     .meaning = "pressure or relative density at which loading ends", .source = "P1 V",
     .words = "pressure, maximum pressure, final pressure, compaction pressure",
     .applies = without_path, .may_change = true},
    {"loading", "unload_from", GB_FIELD_PRESSURES, AT(unload_from_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(1e3, 1e12), .fallback = "",
     .meaning = "pressures at which unloading branches start", .source = "P1 V, VI",
     .words = "unloading, springback, unloading pressure", .kinds = QUASISTATIC,
     .applies = without_path},
    {"loading", "path", GB_FIELD_TEXT, AT(path), .fallback = "",
     .meaning = "loading path instead of geometry, until and unload_from: legs "
                "separated by ';', as isotropic to 50 MPa; shear xz to 20 % at z = 50 "
                "MPa; unload",
     .source = "docs/mechanics.md", .words = "legs, shear, cyclic loading, creep",
     .kinds = QUASISTATIC, .may_change = true},
    {"loading", "on_collapse", GB_FIELD_CHOICE, AT(on_collapse), .choices = collapses,
     .fallback = "stop",
     .meaning = "where a leg asks for a stress that the packing cannot carry: the run "
                "stops, or continues by strain",
     .source = "docs/mechanics.md", .kinds = QUASISTATIC, .applies = with_path},
    {"loading", "changes", GB_FIELD_TEXT, AT(changes), .fallback = "",
     .meaning = "changed parameters after recorded steps, as 120 contact.mu=0.3; "
                "200 loading.geometry=isotropic",
     .source = "user", .words = "what-if"},
    {"loading", "rate", GB_FIELD_NUMBER, AT(rate_per_s), .dimension = GB_DIM_RATE,
     RANGE(1.0, 1e12), .fallback = "680 1/us",
     .meaning = "densification rate (1/rho) d rho/dt of dynamic scenes",
     .source = "P2 2, v1", .symbol = "<i>v</i>",
     .words = "strain rate, compaction rate, speed", .kinds = DYNAMIC},
    {"loading", "relax", GB_FIELD_NUMBER, AT(relax_s), .dimension = GB_DIM_TIME,
     RANGE(0.0, 1.0), .fallback = "10 ns",
     .meaning = "relaxation time of a dynamic scene before compression", .source = "P2 3",
     .kinds = DYNAMIC},
    {"loading", "hold", GB_FIELD_NUMBER, AT(hold_s), .dimension = GB_DIM_TIME,
     RANGE(0.0, 1.0), .fallback = "30 ns",
     .meaning = "holding time of a dynamic scene at the end density", .source = "P2 3",
     .kinds = DYNAMIC},
    {"loading", "record", GB_FIELD_NUMBER, AT(record_density),
     .dimension = GB_DIM_FRACTION, RANGE(1e-6, 0.1), .fallback = "0.1 %",
     .meaning = "relative density increase between recorded points of a dynamic scene",
     .source = "numerical", .kinds = DYNAMIC},
    {"loading", "record_time", GB_FIELD_NUMBER, AT(record_time_s),
     .dimension = GB_DIM_TIME, RANGE(1e-15, 1.0), .fallback = "20 ps",
     .meaning = "time between recorded points of relax and hold in a dynamic scene",
     .source = "numerical", .kinds = DYNAMIC},
    {"loading", "ramp", GB_FIELD_CHOICE, AT(ramp), .choices = ramps, .fallback = "auto",
     .meaning =
         "punch pressure against time: t or t^2; auto: quadratic if fidelity = fast",
     .source = "P3 5; numerical", .kinds = DIE},
    {"loading", "time", GB_FIELD_NUMBER, AT(ramp_s), .dimension = GB_DIM_TIME,
     RANGE(1e-9, 1.0), AUTO(NAN), .fallback = "auto",
     .meaning = "time to the maximum punch pressure; auto: 100 us, fast 20 us",
     .source = "P3 5; numerical", .words = "pressing time, duration", .kinds = DIE},
    {"loading", "record_pressure", GB_FIELD_NUMBER, AT(record_pressure_pa),
     .dimension = GB_DIM_PRESSURE, RANGE(1.0, 1e12), .fallback = "500 kPa",
     .meaning = "pressure increase between recorded points of a die",
     .source = "numerical", .kinds = DIE},
    {"loading", "unload_time", GB_FIELD_NUMBER, AT(unload_s), .dimension = GB_DIM_TIME,
     RANGE(1e-9, 1.0), AUTO(NAN), .fallback = "auto",
     .meaning = "time from the full punch pressure to none in a full die cycle; auto: "
                "as loading.time",
     .source = "numerical", .kinds = DIE},
    {"loading", "rest_time", GB_FIELD_NUMBER, AT(rest_s), .dimension = GB_DIM_TIME,
     RANGE(1e-9, 1.0), .fallback = "20 us",
     .meaning = "rest in the die with the punch off, and again after ejection",
     .source = "numerical", .kinds = DIE},

    {"numerics", "fidelity", GB_FIELD_CHOICE, AT(fidelity), .choices = fidelities,
     .fallback = "balanced",
     .meaning = "accuracy level; sets every key of this group left at auto",
     .source = "numerical", .words = "accuracy, quality, cost"},
    {"numerics", "relaxer", GB_FIELD_TEXT, AT(relaxer), .choices = relaxers,
     .fallback = "auto", .meaning = "method of relaxing a strain step to equilibrium",
     .source = "P1 (15); numerical", .words = "solver, FIRE, minimiser",
     .kinds = QUASISTATIC},
    {"numerics", "tolerance", GB_FIELD_NUMBER, AT(tolerance), RANGE(1e-12, 0.1),
     AUTO(NAN), .fallback = "auto",
     .meaning = "residual, in units of tolerance_scale, at which a step is relaxed; "
                "predict: a fraction of it under light loads",
     .source = "numerical", .words = "residual, convergence, accuracy",
     .kinds = QUASISTATIC},
    {"numerics", "tolerance_scale", GB_FIELD_CHOICE, AT(tolerance_scale),
     .choices = tolerance_scales, .fallback = "contact",
     .meaning = "unit of numerics.tolerance: the mean contact force; the attraction at "
                "contact; d - r_eq, for the largest displacement of P1 (15)",
     .source = "P1 (15); numerical", .kinds = QUASISTATIC},
    {"numerics", "strain_part", GB_FIELD_NUMBER, AT(strain_part),
     .dimension = GB_DIM_FRACTION, RANGE(1e-6, 0.02), AUTO(NAN), .fallback = "auto",
     .meaning =
         "largest strain of an axis relaxed at once; larger strain steps are divided "
         "into equal parts",
     .source = "numerical"},
    {"numerics", "cutoff", GB_FIELD_RELATIVE, AT(cutoff), .dimension = GB_DIM_LENGTH,
     .relative = "d", RANGE(1.0, 3.0), AUTO(NAN), .fallback = "auto",
     .meaning = "cutoff distance of the attraction", .source = "numerical",
     .symbol = "<i>r</i><sub>c</sub>", .words = "range, reach", .laws = ROD},
    {"numerics", "precision", GB_FIELD_CHOICE, AT(precision), .choices = precisions,
     .fallback = "auto",
     .meaning =
         "of forces and contact histories; auto is single where the tolerance allows "
         "it, in quasi-static scenes in 3D",
     .source = "numerical", .words = "single precision, double precision, float",
     .kinds = QUASISTATIC},
    {"numerics", "threads", GB_FIELD_INTEGER, AT(threads), RANGE(1.0, 1024.0), AUTO(-1.0),
     .fallback = "auto",
     .meaning = "most threads of the force sweep; results do not depend on it",
     .source = "numerical", .words = "cores, processors, parallel", .no_result = true},
    {"numerics", "max_evaluations", GB_FIELD_INTEGER, AT(max_evaluations),
     RANGE(1.0, 1e9), AUTO(-1.0), .fallback = "auto",
     .meaning = "maximum number of force evaluations per strain step",
     .source = "numerical", .words = "iterations", .kinds = QUASISTATIC},
    {"numerics", "time_step", GB_FIELD_RELATIVE, AT(time_step), .dimension = GB_DIM_TIME,
     .relative = "T", RANGE(1e-6, 10.0), AUTO(NAN), .fallback = "auto",
     .meaning =
         "time step of dynamic scenes, T = sqrt(pi rho d^2/(6 E)); auto: step_error",
     .source = "P2 2 (0.04 T)", .symbol = "Δ<i>t</i>", .words = "dt, integration step",
     .kinds = DYNAMIC},
    {"numerics", "step_error", GB_FIELD_NUMBER, AT(step_error),
     .dimension = GB_DIM_FRACTION, RANGE(1e-8, 0.5), .fallback = "0.1 %",
     .meaning = "error in end pressure and energy that an automatic time step may make",
     .source = "numerical", .kinds = DYNAMIC},
    {"numerics", "safety", GB_FIELD_NUMBER, AT(safety), RANGE(1e-4, 10.0), AUTO(NAN),
     .fallback = "auto",
     .meaning =
         "share of the critical time step taken in a die; auto: fast 0.9, balanced 0.5, "
         "reference 0.1",
     .source = "P3 (26)", .kinds = DIE},
    {"numerics", "inertia_scale", GB_FIELD_NUMBER, AT(inertia_scale), RANGE(1.0, 1e4),
     .fallback = "10",
     .meaning = "factor on the rotational inertia of particles in a die",
     .source = "P3 3.4", .kinds = DIE},

    {"output", "snapshots_at", GB_FIELD_TEXT, AT(snapshots_at), .fallback = "",
     .meaning = "points of the loading path at which states are kept, as 100 MPa; "
                "density = 0.5; every 20 (recorded points)",
     .source = "user", .words = "states, pictures", .no_result = true},
    {"output", "export", GB_FIELD_CHOICE, AT(export_format), .choices = exports,
     .fallback = "none",
     .meaning = "states kept by snapshots_at for other programs, written along the run",
     .source = "user", .words = "ParaView, OVITO, LAMMPS, VTK, trajectory",
     .no_result = true},
    {"output", "checkpoint_every", GB_FIELD_NUMBER, AT(checkpoint_every_s),
     .dimension = GB_DIM_TIME, RANGE(0.1, 604800.0), .fallback = "60 s",
     .meaning = "time between checkpoints of a run", .source = "numerical",
     .words = "saving, restart", .no_result = true},
    {"output", "on_hangup", GB_FIELD_CHOICE, AT(on_hangup), .choices = hangups,
     .fallback = "detach",
     .meaning = "when the terminal closes: the run continues, or stops with a checkpoint",
     .source = "numerical", .words = "SSH, disconnection", .no_result = true},
};

const struct gb_field *gb_params_table(size_t *count)
{
    *count = G_N_ELEMENTS(rows);
    return rows;
}
