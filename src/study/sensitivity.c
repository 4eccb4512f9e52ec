/* Sobol indices of the density in a sweep: how much of its variance comes from each key. */
#include "study/sensitivity.h"

#include <glib.h>
#include <math.h>

#include "base/alloc.h"
#include "base/listing.h"
#include "base/number.h"
#include "many/param_sweep.h"
#include "measure/surrogate.h"

/* Sensitivities of what a sweep by a design measures: which varied key its figures depend
 * on, apart from the scatter of the cells. */

/* --- indices -------------------------------------------------------------------------- */

/* A range of values that is rounding beside their mean. */
static const double least_range = 1e-9;

struct work {
    struct gb_param_sweep *sweep;
    struct gb_sweep_readings *reading; /* of each point */
    double *at;                        /* points x keys, -1 to 1 */
    double *value;                     /* points x replicas */
};

static bool open_work(struct work *work, struct gb_error *err)
{
    const struct gb_ensemble *ensemble = &work->sweep->ensemble;
    const struct gb_axes *axes = &work->sweep->axes;
    work->reading = gb_alloc_array(ensemble->points, sizeof *work->reading, err);
    work->at = gb_alloc_array(ensemble->points * axes->count, sizeof(double), err);
    work->value =
        gb_alloc_array(ensemble->points * ensemble->replicas, sizeof(double), err);
    if (!work->reading || !work->at || !work->value) {
        return false;
    }
    for (size_t p = 0; p < ensemble->points; p++) {
        gb_param_sweep_readings_init(&work->reading[p], &work->sweep->ensemble, p,
                                     &work->sweep->at);
        for (size_t k = 0; k < axes->count; k++) {
            work->at[p * axes->count + k] = 2.0 * axes->axis[k].share[p] - 1.0;
        }
    }
    return true;
}

static void close_work(struct work *work)
{
    for (size_t p = 0; work->reading != NULL && p < work->sweep->ensemble.points; p++) {
        gb_param_sweep_readings_finish(&work->reading[p]);
    }
    gb_alloc_free(work->reading);
    gb_alloc_free(work->at);
    gb_alloc_free(work->value);
}

/* Values of one figure; false where they do not vary. */
static bool collect(const struct work *work, const struct gb_sensitivity_item *of)
{
    const struct gb_ensemble *ensemble = &work->sweep->ensemble;
    double low = INFINITY, high = -INFINITY;
    for (size_t p = 0; p < ensemble->points; p++) {
        const double *from = gb_param_sweep_readings_at(&work->reading[p], of->branch,
                                                        of->pressure, of->quantity);
        for (size_t r = 0; r < ensemble->replicas; r++) {
            const double value = r < work->reading[p].runs ? from[r] : (double)NAN;
            work->value[p * ensemble->replicas + r] = value;
            low = fmin(low, value);
            high = fmax(high, value);
        }
    }
    return high - low > least_range * fmax(fabs(high), fabs(low));
}

/* Adds a figure where it has enough values. */
static bool add(struct gb_sensitivity *sensitivity, const struct work *work,
                struct gb_sensitivity_item of, struct gb_error *err)
{
    const struct gb_ensemble *ensemble = &work->sweep->ensemble;
    struct gb_error why = {0};
    if (!collect(work, &of)) {
        return true;
    }
    if (gb_surrogate_sobol(&of.indices, work->sweep->axes.count, ensemble->points,
                           ensemble->replicas, work->at, work->value, &why)) {
        sensitivity->item[sensitivity->count++] = of;
        return true;
    }
    return why.code == GB_ERR_INPUT || gb_error_set(err, why.code, "%s", why.text);
}

static bool fill(struct gb_sensitivity *sensitivity, const struct work *work,
                 struct gb_error *err)
{
    const size_t pressures = work->sweep->at.count;
    struct gb_sensitivity_item of = {0};
    for (of.branch = 0; of.branch < GB_SWEEP_BRANCHES; of.branch++) {
        for (of.pressure = 0; of.pressure < pressures; of.pressure++) {
            for (of.quantity = 0; of.quantity < GB_READING_QUANTITIES; of.quantity++) {
                if (!add(sensitivity, work, of, err)) {
                    return false;
                }
            }
        }
    }
    return true;
}

bool gb_sensitivity_check(const struct gb_axes *axes, struct gb_error *err)
{
    const size_t terms = gb_surrogate_terms(axes->count, GB_SURROGATE_QUADRATIC);
    return axes->design >= terms ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--design sobol:%zu: expected %zu points or more for %zu keys, "
                        "the terms of a quadratic",
                        axes->design, terms, axes->count);
}

bool gb_sensitivity_init(struct gb_sensitivity *sensitivity, struct gb_param_sweep *sweep,
                         struct gb_error *err)
{
    struct work work = {.sweep = sweep};
    *sensitivity = (struct gb_sensitivity){0};
    sensitivity->item =
        gb_alloc_array(GB_SWEEP_BRANCHES * sweep->at.count * GB_READING_QUANTITIES,
                       sizeof *sensitivity->item, err);
    const bool good = sensitivity->item != NULL && open_work(&work, err) &&
                      fill(sensitivity, &work, err);
    close_work(&work);
    return good;
}

