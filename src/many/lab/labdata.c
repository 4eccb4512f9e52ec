#include "many/lab/labdata.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/table.h"
#include "base/units.h"
#include "many/runset.h"

/* Pressures that differ by less are one. */
static const double same_pressure = 1e-9;

/* "particles.diameter_nm" and 9.7: the assignment "particles.diameter=9.7 nm"; a name
 * without unit is a pure number.  Keys themselves may have '_'. */
static bool assign(struct gb_params *params, const char *column, double value,
                   struct gb_error *err)
{
    char number[G_ASCII_DTOSTR_BUF_SIZE];
    char **words = g_strsplit(column, ".", 2);
    char *key = words[1];
    const char *unit = "";
    g_ascii_formatd(number, sizeof number, "%.15g", value);
    if (gb_params_find(words[0], key) == NULL && strrchr(key, '_') != NULL) {
        char *low = strrchr(key, '_');
        *low = '\0';
        unit = low + 1;
    }
    const struct gb_field *field = gb_params_find(words[0], key);
    char *text = g_strconcat(number, *unit ? " " : "", unit, NULL);
    const bool good =
        field != NULL ? gb_params_set(params, field, text, err)
                      : gb_error_set(err, GB_ERR_INPUT,
                                     "column %.80s: no such key, or key_unit", column);
    g_free(text);
    g_strfreev(words);
    return good;
}

static bool is_known(const char *name)
{
    static const char *const known[] = {"p_MPa",         "density", "p_MPa_error",
                                        "density_error", "branch",  "series"};
    for (size_t i = 0; i < G_N_ELEMENTS(known); i++) {
        if (strcmp(name, known[i]) == 0) {
            return true;
        }
    }
    return strchr(name, '.') != NULL;
}

static bool check_columns(const struct gb_table *table, struct gb_error *err)
{
    for (size_t k = 0; gb_table_name(table, k) != NULL; k++) {
        if (!is_known(gb_table_name(table, k))) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%.200s: column %.80s; accepted p_MPa, density, "
                                "density_error, branch, series and keys as "
                                "particles.diameter_nm",
                                gb_table_path(table), gb_table_name(table, k));
        }
    }
    return true;
}

static bool has_series(const struct gb_table *table)
{
    const char *words = gb_table_words(table);
    return words != NULL && strcmp(words, "series") == 0;
}

/* Samples of one scene would be fitted as one curve. */
static bool check_series(const struct gb_table *table, struct gb_error *err)
{
    for (size_t i = 1; i < gb_table_rows(table) && has_series(table); i++) {
        const char *word = gb_table_word(table, i);
        if (strcmp(word, gb_table_word(table, 0)) != 0) {
            return gb_error_set(
                err, GB_ERR_INPUT,
                "%.200s:%d: series %.80s behind %.80s; accepted one, with "
                "--series, or columns of keys as particles.diameter_nm",
                gb_table_path(table), gb_table_line(table, i), word,
                gb_table_word(table, 0));
        }
    }
    return true;
}

/* Unloads from this pressure, too. */
static bool add_unloading(struct gb_params *scene, double pressure_pa)
{
    int at = 0;
    while (at < scene->unload_count &&
           scene->unload_from_pa[at] < pressure_pa * (1.0 - same_pressure)) {
        at++;
    }
    if (at < scene->unload_count &&
        scene->unload_from_pa[at] <= pressure_pa * (1.0 + same_pressure)) {
        return true;
    }
    if (scene->unload_count == GB_UNLOAD_MAX) {
        return false;
    }
    for (int i = scene->unload_count++; i > at; i--) {
        scene->unload_from_pa[i] = scene->unload_from_pa[i - 1];
    }
    scene->unload_from_pa[at] = pressure_pa;
    return true;
}

