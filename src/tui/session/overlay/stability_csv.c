#include "tui/session/overlay/stability_csv.h"

#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/table.h"
#include "scene/loading_kind.h"
#include "scene/tolerances.h"

enum { P, DENSITY, MEASURED, USED, MARGIN, STABLE, IN_USE, COLUMNS };

static const char *const names[COLUMNS] = {"p_MPa",  "density", "measured", "used",
                                           "margin", "stable",  "in_use"};

static bool fill(struct gb_stability_csv *out, const struct gb_table *table,
                 struct gb_error *err)
{
    const double *column[COLUMNS];
    for (int k = 0; k < COLUMNS; k++) {
        column[k] = gb_table_column(table, names[k], err);
        if (column[k] == NULL) {
            return false;
        }
    }
    const size_t rows = gb_table_rows(table);
    out->row = gb_alloc_array(rows + 1, sizeof *out->row, err);
    out->p_mpa = gb_alloc_array(rows + 1, sizeof *out->p_mpa, err);
    out->margin = gb_alloc_array(rows + 1, sizeof *out->margin, err);
    if (out->row == NULL || out->p_mpa == NULL || out->margin == NULL) {
        return false;
    }
    out->count = rows;
    for (size_t i = 0; i < rows; i++) {
        out->row[i] = (struct gb_stability_csv_row){.density = column[DENSITY][i],
                                                    .measured = column[MEASURED][i],
                                                    .used = column[USED][i],
                                                    .stable = column[STABLE][i] > 0.0,
                                                    .in_use = column[IN_USE][i] > 0.0};
        g_strlcpy(out->row[i].method, gb_table_word(table, i), sizeof out->row[i].method);
        out->in_time = strcmp(out->row[i].method, "verlet") == 0;
        out->p_mpa[i] = column[P][i];
        out->margin[i] = column[MARGIN][i];
    }
    return true;
}

bool gb_stability_csv_read(struct gb_stability_csv **out, const char *path,
                           struct gb_error *err)
{
    struct gb_table *table = NULL;
    if (!gb_table_read(&table, path, "method", err)) {
        return false;
    }
    struct gb_stability_csv *fresh = gb_alloc_array(1, sizeof *fresh, err);
    const bool good = fresh != NULL && fill(fresh, table, err);
    gb_table_destroy(table);
    if (!good) {
        gb_stability_csv_destroy(fresh);
        return false;
    }
    *out = fresh;
    return true;
}

void gb_stability_csv_destroy(struct gb_stability_csv *table)
{
    if (table != NULL) {
        gb_alloc_free(table->row);
        gb_alloc_free(table->p_mpa);
        gb_alloc_free(table->margin);
        gb_alloc_free(table);
    }
}

size_t gb_stability_csv_weakest(const struct gb_stability_csv *table)
{
    size_t weakest = table->count;
    for (size_t i = 0; i < table->count; i++) {
        if (table->row[i].in_use &&
            (weakest == table->count || table->margin[i] < table->margin[weakest])) {
            weakest = i;
        }
    }
    return weakest;
}

bool gb_stability_csv_apply(const struct gb_stability_csv *table, size_t i,
                            struct gb_params *params, char *text, size_t size,
                            struct gb_error *err)
{
    const struct gb_stability_csv_row *row = &table->row[i];
    if (gb_loading_kind_of(params)->follows_time) {
        snprintf(text, size, "numerics.time_step=%.3g T",
                 GB_STEP_CRITICAL_FRACTION * row->measured);
    } else if (row->stable) {
        snprintf(text, size, "numerics.relaxer=%s", row->method);
    } else {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s is not stable here: it takes %.3g, accepted up to %.3g",
                            row->method, row->used, row->measured);
    }
    return gb_params_assign(params, text, err);
}
