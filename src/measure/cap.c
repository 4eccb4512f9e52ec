/* The Drucker-Prager cap: its surface and flow (cap.h), and the rate law of a material on it.
 * A step predicts elastically and returns to the surface along the plastic flow. */
#include "measure/cap.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "greenbody/status.h"
#include "scene/tolerances.h"

double gb_cap_depth(const struct gb_cap *cap)
{
    return cap->d + cap->p_a * tan(cap->beta);
}

double gb_cap_flattening(const struct gb_cap *cap)
{
    return 1.0 + cap->a - cap->a / cos(cap->beta);
}

double gb_cap_tangent(const struct gb_cap *cap)
{
    return cap->p_a - cap->a * gb_cap_depth(cap) * sin(cap->beta);
}

double gb_cap_end(const struct gb_cap *cap)
{
    return cap->p_a + cap->r * gb_cap_depth(cap);
}

struct gb_cap gb_cap_with_end(const struct gb_cap *cap, double p_b)
{
    struct gb_cap moved = *cap;
    moved.p_a = (p_b - cap->r * cap->d) / (1.0 + cap->r * tan(cap->beta));
    return moved;
}

double gb_cap_apex(const struct gb_cap *cap)
{
    return cap->beta > 0.0 ? -cap->d / tan(cap->beta) : -INFINITY;
}

double gb_cap_height(const struct gb_cap *cap, double p)
{
    const double depth = gb_cap_depth(cap);
    const double off = p - cap->p_a;
    if (p <= gb_cap_tangent(cap)) {
        return cap->d + p * tan(cap->beta);
    }
    if (p <= cap->p_a) {
        const double radius = cap->a * depth;
        return (1.0 - cap->a / cos(cap->beta)) * depth +
               sqrt(fmax(0.0, radius * radius - off * off));
    }
    const double reach = cap->r * depth;
    const double left = reach * reach - off * off;
    return left > 0.0 ? gb_cap_flattening(cap) / cap->r * sqrt(left) : reach - off;
}

void gb_cap_flow(const struct gb_cap *cap, double p, double q, double *volume,
                 double *shear)
{
    const double k = gb_cap_flattening(cap), off = p - cap->p_a;
    if (off > 0.0) {
        *volume = off;
        *shear = cap->r * cap->r / (k * k) * q;
    } else {
        const double slope = tan(cap->beta);
        *volume = slope * slope * off;
        *shear = q / (k * k);
    }
}

enum { COMPONENTS = 6, AXES = 3, ROUNDS = 200 };

/* A return to the surface: the elastic stress and what the step may change. */
struct prediction {
    const struct gb_cap_material *material;
    struct gb_cap_row now; /* at the density of the end of the sub-step */
    double plastic_volume;
    double p, q;
};

/* Result of the return for one value of its unknown. */
struct returned {
    double p, q, volume, shear; /* stress; plastic strains of the step */
    double outside;             /* yield function, Pa: 0 on the surface */
};

typedef struct returned try_return(const struct prediction *from, double unknown);

struct search {
    const struct prediction *from;
    try_return *attempt;
};

double gb_cap_mean(const double pressure[6])
{
    return (pressure[0] + pressure[1] + pressure[2]) / AXES;
}

double gb_cap_deviator(const double pressure[6])
{
    const double p = gb_cap_mean(pressure);
    double sum = 0.0;
    for (int k = 0; k < AXES; k++) {
        sum += (pressure[k] - p) * (pressure[k] - p) +
               2.0 * pressure[k + AXES] * pressure[k + AXES];
    }
    return sqrt(1.5 * sum);
}

static double between(double a, double b, double share)
{
    return a + (b - a) * share;
}

static struct gb_cap_row mix(const struct gb_cap_row *a, const struct gb_cap_row *b,
                             double share)
{
    struct gb_cap_row row = *a;
    row.density = between(a->density, b->density, share);
    row.bulk = between(a->bulk, b->bulk, share);
    row.shear_modulus = between(a->shear_modulus, b->shear_modulus, share);
    row.cap.d = between(a->cap.d, b->cap.d, share);
    row.cap.beta = between(a->cap.beta, b->cap.beta, share);
    row.cap.r = between(a->cap.r, b->cap.r, share);
    return row;
}