/* The scene with the keys of a row, found or added. */
static bool find_scene(struct gb_labdata *measured, const struct gb_table *table,
                       size_t row, const struct gb_params *base, size_t *scene,
                       struct gb_error *err)
{
    struct gb_params params = *base;
    for (size_t k = 0; gb_table_name(table, k) != NULL; k++) {
        const char *name = gb_table_name(table, k);
        const double *column =
            strchr(name, '.') ? gb_table_column(table, name, err) : NULL;
        if (column != NULL && !isnan(column[row]) &&
            !assign(&params, name, column[row], err)) {
            return false;
        }
    }
    params.unload_count = 0;
    params.until_density = NAN;
    params.until_pressure_pa = 0.0;
    for (*scene = 0; *scene < measured->scenes; (*scene)++) {
        struct gb_params other = measured->scene[*scene];
        other.unload_count = 0;
        other.until_pressure_pa = 0.0;
        memset(other.unload_from_pa, 0, sizeof other.unload_from_pa);
        memset(params.unload_from_pa, 0, sizeof params.unload_from_pa);
        if (gb_runset_same(&params, &other)) {
            return true;
        }
    }
    if (measured->scenes == GB_LABDATA_SCENES) {
        return gb_error_set(err, GB_ERR_INPUT, "%.200s: more than %d different scenes",
                            gb_table_path(table), GB_LABDATA_SCENES);
    }
    measured->scene[measured->scenes++] = params;
    return true;
}

static bool refuse_row(const struct gb_table *table, size_t row, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT,
                        "%.200s:%d: accepted a pressure above 0, a density between 0 "
                        "and 1, an error above 0, and load or unload",
                        gb_table_path(table), gb_table_line(table, row));
}

static bool take_row(struct gb_labdata *measured, const struct gb_table *table,
                     size_t row, const struct gb_params *base, struct gb_error *err)
{
    const double *pressure = gb_table_column(table, "p_MPa", NULL);
    const double *density = gb_table_column(table, "density", NULL);
    const double *error = gb_table_column(table, "density_error", NULL);
    const char *word = has_series(table) ? "" : gb_table_word(table, row);
    struct gb_labdata_row *to = &measured->row[row];
    to->unloaded = strcmp(word, "unload") == 0;
    if (!(pressure[row] > 0.0 && density[row] > 0.0 && density[row] < 1.0) ||
        (error != NULL && !(error[row] > 0.0)) ||
        !(to->unloaded || *word == '\0' || strcmp(word, "load") == 0)) {
        return refuse_row(table, row, err);
    }
    if (!find_scene(measured, table, row, base, &to->scene, err)) {
        return false;
    }
    struct gb_params *scene = &measured->scene[to->scene];
    to->pressure_pa = 1e6 * pressure[row];
    to->density = measured->density[row] = density[row];
    if (error != NULL) {
        measured->error[row] = error[row];
    }
    scene->until_pressure_pa = fmax(scene->until_pressure_pa, to->pressure_pa);
    return !to->unloaded || add_unloading(scene, to->pressure_pa) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.200s: more than %d pressures of unloading in one scene",
                        gb_table_path(table), GB_UNLOAD_MAX);
}

static bool alloc_rows(struct gb_labdata *measured, const struct gb_table *table,
                       struct gb_error *err)
{
    measured->count = gb_table_rows(table);
    if (measured->count == 0 || measured->count > GB_LABDATA_ROWS) {
        return gb_error_set(err, GB_ERR_INPUT, "%.200s: %zu rows; accepted 1 to %d",
                            gb_table_path(table), measured->count, GB_LABDATA_ROWS);
    }
    const bool errors = gb_table_column(table, "density_error", NULL) != NULL;
    measured->row = gb_alloc_array(measured->count, sizeof *measured->row, err);
    measured->density = gb_alloc_array(measured->count, sizeof(double), err);
    measured->error =
        errors ? gb_alloc_array(measured->count, sizeof(double), err) : NULL;
    measured->scene = gb_alloc_array(GB_LABDATA_SCENES, sizeof *measured->scene, err);
    return measured->row && measured->density && measured->scene &&
           (measured->error || !errors);
}

bool gb_labdata_take(struct gb_labdata *measured, const struct gb_table *table,
                     const struct gb_params *params, struct gb_error *err)
{
    *measured = (struct gb_labdata){0};
    bool good = check_columns(table, err) && check_series(table, err) &&
                gb_table_column(table, "p_MPa", err) != NULL &&
                gb_table_column(table, "density", err) != NULL &&
                alloc_rows(measured, table, err);
    for (size_t i = 0; i < measured->count && good; i++) {
        good = take_row(measured, table, i, params, err);
    }
    for (size_t s = 0; s < measured->scenes && good; s++) {
        good = gb_params_check(&measured->scene[s], err);
    }
    if (!good) {
        gb_labdata_finish(measured);
    }
    return good;
}

void gb_labdata_finish(struct gb_labdata *measured)
{
    gb_alloc_free(measured->row);
    gb_alloc_free(measured->density);
    gb_alloc_free(measured->error);
    gb_alloc_free(measured->scene);
    *measured = (struct gb_labdata){0};
}
