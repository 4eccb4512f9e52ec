/* The same scene in other units: written otherwise in a preset, or measured with other
 * metres, pascals and kilograms.  Reduced model and packing are the same. */
#include <glib.h>
#include <math.h>
#include <string.h>

#include "common/cases.h"
#include "common/die.h"
#include "common/scene.h"

/* Numbers of a model that have no unit left. */
struct reduced {
    const char *name;
    size_t offset;
    int count;
};

#define ONE(member)                                                                      \
    {                                                                                    \
#member, offsetof(struct gb_model, member), 1                                    \
    }

static const struct reduced numbers[] = {
    {"edges", offsetof(struct gb_model, edges), 3},
    {"unload_from", offsetof(struct gb_model, unload_from), GB_UNLOAD_MAX},
    ONE(start_density),
    ONE(r_meso),
    ONE(single_contact),
    ONE(diameter_min),
    ONE(diameter_max),
    ONE(mean_power),
    ONE(rod.hertz),
    ONE(rod.rod),
    ONE(rod.pivot),
    ONE(bridge.length),
    ONE(bridge.strength),
    ONE(dispersion.strength),
    ONE(dispersion.shift),
    ONE(dispersion.contact),
    ONE(slip.shear),
    ONE(slip.pivot),
    ONE(slip.roll),
    ONE(slip.mu),
    ONE(slip.mu_pivot),
    ONE(slip.strength),
    ONE(h_eq),
    ONE(adhesion),
    ONE(force_floor),
    ONE(numerics.tolerance),
    ONE(numerics.cutoff),
    ONE(numerics.skin),
    ONE(strain_step),
    ONE(until_pressure),
    ONE(until_density),
    ONE(dynamics.viscous),
    ONE(dynamics.rate),
    ONE(dynamics.relax),
    ONE(dynamics.hold),
    ONE(dynamics.time_step),
    ONE(dynamics.record_density),
    ONE(dynamics.record_time),
    ONE(dynamics.inertia),
    ONE(die.radius),
    ONE(die.height),
    ONE(die.outlet),
    ONE(die.angle),
    ONE(die.fill_gravity),
    ONE(die.gravity),
    ONE(die.gravity_ramp),
    ONE(die.flatten_travel),
    ONE(die.ramp_time),
    ONE(die.pressure),
    ONE(die.record),
    ONE(die.punch_mass),
    ONE(die.unload_time),
    ONE(die.rest_time),
    ONE(die.eject_speed),
    ONE(die.weld_strength),
    ONE(die.time_step),
    ONE(die.central_radius),
};

static double number_at(const struct gb_model *model, const struct reduced *row, int k)
{
    return ((const double *)(const void *)((const char *)model + row->offset))[k];
}

/* Largest relative difference allowed; 0: the same bits. */
static void check_models(const struct gb_model *a, const struct gb_model *b, double share)
{
    for (size_t n = 0; n < G_N_ELEMENTS(numbers); n++) {
        for (int k = 0; k < numbers[n].count; k++) {
            const double first = number_at(a, &numbers[n], k),
                         second = number_at(b, &numbers[n], k);
            const bool same = first == second || (isnan(first) && isnan(second));
            if (!same && !(fabs(first - second) <= share * fabs(first))) {
                g_test_message("%s[%d]: %.17g and %.17g", numbers[n].name, k, first,
                               second);
                g_test_fail();
            }
        }
    }
    g_assert_cmpint(a->numerics.parts, ==, b->numerics.parts);
    g_assert_cmpint(a->numerics.single, ==, b->numerics.single);
    g_assert_cmpint(a->terms.bridges, ==, b->terms.bridges);
    g_assert_cmpint(a->terms.attraction, ==, b->terms.attraction);
    g_assert_cmpint(a->terms.friction, ==, b->terms.friction);
}

/* Bits of the packing after it was pressed a little. */
static uint64_t pressed_hash(const struct gb_model *model)
{
    struct gb_world *world = scene_world(model);
    scene_press(world, 5, 20, 2.0);
    const uint64_t hash = gb_world_hash(world);
    gb_world_destroy(world);
    return hash;
}

