#include "scene/applies.h"

#include <stddef.h>
#include <string.h>

static bool periodic(const struct gb_params *params)
{
    return params->kind != GB_KIND_DIE;
}

static bool quasistatic(const struct gb_params *params)
{
    return params->kind == GB_KIND_QUASISTATIC;
}

static bool dynamic(const struct gb_params *params)
{
    return params->kind == GB_KIND_DYNAMIC;
}

static bool die(const struct gb_params *params)
{
    return params->kind == GB_KIND_DIE;
}

static bool moving(const struct gb_params *params)
{
    return !quasistatic(params);
}

static bool rod(const struct gb_params *params)
{
    return params->normal == GB_NORMAL_ROD;
}

static bool storakers(const struct gb_params *params)
{
    return params->normal == GB_NORMAL_STORAKERS;
}

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

/* Two bodies of the law command; scenes have one material. */
static bool never(const struct gb_params *params)
{
    (void)params;
    return false;
}

/* Fields that only some scenes use; key NULL: the whole group.  What is not listed
 * matters to all. */
static const struct {
    const char *group, *key;
    bool (*when)(const struct gb_params *params);
} rules[] = {
    {"scene", "dimension", periodic},
    {"material", "density", moving},
    {"material", "d0", rod},
    {"material", "n_d0_cubed", rod},
    {"material", "epsilon", rod},
    {"material", "yield", storakers},
    {"material", "hardening", storakers},
    {"material", "hollomon", storakers},
    {"material", "young_j", never},
    {"material", "poisson_j", never},
    {"material", "density_j", never},
    {"material", "yield_j", never},
    {"particles", "diameter", mono},
    {"particles", "median", lognormal},
    {"particles", "sigma", lognormal},
    {"particles", "least", lognormal},
    {"particles", "largest", lognormal},
    {"particles", "table", table},
    {"contact", "alpha", rod},
    {"contact", "mu_wall", die},
    {"contact", "mu_pivot", rod},
    {"contact", "bridge_length", rod},
    {"contact", "shear_strength", rod},
    {"contact", "bridge_radius", rod},
    {"contact", "relative_motion", rod},
    {"contact", "viscosity", dynamic},
    {"contact", "damping", die},
    {"contact", "shear_ratio", storakers},
    {"contact", "storakers", storakers},
    {"contact", "radius_i", never},
    {"contact", "radius_j", never},
    {"structure", "density", periodic},
    {"structure", "base", periodic},
    {"structure", "r_meso", periodic},
    {"die", NULL, die},
    {"loading", "step", quasistatic},
    {"loading", "unload_from", quasistatic},
    {"loading", "rate", dynamic},
    {"loading", "relax", dynamic},
    {"loading", "hold", dynamic},
    {"loading", "record", dynamic},
    {"loading", "record_time", dynamic},
    {"loading", "ramp", die},
    {"loading", "time", die},
    {"loading", "record_pressure", die},
    {"numerics", "relaxer", quasistatic},
    {"numerics", "tolerance", quasistatic},
    {"numerics", "max_evaluations", quasistatic},
    {"numerics", "cutoff", rod},
    {"numerics", "precision", quasistatic},
    {"numerics", "time_step", dynamic},
    {"numerics", "step_error", dynamic},
    {"numerics", "safety", die},
    {"numerics", "inertia_scale", die},
};

bool gb_applies_field(const struct gb_params *params, const struct gb_field *field)
{
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        if (strcmp(rules[i].group, field->group) == 0 &&
            (rules[i].key == NULL || strcmp(rules[i].key, field->key) == 0)) {
            return rules[i].when(params);
        }
    }
    return true;
}
