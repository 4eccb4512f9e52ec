#include <math.h>

#include <glib.h>

#include "io/preset.h"
#include "scene/contact_pair.h"
#include "scene/derived.h"
#include "scene/model.h"
#include "study/papers/papers_measures.h"

static bool load(const char *name, struct gb_params *params)
{
    struct gb_preset *preset = NULL;
    const bool good = gb_preset_load(&preset, name, NULL);
    if (good) {
        *params = *gb_preset_params(preset);
    }
    gb_preset_destroy(preset);
    return good;
}

/* f_a,max = pi gamma d, P1 section II.B. */
double gb_papers_laws_surface_energy(const struct gb_papers_view *view,
                                     const struct gb_papers_comparison *row)
{
    struct gb_params params;
    struct gb_model model;
    (void)view;
    (void)row;
    return load("p1-set2-9.7nm", &params) && gb_model_init(&model, &params, NULL)
               ? model.dispersion.contact * model.newton_per_force /
                     (M_PI * model.metre_per_length)
               : (double)NAN;
}

double gb_papers_laws_peel(const struct gb_papers_view *view,
                           const struct gb_papers_comparison *row)
{
    enum { POINTS = 1000 };
    static const double deepest = 0.05; /* the range of P1 Fig. 2, d */
    struct gb_params params;
    struct gb_model model;
    double strongest = 0.0;
    (void)view;
    if (!load("p1-set2-9.7nm", &params)) {
        return NAN;
    }
    params.bridge_length = (struct gb_relative){row->at, true};
    if (!gb_model_init(&model, &params, NULL)) {
        return NAN;
    }
    for (int k = 0; k <= POINTS; k++) {
        const double stress =
            gb_law_bridge_peel_stress(&model.bridge, &model.rod, deepest * k / POINTS);
        strongest = fmax(strongest, 1e-9 * model.pascal_per_stress * stress);
    }
    return strongest;
}

double gb_papers_laws_unit_time(const struct gb_papers_view *view,
                                const struct gb_papers_comparison *row)
{
    struct gb_params params;
    (void)view;
    (void)row;
    return load("p2-v1", &params) ? gb_derived_unit_time_s(&params) : (double)NAN;
}

/* Both edges of the square lose the share in a step of 0.04 T: P2 section 2. */
double gb_papers_laws_rate(const struct gb_papers_view *view,
                           const struct gb_papers_comparison *row)
{
    static const double step = 0.04;
    return 2.0 * row->at / (step * gb_papers_laws_unit_time(view, row));
}

static bool load_pair(const char *name, double exponent, struct gb_contact_pair *pair,
                      struct gb_params *params)
{
    if (!load(name, params)) {
        return false;
    }
    params->hardening = exponent;
    return gb_contact_pair_init(pair, params, NULL);
}

double gb_papers_laws_hollomon(const struct gb_papers_view *view,
                               const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    return load_pair("p3-pair", row->at, &pair, &params) ? gb_derived_hollomon_pa(&params)
                                                         : (double)NAN;
}

double gb_papers_laws_yield_force(const struct gb_papers_view *view,
                                  const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    (void)row;
    return load_pair("p3-pair", 0.0, &pair, &params)
               ? gb_law_hertz_yield_force(&pair.law.hertz, pair.radius, pair.yield_pa)
               : (double)NAN;
}

double gb_papers_laws_yield_overlap(const struct gb_papers_view *view,
                                    const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    return load_pair("p3-pair", 0.0, &pair, &params)
               ? gb_law_hertz_overlap(&pair.law.hertz, pair.radius,
                                      gb_papers_laws_yield_force(view, row))
               : (double)NAN;
}

/* F = `at` MPa x 4 R^2, P3 (31), (32). */
static double pair_force(const struct gb_contact_pair *pair, double mpa)
{
    return 1e6 * mpa * pair->diameter * pair->diameter;
}

double gb_papers_laws_pair_hertz(const struct gb_papers_view *view,
                                 const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    return load_pair("p3-pair", 0.0, &pair, &params)
               ? gb_law_hertz_overlap(&pair.law.hertz, pair.radius,
                                      pair_force(&pair, row->at)) /
                     pair.diameter
               : (double)NAN;
}

/* Inverse of (16), which is a power of the overlap. */
static double plastic_overlap(const struct gb_contact_pair *pair, double force)
{
    const double unit = gb_law_storakers_plastic(&pair->law, pair->radius, pair->radius);
    return pair->radius * pow(force / unit, 1.0 / (1.0 + 0.5 * pair->law.exponent));
}

double gb_papers_laws_pair_storakers(const struct gb_papers_view *view,
                                     const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    return load_pair("p3-pair", row->hardening, &pair, &params)
               ? plastic_overlap(&pair, pair_force(&pair, row->at)) / pair.diameter
               : (double)NAN;
}

double gb_papers_laws_unequal(const struct gb_papers_view *view,
                              const struct gb_papers_comparison *row)
{
    struct gb_contact_pair pair;
    struct gb_params params;
    (void)view;
    return load_pair("p3-line", row->hardening, &pair, &params)
               ? plastic_overlap(&pair, row->at)
               : (double)NAN;
}
