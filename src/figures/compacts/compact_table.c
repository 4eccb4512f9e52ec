#include "figures/compacts/compact_table.h"

#include <math.h>

bool gb_compact_table_read(struct gb_table **table, const struct gb_figures_input *input,
                           const char *command, const char *file, const char *words,
                           struct gb_error *err)
{
    if (input->words[0] == NULL || input->words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "the figure takes one directory of `greenbody %s`", command);
    }
    char *path = g_build_filename(input->words[0], file, NULL);
    const bool good = gb_table_read(table, path, words, err);
    g_free(path);
    return good;
}

bool gb_compact_table_columns(const struct gb_table *table, const char *const *names,
                              size_t count, const double **column, struct gb_error *err)
{
    for (size_t k = 0; k < count; k++) {
        column[k] = gb_table_column(table, names[k], err);
        if (column[k] == NULL) {
            return false;
        }
    }
    return true;
}

static bool is_among(const double *value, size_t count, double wanted)
{
    for (size_t k = 0; k < count; k++) {
        if (value[k] == wanted) {
            return true;
        }
    }
    return false;
}

size_t gb_compact_table_distinct(const struct gb_table *table, const double *column,
                                 const double *where, double equal, double *value,
                                 size_t most)
{
    size_t count = 0;
    for (size_t i = 0; i < gb_table_rows(table) && count < most; i++) {
        if (isfinite(column[i]) && (where == NULL || where[i] == equal) &&
            !is_among(value, count, column[i])) {
            value[count++] = column[i];
        }
    }
    return count;
}
