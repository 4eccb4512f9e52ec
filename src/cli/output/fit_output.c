#include "cli/output/fit_output.h"

#include <math.h>
#include <string.h>

#include "base/number.h"

/* ",value" with all digits; only "," for none or an infinite one. */
static void append_cell(GString *text, double value)
{
    char number[GB_NUMBER_MAX];
    g_string_append_printf(text, ",%s",
                           isfinite(value) ? gb_number_write(value, number) : "");
}

static void append_row(GString *text, const char *equation, const char *name,
                       const struct gb_fit_value *value, const char *unit)
{
    g_string_append_printf(text, "%s,%s", equation, name);
    append_cell(text, value->value);
    append_cell(text, value->low);
    append_cell(text, value->high);
    g_string_append_printf(text, ",%s\n", unit);
}

/* A figure without an interval. */
static void append_figure(GString *text, const char *equation, const char *name,
                          double value, const char *unit)
{
    const struct gb_fit_value row = {value, NAN, NAN, NAN};
    append_row(text, equation, name, &row, unit);
}

/* The ends of Heckel's straightest stretch, MPa. */
static void stretch_ends(const struct gb_compaction_fits *fits,
                         const struct gb_equations_points *points, double ends[2])
{
    ends[0] = points->pressure[fits->stretch.first];
    ends[1] = points->pressure[fits->stretch.first + fits->stretch.count - 1];
}

static bool is_heckel(const struct gb_compaction_fits *fits, size_t index)
{
    return gb_compaction_fits_reported(fits, index) == &fits->heckel;
}

GString *gb_fit_output_csv(const struct gb_compaction_fits *fits,
                           const struct gb_compaction_data *data)
{
    GString *text = g_string_new("equation,parameter,value,low,high,unit\n");
    for (size_t i = 0; i < fits->fitted; i++) {
        const char *name = fits->fit[i].equation->name;
        for (size_t k = 0; k < gb_compaction_fits_values(fits, i); k++) {
            const struct gb_compaction_value value = gb_compaction_fits_value(fits, i, k);
            append_row(text, name, value.name, &value.value, value.unit);
        }
        if (is_heckel(fits, i)) {
            double ends[2];
            stretch_ends(fits, &data->points, ends);
            append_figure(text, name, "stretch_from", ends[0], "MPa");
            append_figure(text, name, "stretch_to", ends[1], "MPa");
        }
        append_figure(text, name, "rms", fits->fit[i].all.rms, "1");
        append_figure(text, name, "aicc", fits->fit[i].all.aicc, "1");
    }
    return text;
}

/* What was fitted to what. */
static void append_head(GString *text, const struct gb_compaction_data *data)
{
    const struct gb_equations_points *points = &data->points;
    if (data->curves > 0) {
        g_string_append_printf(text, "%zu run%s, ", data->curves,
                               data->curves == 1 ? "" : "s");
    }
    g_string_append_printf(
        text, "%zu points from %.4g to %.4g MPa, density %.4f to %.4f\n", points->count,
        points->pressure[0], points->pressure[points->count - 1], points->density[0],
        points->density[points->count - 1]);
    g_string_append_printf(text, "weights: %s; initial density D0: ",
                           points->error == NULL ? "equal"
                           : data->curves > 0    ? "standard errors of the replicas"
                                                 : "errors of the densities");
    if (isnan(points->initial)) {
        g_string_append(text, "unknown, fitted\n");
    } else {
        g_string_append_printf(text, "%.4g\n", points->initial);
    }
    g_string_append(text, "least squares in the density, 95 % intervals; dAICc: 0 is the "
                          "best description\n\n");
}

static void append_value(GString *text, const struct gb_compaction_value *value)
{
    g_string_append_printf(text, "  %-15s %12.5g", value->name, value->value.value);
    g_string_append_printf(text, "   %12.5g to %-12.5g %s\n", value->value.low,
                           value->value.high,
                           strcmp(value->unit, "1") == 0 ? "" : value->unit);
}

GString *gb_fit_output_text(const struct gb_compaction_fits *fits,
                            const struct gb_compaction_data *data)
{
    GString *text = g_string_new(NULL);
    append_head(text, data);
    for (size_t i = 0; i < fits->fitted; i++) {
        const struct gb_compaction_fit *row = &fits->fit[i];
        g_string_append_printf(text, "%s: dAICc %.1f, rms %.2g   %s\n",
                               row->equation->name, row->delta, row->all.rms,
                               row->equation->form);
        if (is_heckel(fits, i)) {
            double ends[2];
            stretch_ends(fits, &data->points, ends);
            g_string_append_printf(text,
                                   "  straightest stretch: %.4g to %.4g MPa, %zu points, "
                                   "R2 %.6f\n",
                                   ends[0], ends[1], fits->stretch.count,
                                   fits->stretch.determination);
        }
        for (size_t k = 0; k < gb_compaction_fits_values(fits, i); k++) {
            const struct gb_compaction_value value = gb_compaction_fits_value(fits, i, k);
            append_value(text, &value);
        }
    }
    for (size_t i = fits->fitted; i < fits->count; i++) {
        g_string_append_printf(text, "%s%s\n", i == fits->fitted ? "\nnot fitted:\n" : "",
                               fits->fit[i].refusal.text);
    }
    return text;
}
