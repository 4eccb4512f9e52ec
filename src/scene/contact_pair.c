#include "scene/contact_pair.h"

#include <math.h>

#include "base/units.h"
#include "scene/derived.h"

struct body {
    struct gb_elastic elastic;
    double radius, density, yield, hollomon;
    const char *yield_key, *young_key;
};

static double given_or(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

static struct body first_body(const struct gb_params *params)
{
    return (struct body){
        .elastic = {params->young_pa, params->poisson},
        .radius = given_or(params->radius_i_m, 0.5 * params->diameter_m),
        .density = params->density_kg_m3,
        .yield = params->yield_pa,
        .hollomon = gb_derived_hollomon_pa(params),
        .yield_key = "material.yield",
        .young_key = "material.young",
    };
}

/* The second body: the first one, with the keys that are given for the second.  A given
 * sigma_0 is not used if young_j or yield_j is given, because it belongs to the yield
 * point of the first. */
static struct body second_body(const struct gb_params *params)
{
    struct body body = first_body(params);
    body.elastic.young = given_or(params->young_j_pa, body.elastic.young);
    body.elastic.poisson = given_or(params->poisson_j, body.elastic.poisson);
    body.radius = given_or(params->radius_j_m, 0.5 * params->diameter_m);
    body.density = given_or(params->density_j_kg_m3, body.density);
    body.yield = given_or(params->yield_j_pa, body.yield);
    body.yield_key = isnan(params->yield_j_pa) ? "material.yield" : "material.yield_j";
    body.young_key = isnan(params->young_j_pa) ? "material.young" : "material.young_j";
    if (!isnan(params->young_j_pa) || !isnan(params->yield_j_pa)) {
        body.hollomon =
            gb_law_storakers_hollomon(body.yield, body.elastic.young, params->hardening);
    }
    return body;
}

static bool check_body(const struct body *body, struct gb_error *err)
{
    if (body->yield <= body->elastic.young) {
        return true;
    }
    char yield[64], young[64];
    gb_units_format(body->yield, GB_DIM_PRESSURE, yield, sizeof yield);
    gb_units_format(body->elastic.young, GB_DIM_PRESSURE, young, sizeof young);
    return gb_error_set(err, GB_ERR_INPUT, "%s = %s: must be at most %s = %s",
                        body->yield_key, yield, body->young_key, young);
}

static double sphere_mass(const struct body *body)
{
    return 4.0 / 3.0 * M_PI * body->radius * body->radius * body->radius * body->density;
}

bool gb_contact_pair_init(struct gb_contact_pair *pair, const struct gb_params *params,
                          struct gb_error *err)
{
    const struct body i = first_body(params), j = second_body(params);
    if (isinf(i.radius) && isinf(j.radius)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "contact.radius_i = wall: must be a length when "
                            "contact.radius_j is a wall");
    }
    if (!check_body(&i, err) || !check_body(&j, err)) {
        return false;
    }
    *pair = (struct gb_contact_pair){
        .radius = gb_law_hertz_radius(i.radius, j.radius),
        .diameter = 2.0 * fmin(i.radius, j.radius),
        .mass = {sphere_mass(&i), sphere_mass(&j)},
        .yield_pa = fmin(i.yield, j.yield),
        .damping = params->damping,
        .mu = params->mu,
    };
    gb_law_storakers_init(&pair->law, &i.elastic, &j.elastic, i.hollomon, j.hollomon,
                          params->hardening, params->storakers == GB_STORAKERS_PRINTED);
    return true;
}

double gb_contact_pair_critical_step(const struct gb_contact_pair *pair, double stiffness)
{
    return gb_law_hertz_critical_step(stiffness, fmin(pair->mass[0], pair->mass[1]),
                                      pair->damping);
}