/* p_b of the hardening table. */
static double hardened(const struct gb_cap_material *material, double plastic_volume)
{
    const struct gb_cap_row *row = material->row;
    size_t k = 0;
    while (k + 1 < material->count && row[k + 1].plastic_volume <= plastic_volume) {
        k++;
    }
    if (k + 1 == material->count || plastic_volume <= row[k].plastic_volume) {
        return row[k].p_b;
    }
    return between(row[k].p_b, row[k + 1].p_b,
                   (plastic_volume - row[k].plastic_volume) /
                       (row[k + 1].plastic_volume - row[k].plastic_volume));
}

struct gb_cap_row gb_cap_at(const struct gb_cap_material *material, double density,
                            double plastic_volume)
{
    const struct gb_cap_row *row = material->row;
    size_t k = 0;
    while (k + 1 < material->count && row[k + 1].density <= density) {
        k++;
    }
    struct gb_cap_row found = row[k];
    if (k + 1 < material->count && density > row[k].density) {
        found = mix(&row[k], &row[k + 1],
                    (density - row[k].density) / (row[k + 1].density - row[k].density));
    }
    found.plastic_volume = plastic_volume;
    found.p_b = hardened(material, plastic_volume);
    found.cap = gb_cap_with_end(&found.cap, found.p_b);
    return found;
}

static bool row_is_good(const struct gb_cap_row *row)
{
    return row->density > 0.0 && row->bulk > 0.0 && row->shear_modulus > 0.0 &&
           row->cap.d > 0.0 && row->cap.r > 0.0 && row->cap.beta > 0.0 &&
           row->cap.beta < M_PI_2 && row->p_b > 0.0 && gb_cap_flattening(&row->cap) > 0.0;
}

bool gb_cap_check(const struct gb_cap_material *material, struct gb_error *err)
{
    for (size_t i = 0; i < material->count; i++) {
        const struct gb_cap_row *row = &material->row[i];
        const bool rises =
            i == 0 || (row->density > row[-1].density && row->p_b > row[-1].p_b &&
                       row->plastic_volume > row[-1].plastic_volume);
        if (!row_is_good(row) || !rises) {
            return gb_error_set(err, GB_ERR_INPUT, "card, density %.4f: %s", row->density,
                                rises ? "moduli, d, beta, R and p_b must be above 0"
                                      : "density, p_b and plastic strain must ascend");
        }
    }
    return material->count > 0 || gb_error_set(err, GB_ERR_INPUT, "card: no row");
}

/* Return to the cap by a plastic volumetric strain. */
static struct returned to_cap(const struct prediction *from, double volume)
{
    const struct gb_cap cap = gb_cap_with_end(
        &from->now.cap, hardened(from->material, from->plastic_volume + volume));
    const double flat = gb_cap_flattening(&cap), reach = cap.r * gb_cap_depth(&cap);
    const double stretch = cap.r * cap.r / (flat * flat);
    struct returned end = {.p = from->p - from->now.bulk * volume, .volume = volume};
    const double off = end.p - cap.p_a;
    if (off <= 0.0) {
        end.outside = off - reach; /* beyond p_a: the flow would be a shear alone */
        return end;
    }
    const double multiplier = volume / off;
    end.q = from->q / (1.0 + 3.0 * from->now.shear_modulus * multiplier * stretch);
    end.shear = multiplier * stretch * end.q;
    end.outside = hypot(off, cap.r * end.q / flat) - reach;
    return end;
}

/* Return to shear failure or transition by a multiple of the flow. */
static struct returned to_shear(const struct prediction *from, double multiplier)
{
    const struct gb_cap *cap = &from->now.cap;
    const double flat = gb_cap_flattening(cap), slope = tan(cap->beta);
    const double push = from->now.bulk * multiplier * slope * slope;
    struct returned end = {.p = (from->p + push * cap->p_a) / (1.0 + push)};
    end.q = from->q / (1.0 + 3.0 * from->now.shear_modulus * multiplier / (flat * flat));
    end.volume = multiplier * slope * slope * (end.p - cap->p_a);
    end.shear = multiplier * end.q / (flat * flat);
    end.outside = end.q - gb_cap_height(cap, end.p);
    return end;
}

