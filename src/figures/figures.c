/* The table of figures, and what follows from a row: help, checks of options, axes. */
#include "figures/figures.h"

#include <string.h>

const char *const gb_figures_after_loading[] = {"loading.hold", "loading.record_time",
                                                NULL};

/* In the order of help and report; the last row of each has no name. */
static const struct gb_figures_row *const tables[] = {
    gb_figures_means_rows,    gb_figures_rates_rows, gb_figures_runs_rows,
    gb_figures_packings_rows, gb_figures_die_rows,   gb_figures_laws_rows,
    gb_figures_compacts_rows, gb_figures_chart_rows,
};

const struct gb_figures_row *gb_figures_at(size_t number)
{
    for (size_t k = 0; k < G_N_ELEMENTS(tables); k++) {
        for (const struct gb_figures_row *row = tables[k]; row->name != NULL; row++) {
            if (number-- == 0) {
                return row;
            }
        }
    }
    return NULL;
}

const struct gb_figures_row *gb_figures_find(const char *name)
{
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        if (strcmp(row->name, name) == 0) {
            break;
        }
    }
    return row;
}

void gb_figures_group(const struct gb_figures_row *row, struct gb_runset *set)
{
    if (row->ignored_keys != NULL) {
        gb_runset_merge(set, row->ignored_keys);
    }
}

/* The function may have set the range of an axis, and its name where the row has none. */
static void set_axis(struct gb_series_axis *axis, const struct gb_series_axis *row)
{
    if (row->name != NULL) {
        axis->name = row->name;
        axis->label = row->label;
        axis->log = row->log;
        axis->several = row->several;
    }
}

void gb_figures_axes(const struct gb_figures_row *row, struct gb_series *series)
{
    set_axis(&series->x, &row->x);
    set_axis(&series->y, &row->y);
}

bool gb_figures_run(const struct gb_figures_row *row, struct gb_series *series,
                    const struct gb_figures_input *input, struct gb_error *err)
{
    const bool done = row->compute != NULL
                          ? row->compute(series, input, err)
                          : gb_figures_means_compute(series, input->set, &row->mean, err);
    if (done) {
        gb_figures_axes(row, series);
    }
    return done;
}

char *gb_figures_describe(const struct gb_figures_row *row)
{
    return *row->source != '\0' ? g_strdup_printf("%s (%s)", row->doc, row->source)
                                : g_strdup(row->doc);
}

char *gb_figures_names(unsigned options)
{
    GString *names = g_string_new(NULL);
    const struct gb_figures_row *row = NULL;
    for (size_t k = 0; (row = gb_figures_at(k)) != NULL; k++) {
        if ((row->options & options) == options) {
            g_string_append_printf(names, "%s%s", names->len > 0 ? ", " : "", row->name);
        }
    }
    return g_string_free(names, FALSE);
}

static const struct {
    unsigned option;
    const char *words;
} options[] = {
    {GB_FIGURES_REFERENCE, "--reference"},
    {GB_FIGURES_DENSITY, "--density"},
    {GB_FIGURES_PRESSURE, "--pressure"},
    {GB_FIGURES_AT, "--at"},
};

bool gb_figures_check_options(const struct gb_figures_row *row, unsigned given,
                              struct gb_error *err)
{
    for (size_t k = 0; k < G_N_ELEMENTS(options); k++) {
        if ((given & options[k].option & ~row->options) != 0) {
            char *names = gb_figures_names(options[k].option);
            gb_error_set(err, GB_ERR_INPUT, "%s is for the figure%s %s", options[k].words,
                         strchr(names, ',') != NULL ? "s" : "", names);
            g_free(names);
            return false;
        }
    }
    if ((row->options & ~given & GB_FIGURES_REFERENCE) != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "the figure %s needs --reference DIR",
                            row->name);
    }
    return true;
}
