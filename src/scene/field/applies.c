#include "scene/field/applies.h"

#include <stddef.h>
#include <string.h>

#include "scene/derived.h"
#include "scene/imported/imported.h"
#include "scene/loading_kind.h"
#include "scene/normal_law.h"

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

static bool without_path(const struct gb_params *params)
{
    return !gb_loading_kind_follows_path(params);
}

static bool with_path(const struct gb_params *params)
{
    return !without_path(params);
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

/* Two bodies of the law command; scenes have one material. */
static bool never(const struct gb_params *params)
{
    (void)params;
    return false;
}

/* Fields that matter only with one distribution; those of the kinds of scenes are listed in
 * scene/loading_kind.c, those of the normal laws in scene/normal_law.c. */
static const struct {
    const char *group, *key;
    bool (*when)(const struct gb_params *params);
} rules[] = {
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
    {"contact", "bridge_radius", bridged},
    {"contact", "radius_i", never},
    {"contact", "radius_j", never},
    {"loading", "geometry", without_path},
    {"loading", "until", without_path},
    {"loading", "unload_from", without_path},
    {"loading", "on_collapse", with_path},
    {"particles", "distribution", generated},
    {"structure", "kind", generated},
    {"structure", "overlap", lattice},
    {"structure", "density", grown},
    {"structure", "base", grown},
    {"structure", "r_meso", grown},
    {"structure", "single_contact", grown},
};

bool gb_applies_field(const struct gb_params *params, const struct gb_field *field)
{
    if (!gb_loading_kind_uses(gb_loading_kind_of(params), field) ||
        !gb_normal_law_uses(gb_normal_law_of(params), field)) {
        return false;
    }
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        if (strcmp(rules[i].group, field->group) == 0 &&
            strcmp(rules[i].key, field->key) == 0) {
            return rules[i].when(params);
        }
    }
    return true;
}
