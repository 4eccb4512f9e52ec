#include "study/sensitivity/sensitivity_text.h"

#include <math.h>

#include "base/number.h"
#include "many/sweep/sweep_readings.h"

static void add_number(GString *text, double value)
{
    g_string_append_c(text, ',');
    if (isfinite(value)) {
        g_string_append_printf(text, "%.6g", value);
    }
}

static void add_key(GString *text, const struct gb_param_sweep *sweep, size_t key)
{
    const struct gb_field *field = sweep->axes.axis[key].field;
    g_string_append_printf(text, "%s.%s", field->group, field->key);
}

static void add_rows(GString *text, const struct gb_sensitivity_item *of,
                     const struct gb_param_sweep *sweep)
{
    const struct gb_sobol_indices *indices = &of->indices;
    for (size_t k = 0; k < sweep->axes.count; k++) {
        g_string_append_printf(text, "%s,%.12g,%s,", gb_sweep_readings_branch(of->branch),
                               sweep->at.pa[of->pressure] / 1e6,
                               gb_reading_name((enum gb_reading_quantity)of->quantity));
        add_key(text, sweep, k);
        const double number[] = {indices->first[k], indices->first_error[k],
                                 indices->total[k], indices->total_error[k],
                                 indices->mean,     indices->range_sd,
                                 indices->seed_sd,  indices->unexplained};
        for (size_t i = 0; i < G_N_ELEMENTS(number); i++) {
            add_number(text, number[i]);
        }
        g_string_append_c(text, '\n');
    }
}

GString *gb_sensitivity_text_table(const struct gb_sensitivity *sensitivity,
                                   const struct gb_param_sweep *sweep)
{
    GString *text = g_string_new(
        "# greenbody " GB_VERSION "\n"
        "# shares of the variance of a figure over the ranges of the keys, by a key alone "
        "(first_order)\n"
        "# and with its products (total), without the scatter of cells; _error: standard "
        "errors; range_sd:\n"
        "# standard deviation by the keys; cell_sd: between cells at one point; "
        "unexplained: share that\n"
        "# a quadratic of the keys lacks\n"
        "branch,p_MPa,quantity,key,first_order,first_order_error,total,total_error,mean,"
        "range_sd,cell_sd,unexplained\n");
    for (size_t i = 0; i < sensitivity->count; i++) {
        add_rows(text, &sensitivity->item[i], sweep);
    }
    return text;
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

GString *gb_sensitivity_text_lines(const struct gb_sensitivity *sensitivity,
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