/* Decimal units give the same double, and so the same bits throughout. */
static void test_written(void)
{
    static const char *const texts[][2] = {
        {"particles.diameter=9.7 nm", "particles.diameter=0.0097 um"},
        {"particles.diameter=9.7 nm", "particles.diameter=97 A"},
        {"particles.diameter=9.7 nm", "particles.diameter=9.7e-9 m"},
        {"material.young=380 GPa", "material.young=380000 MPa"},
        {"material.young=380 GPa", "material.young=3.8e11 Pa"},
        {"material.d0=0.4 nm", "material.d0=400 pm"},
        {"material.density=3990 kg/m3", "material.density=3.99 g/cm3"},
        {"loading.until=1.5 GPa", "loading.until=1500 MPa"},
        {"loading.unload_from=100 MPa", "loading.unload_from=1e5 kPa"},
        {"loading.step=0.1 %", "loading.step=0.001"},
        {"contact.shear_strength=25 MPa", "contact.shear_strength=2.5e7 Pa"},
        {"contact.bridge_length=0.08 nm", "contact.bridge_length=8e-11 m"},
        {"structure.r_meso=19.4 nm", "structure.r_meso=0.0194 um"},
        {"numerics.cutoff=12 nm", "numerics.cutoff=120 A"},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        g_test_message("%s, %s", texts[k][0], texts[k][1]);
        const struct gb_params a = scene_params(texts[k][0], NULL),
                               b = scene_params(texts[k][1], NULL);
        const struct gb_model first = scene_model(&a), second = scene_model(&b);
        check_models(&first, &second, 0.0);
        g_assert_cmpfloat(first.pascal_per_stress, ==, second.pascal_per_stress);
        g_assert_cmpfloat(first.metre_per_length, ==, second.metre_per_length);
        g_assert_true(pressed_hash(&first) == pressed_hash(&second));
    }
}

/* Energies times Boltzmann's constant, in joule and in electronvolt. */
static void test_energies(void)
{
    static const double kelvin[] = {1.0, 1224.0, 31.7};
    for (size_t k = 0; k < G_N_ELEMENTS(kelvin); k++) {
        char text[3][64];
        const double joule = kelvin[k] * 1.380649e-23;
        g_snprintf(text[0], sizeof text[0], "material.epsilon=%.17g kB", kelvin[k]);
        g_snprintf(text[1], sizeof text[1], "material.epsilon=%.17g J", joule);
        g_snprintf(text[2], sizeof text[2], "material.epsilon=%.17g eV",
                   joule / 1.602176634e-19);
        const struct gb_params kb = scene_params(text[0], NULL);
        const struct gb_model first = scene_model(&kb);
        for (int unit = 1; unit < 3; unit++) {
            const struct gb_params other = scene_params(text[unit], NULL);
            const struct gb_model second = scene_model(&other);
            check_models(&first, &second, 1e-12);
        }
    }
}

/* A system of units: how many of the new ones an old one is. */
struct system {
    double length, stress, density;
};

static double unit_of(const struct system *system, int dimension)
{
    const double speed = sqrt(system->stress / system->density),
                 time = system->length / speed,
                 force = system->stress * system->length * system->length;
    switch (dimension) {
    case GB_DIM_LENGTH:
        return system->length;
    case GB_DIM_PRESSURE:
        return system->stress;
    case GB_DIM_TIME:
        return time;
    case GB_DIM_RATE:
        return 1.0 / time;
    case GB_DIM_MASS_DENSITY:
        return system->density;
    case GB_DIM_ENERGY:
        return force * system->length;
    case GB_DIM_VISCOSITY:
        return system->stress * time;
    case GB_DIM_FORCE:
        return force;
    case GB_DIM_SPEED:
        return speed;
    default:
        return 1.0;
    }
}

static void scale_numbers(double *value, int count, double unit)
{
    for (int k = 0; k < count; k++) {
        value[k] *= unit;
    }
}