void gb_sensitivity_finish(struct gb_sensitivity *sensitivity)
{
    gb_alloc_free(sensitivity->item);
    *sensitivity = (struct gb_sensitivity){0};
}

/* --- table and text ------------------------------------------------------------------- */

static void add_key(GString *text, const struct gb_param_sweep *sweep, size_t key)
{
    const struct gb_field *field = sweep->axes.axis[key].field;
    g_string_append_printf(text, "%s.%s", field->group, field->key);
}

static void add_rows(struct gb_listing *listing, const struct gb_sensitivity_item *of,
                     const struct gb_param_sweep *sweep)
{
    const struct gb_sobol_indices *indices = &of->indices;
    for (size_t k = 0; k < sweep->axes.count; k++) {
        const double number[] = {indices->first[k], indices->first_error[k],
                                 indices->total[k], indices->total_error[k],
                                 indices->mean,     indices->range_sd,
                                 indices->seed_sd,  indices->unexplained};
        GString *key = g_string_new(NULL);
        add_key(key, sweep, k);
        gb_listing_text(listing, gb_param_sweep_branch(of->branch));
        gb_listing_number(listing, sweep->at.pa[of->pressure] / 1e6);
        gb_listing_text(listing, gb_reading_name((enum gb_reading_quantity)of->quantity));
        gb_listing_text(listing, key->str);
        gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
        g_string_free(key, TRUE);
    }
}

GString *gb_sensitivity_table(const struct gb_sensitivity *sensitivity,
                              const struct gb_param_sweep *sweep)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(
        listing,
        "greenbody " GB_VERSION "\n"
        "shares of the variance of a figure over the ranges of the keys, by a key alone "
        "(first_order)\n"
        "and with its products (total), without the scatter of cells; _error: standard "
        "errors; range_sd:\n"
        "standard deviation by the keys; cell_sd: between cells at one point; "
        "unexplained: share that\n"
        "a quadratic of the keys lacks");
    gb_listing_columns(listing, "%s", "branch");
    gb_listing_columns(listing, "%.12g", "p_MPa");
    gb_listing_columns(listing, "%s", "quantity,key");
    gb_listing_columns(listing, "%.6g",
                       "first_order,first_order_error,total,total_error,mean,range_sd,"
                       "cell_sd,unexplained");
    for (size_t i = 0; i < sensitivity->count; i++) {
        add_rows(listing, &sensitivity->item[i], sweep);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

static const struct gb_sensitivity_item *
find_last_density(const struct gb_sensitivity *sensitivity)
{
    const struct gb_sensitivity_item *found = NULL;
    for (size_t i = 0; i < sensitivity->count; i++) {
        const struct gb_sensitivity_item *of = &sensitivity->item[i];
        found = of->branch == 0 && of->quantity == GB_READING_DENSITY ? of : found;
    }
    return found;
}

/* Columns of a share with its error. */
enum { SHARE_COLS = 16 };

static void add_share(GString *text, int width, double share, double error)
{
    char number[GB_NUMBER_ERROR_MAX];
    if (error > 0.0) {
        gb_number_error(share, error, 2, " +- ", number);
    } else {
        gb_number_shown("%.3f", share, number);
    }
    g_string_append_printf(text, "   %-*s", width, number);
}

GString *gb_sensitivity_lines(const struct gb_sensitivity *sensitivity,
                              const struct gb_param_sweep *sweep)
{
    GString *text = g_string_new(NULL);
    const struct gb_sensitivity_item *of = find_last_density(sensitivity);
    if (of == NULL) {
        return text;
    }
    const struct gb_sobol_indices *indices = &of->indices;
    g_string_append_printf(text,
                           "density at %.6g MPa: mean %.4f, standard deviation %.4f by "
                           "the keys",
                           sweep->at.pa[of->pressure] / 1e6, indices->mean,
                           indices->range_sd);
    if (isfinite(indices->seed_sd)) {
        g_string_append_printf(text, ", %.4f between cells", indices->seed_sd);
    }
    g_string_append(text, "\nshare of the variance by the keys, alone and in all:\n");
    for (size_t k = 0; k < sweep->axes.count; k++) {
        g_string_append(text, "  ");
        const gsize begin = text->len;
        add_key(text, sweep, k);
        g_string_append_printf(text, "%*s", MAX(1, 26 - (int)(text->len - begin)), "");
        add_share(text, SHARE_COLS, indices->first[k], indices->first_error[k]);
        add_share(text, 0, indices->total[k], indices->total_error[k]);
        g_string_append_c(text, '\n');
    }
    if (indices->unexplained > 0.1) {
        g_string_append_printf(text,
                               "a quadratic of the keys lacks %.0f %% of the variance: "
                               "narrower ranges give shares to rely on\n",
                               100.0 * indices->unexplained);
    }
    return text;
}
