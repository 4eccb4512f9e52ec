#include <math.h>
#include <string.h>

#include "figures/report/report.h"
#include "figures/report/report_references.h"
#include "figures/report/report_table.h"
#include "many/lab/compaction_data.h"
#include "measure/fit/compaction/compaction_fits.h"

/* A number, or an empty cell for an end without bound. */
static void put_number(struct gb_report_table *table, double value)
{
    if (isfinite(value)) {
        gb_report_table_put(table, "%.4g", value);
    } else {
        gb_report_table_put(table, "%s", "");
    }
}

static void put_fit(struct gb_report_table *table, const char *scene,
                    const struct gb_compaction_fits *fits, size_t index)
{
    const struct gb_compaction_fit *row = &fits->fit[index];
    for (size_t k = 0; k < gb_compaction_fits_values(fits, index); k++) {
        const struct gb_compaction_value value = gb_compaction_fits_value(fits, index, k);
        gb_report_table_put(table, "%s", scene);
        gb_report_table_put(table, "%s", row->equation->name);
        gb_report_table_put(table, "%.1f", row->delta);
        gb_report_table_put(table, "%.2g", row->all.rms);
        gb_report_table_put(table, "%s", value.name);
        put_number(table, value.value.value);
        put_number(table, value.value.low);
        put_number(table, value.value.high);
        gb_report_table_put(table, "%s", value.unit);
    }
}

/* What is fitted, to which points, and Heckel's stretch. */
static void describe(struct gb_report *report, const char *scene,
                     const struct gb_compaction_data *data,
                     const struct gb_compaction_fits *fits)
{
    const struct gb_equations_points *points = &data->points;
    GString *text = g_string_new(scene);
    g_string_append_printf(text, ": %zu pressures from %.4g to %.4g MPa", points->count,
                           points->pressure[0], points->pressure[points->count - 1]);
    if (fits->heckel.equation != NULL) {
        g_string_append_printf(
            text, "; Heckel on the straightest stretch, %.4g to %.4g MPa",
            points->pressure[fits->stretch.first],
            points->pressure[fits->stretch.first + fits->stretch.count - 1]);
    }
    g_string_append_c(text, '.');
    gb_page_paragraph(&report->page, text->str);
    g_string_free(text, TRUE);
}

static bool add_group(struct gb_report *report, struct gb_report_table *table,
                      size_t group, struct gb_error *err)
{
    static const struct gb_compaction_window window = {
        .from = (double)NAN, .to = (double)NAN, .initial = (double)NAN};
    struct gb_compaction_data data = {0};
    struct gb_compaction_fits fits;
    struct gb_error cause = {0};
    if (!gb_compaction_data_runs(&data, report->set, group, &window, &cause)) {
        return cause.code == GB_ERR_INPUT ||
               gb_error_set(err, cause.code, "%s", cause.text);
    }
    const bool good =
        gb_compaction_fits(&fits, &data.points, NULL, GB_COMPACTION_PROFILE, err);
    if (good) {
        char *scene = gb_report_table_scene(report->set, group);
        describe(report, scene, &data, &fits);
        for (size_t i = 0; i < fits.fitted; i++) {
            const struct gb_equation *equation = fits.fit[i].equation;
            put_fit(table, scene, &fits, i);
            gb_report_references_cite_name(report, equation->name, equation->source);
        }
        g_free(scene);
    }
    gb_compaction_data_finish(&data);
    return good;
}

bool gb_report_fits(struct gb_report *report, struct gb_error *err)
{
    static const char *const heads[] = {"scene", "equation", "dAICc", "rms",  "parameter",
                                        "value", "low",      "high",  "unit", NULL};
    struct gb_report_table table;
    bool good = true;
    gb_report_table_begin(&table, heads);
    for (size_t g = 0; g < report->set->groups && good; g++) {
        good = add_group(report, &table, g, err);
    }
    char *caption = gb_report_caption(
        report, "Equations of compaction by AICc, least squares in the density: "
                "parameters with 95 % intervals; an empty cell has no bound.");
    const bool written =
        gb_report_table_end(report, &table, "fits", caption, good ? err : NULL);
    g_free(caption);
    return written && good;
}