/* Every field by its own dimension; accelerations of a die are in those of the earth. */
static struct gb_params in_system(const struct gb_params *params,
                                  const struct system *system)
{
    struct gb_params scaled = *params;
    size_t count;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t f = 0; f < count; f++) {
        const double unit = unit_of(system, fields[f].dimension);
        void *at = (char *)&scaled + fields[f].offset;
        if (fields[f].type == GB_FIELD_NUMBER) {
            *(double *)at *= unit;
        } else if (fields[f].type == GB_FIELD_RELATIVE) {
            struct gb_relative *relative = at;
            relative->value *= relative->relative ? 1.0 : unit;
        }
    }
    const double time = unit_of(system, GB_DIM_TIME);
    scale_numbers(&scaled.until_pressure_pa, 1, system->stress);
    scale_numbers(scaled.unload_from_pa, scaled.unload_count, system->stress);
    for (int k = 0; k < scaled.sizes.count; k++) {
        scaled.sizes.row[k].diameter_m *= system->length;
    }
    scaled.fill_gravity *= system->length / (time * time);
    scaled.rest_gravity *= system->length / (time * time);
    return scaled;
}

static struct gb_params random_scene(GRand *random)
{
    char seed[48];
    g_snprintf(seed, sizeof seed, "structure.seed=%d", cases_choice(random, 1000000));
    switch (cases_choice(random, 5)) {
    case 0:
        return scene_params(seed, "contact.bridge_length=0.08 nm",
                            "contact.shear_strength=30 MPa", "numerics.cutoff=12 nm",
                            "structure.r_meso=19.4 nm",
                            "loading.unload_from=100 MPa; 300 MPa", NULL);
    case 1:
        return scene_params(seed, "scene.dimension=2", "contact.alpha=0.3", NULL);
    case 2:
        return scene_params(seed, "particles.distribution=lognormal",
                            "particles.sigma=0.3", "particles.median=9 nm",
                            "particles.largest=20 nm", NULL);
    case 3:
        return scene_params(seed, "scene.kind=dynamic", "loading.until=density = 0.4",
                            "loading.rate=6.8e9 1/s", "contact.viscosity=1 mPa s",
                            "loading.relax=1 ps", "loading.hold=2 ps", NULL);
    default:
        return die_params(seed, "die.cycle=full", "die.weld_strength=800 MPa",
                          "loading.time=20 us", NULL);
    }
}

/* Any system of units; auto values of keys that are times or lengths scale, too. */
static void check_measured(GRand *random)
{
    const struct gb_params params = random_scene(random);
    const struct system system = {cases_scale(random, 0.1, 10.0),
                                  cases_scale(random, 0.1, 10.0),
                                  cases_scale(random, 0.3, 3.0)};
    const struct gb_params other = in_system(&params, &system);
    const struct gb_model first = scene_model(&params), second = scene_model(&other);
    check_models(&first, &second, 1e-12);
    g_assert_cmpfloat_with_epsilon(second.pascal_per_stress / first.pascal_per_stress,
                                   system.stress, 1e-12 * system.stress);
    g_assert_cmpfloat_with_epsilon(second.metre_per_length / first.metre_per_length,
                                   system.length, 1e-12 * system.length);
}

/* Powers of two round nothing: the same bits, also of the packing. */
static void check_binary(GRand *random)
{
    const struct gb_params params = scene_params(
        "contact.bridge_length=0.08 nm", "contact.shear_strength=30 MPa",
        "contact.mu=0.2",
        cases_choice(random, 2) == 0 ? "scene.dimension=2" : "scene.dimension=3", NULL);
    const struct system system = {ldexp(1.0, cases_choice(random, 5) - 2),
                                  ldexp(1.0, 2 * cases_choice(random, 3) - 2), 1.0};
    const struct gb_params other = in_system(&params, &system);
    const struct gb_model first = scene_model(&params), second = scene_model(&other);
    check_models(&first, &second, 0.0);
    g_assert_true(pressed_hash(&first) == pressed_hash(&second));
}

static void test_measured(void)
{
    cases_run(60, 5000, check_measured);
}

static void test_binary(void)
{
    cases_run(10, 200, check_binary);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/units/written", test_written);
    g_test_add_func("/units/energies", test_energies);
    g_test_add_func("/units/measured", test_measured);
    g_test_add_func("/units/binary", test_binary);
    return g_test_run();
}
