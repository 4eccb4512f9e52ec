#include "study/card/card_fit.h"

#include <math.h>
#include <string.h>

#include "measure/cap/cap_fit.h"
#include "measure/fit/average.h"

enum { REPLICAS_MAX = 1000 };

struct gb_cap_material gb_card_fit_material(const struct gb_card_values *card, int levels,
                                            double transition, struct gb_cap_row *rows)
{
    for (int k = 0; k < levels; k++) {
        const double *value = card->value[k];
        const double young = value[GB_CARD_YOUNG], poisson = value[GB_CARD_POISSON];
        rows[k] = (struct gb_cap_row){.density = card->density[k],
                                      .bulk = young / (3.0 * (1.0 - 2.0 * poisson)),
                                      .shear_modulus = young / (2.0 * (1.0 + poisson)),
                                      .cap = {.d = value[GB_CARD_D],
                                              .beta = value[GB_CARD_BETA],
                                              .r = value[GB_CARD_R],
                                              .p_a = value[GB_CARD_P_A],
                                              .a = transition},
                                      .p_b = value[GB_CARD_P_B],
                                      .plastic_volume = value[GB_CARD_PLASTIC]};
    }
    return (struct gb_cap_material){rows, (size_t)levels};
}

/* Points of one level and direction, a value per cell. */
struct gathered {
    double p[REPLICAS_MAX], q[REPLICAS_MAX], volume[REPLICAS_MAX], shear[REPLICAS_MAX];
    size_t count;
};

static void gather(struct gathered *to, const struct gb_card_cell *cells, int count,
                   int without, double density, double direction)
{
    to->count = 0;
    for (int c = 0; c < count; c++) {
        for (guint i = 0; c != without && i < cells[c].point->len; i++) {
            const struct gb_yield_point *point =
                &g_array_index(cells[c].point, struct gb_yield_point, i);
            if (point->density == density && point->direction == direction) {
                to->p[to->count] = point->p_pa;
                to->q[to->count] = point->q_pa;
                to->volume[to->count] = point->flow_volume;
                to->shear[to->count++] = point->flow_shear;
            }
        }
    }
}

static struct gb_yield_point mean_of(const struct gathered *from, double density,
                                     double direction)
{
    struct gb_yield_point mean = {.density = density, .direction = direction};
    double ignored;
    gb_average_values(from->p, from->count, &mean.p_pa, &mean.p_error_pa);
    gb_average_values(from->q, from->count, &mean.q_pa, &mean.q_error_pa);
    gb_average_values(from->volume, from->count, &mean.flow_volume, &ignored);
    gb_average_values(from->shear, from->count, &mean.flow_shear, &ignored);
    return mean;
}

size_t gb_card_fit_points(const struct gb_card_cell *cells, int count, int without,
                          const struct gb_card_options *options,
                          struct gb_yield_point *points)
{
    struct gathered gathered;
    const int used = count - (without >= 0);
    size_t size = 0;
    for (int k = 0; k < options->levels; k++) {
        for (int d = 0; d < options->directions; d++) {
            const double direction = gb_card_options_direction(options, d);
            gather(&gathered, cells, count, without, options->density[k], direction);
            if (2 * (int)gathered.count >= used && gathered.count >= 2) {
                points[size++] = mean_of(&gathered, options->density[k], direction);
            }
        }
    }
    return size;
}

/* Means over the cells of one level: density, pressure, K and G. */
static struct gb_card_level mean_level(const struct gb_card_cell *cells, int count,
                                       int without, int level)
{
    struct gb_card_level mean = {.density = 0.0};
    const double share = 1.0 / (count - (without >= 0));
    for (int c = 0; c < count; c++) {
        if (c != without) {
            const struct gb_card_level *one = &cells[c].level[level];
            mean.density += share * one->density;
            mean.p_pa += share * one->p_pa;
            mean.bulk += share * one->bulk;
            mean.shear_modulus += share * one->shear_modulus;
        }
    }
    return mean;
}