static double outside(double unknown, void *data)
{
    const struct search *search = data;
    return search->attempt(search->from, unknown).outside;
}

/* Brent's method between 0 (outside) and most (inside). */
static bool find(struct returned *end, struct search *search, double most,
                 struct gb_error *err)
{
    gsl_function function = {.function = outside, .params = search};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    if (!solver) {
        return gb_error_set(err, GB_ERR_MEMORY, "out of memory");
    }
    int status = gsl_root_fsolver_set(solver, &function, 0.0, most);
    for (int k = 0; k < ROUNDS && status == GSL_SUCCESS; k++) {
        status = gsl_root_fsolver_iterate(solver);
        if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver),
                                   gsl_root_fsolver_x_upper(solver), 0.0,
                                   GB_CAP_RETURN) == GSL_SUCCESS) {
            break;
        }
    }
    *end = search->attempt(search->from, gsl_root_fsolver_root(solver));
    gsl_root_fsolver_free(solver);
    return status == GSL_SUCCESS ||
           gb_error_set(err, GB_ERR_NOT_CONVERGED,
                        "card: no return to the yield surface from p = %.4g MPa, "
                        "q = %.4g MPa",
                        search->from->p / 1e6, search->from->q / 1e6);
}

static bool return_to_surface(struct returned *end, const struct prediction *from,
                              struct gb_error *err)
{
    struct search search = {.from = from, .attempt = to_shear};
    if (from->p > from->now.cap.p_a) {
        search.attempt = to_cap;
        return find(end, &search, (from->p - from->now.cap.p_a) / from->now.bulk, err);
    }
    double most = 1e-3 / from->now.shear_modulus;
    while (to_shear(from, most).outside > 0.0) {
        most *= 2.0;
    }
    return find(end, &search, most, err);
}

static struct prediction predict(const struct gb_cap_material *material,
                                 struct gb_cap_state *state,
                                 const double strain[COMPONENTS], double share)
{
    const double volume = (strain[0] + strain[1] + strain[2]) * share;
    const struct gb_cap_row half =
        gb_cap_at(material, state->density * exp(0.5 * volume), state->plastic_volume);
    for (int k = 0; k < AXES; k++) {
        state->pressure[k] +=
            half.bulk * volume +
            2.0 * half.shear_modulus * (strain[k] * share - volume / AXES);
        state->pressure[k + AXES] += half.shear_modulus * strain[k + AXES] * share;
    }
    state->density *= exp(volume);
    struct gb_cap_row now = gb_cap_at(material, state->density, state->plastic_volume);
    now.bulk = half.bulk;
    now.shear_modulus = half.shear_modulus;
    return (struct prediction){.material = material,
                               .now = now,
                               .plastic_volume = state->plastic_volume,
                               .p = gb_cap_mean(state->pressure),
                               .q = gb_cap_deviator(state->pressure)};
}

/* Pressures with the same principal directions and another p and q. */
static void move(struct gb_cap_state *state, const struct prediction *from,
                 const struct returned *end)
{
    const double share = from->q > 0.0 ? end->q / from->q : 0.0;
    for (int k = 0; k < AXES; k++) {
        state->pressure[k] = end->p + share * (state->pressure[k] - from->p);
        state->pressure[k + AXES] *= share;
    }
    state->plastic_volume += end->volume;
    state->plastic_shear += end->shear;
}

bool gb_cap_strain(const struct gb_cap_material *material, struct gb_cap_state *state,
                   const double strain[6], struct gb_error *err)
{
    double largest = 0.0;
    for (int k = 0; k < COMPONENTS; k++) {
        largest = fmax(largest, fabs(strain[k]));
    }
    const int steps = (int)fmax(1.0, ceil(largest / GB_CAP_SUBSTEP));
    for (int s = 0; s < steps; s++) {
        struct returned end;
        const struct prediction from = predict(material, state, strain, 1.0 / steps);
        if (from.q <= gb_cap_height(&from.now.cap, from.p)) {
            continue;
        }
        if (!return_to_surface(&end, &from, err)) {
            return false;
        }
        move(state, &from, &end);
    }
    return true;
}