static bool fit_level(struct gb_card_values *card, int level, double density,
                      const struct gb_yield_point *points, size_t size,
                      const struct gb_card_options *options, struct gb_error *err)
{
    struct gb_yield_point own[GB_CARD_DIRECTIONS_MAX];
    struct gb_cap_fit fit;
    struct gb_error why = {0};
    size_t count = 0;
    for (size_t i = 0; i < size; i++) {
        if (points[i].density == density) {
            own[count++] = points[i];
        }
    }
    if (!gb_cap_fit(&fit, own, count, options->transition, options->flow, &why)) {
        return gb_error_set(err, why.code, "card, density %.4f: %.300s", density,
                            why.text);
    }
    double *value = card->value[level];
    value[GB_CARD_D] = fit.d.value;
    value[GB_CARD_BETA] = fit.beta.value;
    value[GB_CARD_R] = fit.r.value;
    value[GB_CARD_P_A] = fit.p_a.value;
    value[GB_CARD_P_B] = fit.p_b.value;
    card->rms[level] = fit.rms;
    memcpy(card->misses[level], fit.misses, sizeof fit.misses);
    return true;
}

/* Between two compacts the density grows by elastic and plastic strain; K is the mean of
 * both. */
static double plastic_growth(const struct gb_card_level *a, const struct gb_card_level *b)
{
    return log(b->density / a->density) -
           (b->p_pa - a->p_pa) / (0.5 * (a->bulk + b->bulk));
}

bool gb_card_fit_values(struct gb_card_values *card, const struct gb_card_cell *cells,
                        int count, int without, const struct gb_card_options *options,
                        const struct gb_yield_point *points, size_t size,
                        struct gb_error *err)
{
    struct gb_cap_row rows[GB_CARD_LEVELS_MAX];
    struct gb_card_level last = {.density = 0.0};
    for (int k = 0; k < options->levels; k++) {
        const struct gb_card_level level = mean_level(cells, count, without, k);
        const double bulk = level.bulk, shear = level.shear_modulus;
        double *value = card->value[k];
        card->density[k] = level.density;
        card->pressed_pa[k] = level.p_pa;
        value[GB_CARD_YOUNG] = 9.0 * bulk * shear / (3.0 * bulk + shear);
        value[GB_CARD_POISSON] =
            (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
        value[GB_CARD_PLASTIC] =
            k == 0 ? 0.0
                   : card->value[k - 1][GB_CARD_PLASTIC] + plastic_growth(&last, &level);
        if (!fit_level(card, k, options->density[k], points, size, options, err)) {
            return false;
        }
        if (k == 0) {
            /* p_b is measured when the probes have flowed by the offset */
            card->start_density =
                level.density * exp(options->offset - level.p_pa / level.bulk);
        }
        last = level;
    }
    const struct gb_cap_material material =
        gb_card_fit_material(card, options->levels, options->transition, rows);
    return gb_cap_path_check(&material, err);
}

bool gb_card_fit_predict(const struct gb_card_values *card, int levels, double transition,
                         enum gb_card_path path, const double *density, size_t size,
                         double *ratio, double *pz, struct gb_error *err)
{
    struct gb_cap_row rows[GB_CARD_LEVELS_MAX];
    const struct gb_cap_material material =
        gb_card_fit_material(card, levels, transition, rows);
    struct gb_cap_state state = {.density = card->start_density};
    for (size_t i = 0; i < size; i++) {
        double strain[6] = {0.0};
        ratio[i] = pz[i] = (double)NAN;
        if (density[i] <= card->start_density) {
            continue;
        }
        const double volume = log(density[i] / state.density);
        if (path == GB_CARD_ISOTROPIC) {
            strain[0] = strain[1] = strain[2] = volume / 3.0;
        } else {
            strain[2] = volume;
        }
        if (!gb_cap_path_strain(&material, &state, strain, err)) {
            return false;
        }
        ratio[i] = state.pressure[0] / state.pressure[2];
        pz[i] = state.pressure[2];
    }
    return true;
}
