#include "figures/figures_label.h"

#include <pango/pango.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/field/field_symbol.h"

/* Keys with a phrase of their own; others are written "symbol = value", or "key = value"
 * where they have no symbol. */
static const struct {
    const char *key, *format;
} short_forms[] = {
    {"loading.geometry", "%s"},
    {"contact.normal", "%s"},
    {"material.name", "%s"},
    {"numerics.fidelity", "%s"},
    {"contact.bridge_radius", "bridge radius %s"},
    {"contact.relative_motion", "%s motion"},
};

/* Keys that follow from others or carry no information in a figure. */
static const char *const omitted[] = {"structure.base",      "loading.until",
                                      "loading.unload_from", "output.",
                                      "loading.record",      NULL};

/* Longest label, characters. */
enum { MAX_LENGTH = 60 };

static bool is_omitted(const char *key, const char *except)
{
    for (int k = 0; omitted[k] != NULL; k++) {
        if (g_str_has_prefix(key, omitted[k])) {
            return true;
        }
    }
    return except != NULL && strcmp(key, except) == 0;
}

/* The value of a key as markup: the prefix micro as a Greek letter. */
static char *value_markup(const char *value)
{
    char *safe = g_markup_escape_text(value, -1);
    const gsize length = strlen(safe);
    const bool micro =
        length > 3 && safe[length - 2] == 'u' && strchr("msN", safe[length - 1]) != NULL;
    if (micro && strchr(" /", safe[length - 3]) != NULL) {
        char *greek =
            g_strdup_printf("%.*s\xce\xbc%c", (int)length - 2, safe, safe[length - 1]);
        g_free(safe);
        return greek;
    }
    return safe;
}

static const char *short_form(const char *key)
{
    for (gsize k = 0; k < G_N_ELEMENTS(short_forms); k++) {
        if (strcmp(short_forms[k].key, key) == 0) {
            return short_forms[k].format;
        }
    }
    return NULL;
}

/* Symbol of "group.key", or the key without its group; g_free. */
static char *symbol_of(const char *name)
{
    const struct gb_field *field = gb_params_find_name(name, NULL);
    const char *symbol = field != NULL ? gb_field_symbol(field) : NULL;
    const char *dot = strchr(name, '.');
    return symbol != NULL ? g_strdup(symbol)
                          : g_markup_escape_text(dot ? dot + 1 : name, -1);
}

/* Adds "group.key = value" in short form. */
static void append_part(GString *label, const char *part, const char *except)
{
    char **sides = g_strsplit(part, " = ", 2);
    if (sides[0] != NULL && sides[1] != NULL && !is_omitted(sides[0], except)) {
        char *value = value_markup(sides[1]);
        g_string_append(label, label->len > 0 ? ", " : "");
        const char *form = short_form(sides[0]);
        if (form != NULL) {
            char **halves = g_strsplit(form, "%s", 2);
            g_string_append_printf(label, "%s%s%s", halves[0], value, halves[1]);
            g_strfreev(halves);
        } else {
            char *symbol = symbol_of(sides[0]);
            g_string_append_printf(label, "%s = %s", symbol, value);
            g_free(symbol);
        }
        g_free(value);
    }
    g_strfreev(sides);
}

/* Characters without the markup. */
static glong visible_length(const char *markup)
{
    char *plain = NULL;
    if (!pango_parse_markup(markup, -1, 0, NULL, &plain, NULL, NULL)) {
        return (glong)strlen(markup);
    }
    const glong length = g_utf8_strlen(plain, -1);
    g_free(plain);
    return length;
}

/* "key = value, ..." in short form; frees the long one. */
static GString *shorten(char *full, const char *except)
{
    char **parts = g_strsplit(full, ", ", -1);
    GString *label = g_string_new(NULL);
    for (int k = 0; parts[k] != NULL; k++) {
        append_part(label, parts[k], except);
    }
    g_strfreev(parts);
    g_free(full);
    return label;
}

static bool has_title_of_another(const struct gb_runset *set, size_t group)
{
    const char *title = gb_runset_first(set, group)->params.title;
    for (size_t g = 0; g < set->groups; g++) {
        if (g != group && strcmp(gb_runset_first(set, g)->params.title, title) == 0) {
            return true;
        }
    }
    return false;
}

static void append_directory(GString *label, const struct gb_runset *set, size_t group)
{
    char *name = g_path_get_basename(gb_runset_first(set, group)->directory);
    char *escaped = g_markup_escape_text(name, -1);
    g_string_append_printf(label, ": %s", escaped);
    g_free(escaped);
    g_free(name);
}

/* Groups with many differences are named by their titles, and groups of one title by
 * their differences, or by the directory of the first run where there are too many. */
static void use_title(GString *label, const struct gb_runset *set, size_t group,
                      const char *except)
{
    char *title = g_markup_escape_text(gb_runset_first(set, group)->params.title, -1);
    GString *differences = shorten(gb_runset_label_of_title(set, group), except);
    g_string_assign(label, title);
    if (differences->len > 0 && visible_length(differences->str) <= MAX_LENGTH) {
        g_string_append_printf(label, ": %s", differences->str);
    } else if (has_title_of_another(set, group)) {
        append_directory(label, set, group);
    }
    g_string_free(differences, TRUE);
    g_free(title);
}

char *gb_figures_label(const struct gb_runset *set, size_t group, const char *except)
{
    GString *label = shorten(gb_runset_label(set, group), except);
    const bool empty = label->len == 0 && except == NULL;
    if (empty || visible_length(label->str) > MAX_LENGTH) {
        use_title(label, set, group, except);
    }
    return g_string_free(label, FALSE);
}

char *gb_figures_label_axis(const char *key, const char *unit)
{
    char *symbol = symbol_of(key);
    char *value = g_strconcat("1 ", unit, NULL);
    char *shown = value_markup(value);
    char *label =
        *unit ? g_strdup_printf("%s (%s)", symbol, shown + 2) : g_strdup(symbol);
    g_free(shown);
    g_free(value);
    g_free(symbol);
    return label;
}

size_t gb_figures_label_groups(struct gb_series *series, const struct gb_runset *set)
{
    size_t max = 0;
    for (size_t g = 0; g < set->groups; g++) {
        const size_t members = gb_runset_members(set, g);
        char *label = gb_runset_label(set, g);
        gb_series_note(series, "group %zu: %zu runs%s%s", g + 1, members,
                       *label ? ", " : "", label);
        g_free(label);
        max = MAX(max, members);
    }
    return max;
}

void gb_figures_label_note(struct gb_series *series, const struct gb_runset *set)
{
    const size_t max = gb_figures_label_groups(series, set);
    size_t min = max;
    for (size_t g = 0; g < set->groups; g++) {
        min = MIN(min, gb_runset_members(set, g));
    }
    if (max > min) {
        gb_series_caption(series,
                          "Means of %zu to %zu runs; bands and bars: standard error.",
                          min, max);
    } else if (max > 1) {
        gb_series_caption(series, "Means of %zu runs; bands and bars: standard error.",
                          max);
    }
}

bool gb_figures_label_means(struct gb_series *series,
                            const struct gb_series_sample *sample,
                            const struct gb_runset *set, const double *grid,
                            const char *name, const char *unit, struct gb_error *err)
{
    for (size_t g = 0; g < set->groups; g++) {
        double *mean = gb_series_column(series, "%s_%zu%s", name, g + 1, unit);
        double *error = gb_series_column(series, "se_%zu%s", g + 1, unit);
        char *label = gb_figures_label(set, g, NULL);
        gb_series_draw(series, grid, mean, error, GB_FIGURE_LINE, (int)g, label);
        g_free(label);
        if (!gb_series_mean(sample, set, g, mean, error, err)) {
            return false;
        }
    }
    return true;
}

/* Points of a run that are not in equilibrium, behind those of earlier runs of its group.
 * Columns, two from `column` on, are made with the first. */
static bool append_unrelaxed(struct gb_series *series, const struct gb_runset_run *run,
                             const struct gb_figures_label_axes *axes, guint column,
                             size_t *used, struct gb_error *err)
{
    double *x = NULL, *y = NULL;
    size_t count = 0;
    const bool good =
        gb_runset_unrelaxed(run, axes->branch, axes->x, axes->y, &x, &y, &count, err);
    if (good && count > 0 && *used == 0) {
        (void)gb_series_column(series, "unrelaxed_%zu_%s", run->group + 1, axes->x);
        (void)gb_series_column(series, "unrelaxed_%zu_%s", run->group + 1, axes->y);
    }
    gb_series_grow(series, *used + count);
    for (size_t i = 0; good && i < count; i++) {
        ((double *)g_ptr_array_index(series->columns, column))[*used] = x[i];
        ((double *)g_ptr_array_index(series->columns, column + 1))[(*used)++] = y[i];
    }
    gb_alloc_free(x);
    gb_alloc_free(y);
    return good;
}

static bool draw_unrelaxed(struct gb_series *series, const struct gb_runset *set,
                           size_t group, const struct gb_figures_label_axes *axes,
                           size_t *all, struct gb_error *err)
{
    const guint column = series->columns->len;
    size_t used = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (set->run[i].group == group &&
            !append_unrelaxed(series, &set->run[i], axes, column, &used, err)) {
            return false;
        }
    }
    if (used > 0) {
        gb_series_draw(series, g_ptr_array_index(series->columns, column),
                       g_ptr_array_index(series->columns, column + 1), NULL,
                       GB_FIGURE_POINTS, (int)group, NULL)
            ->open = true;
    }
    *all += used;
    return true;
}

bool gb_figures_label_unrelaxed(struct gb_series *series, const struct gb_runset *set,
                                const struct gb_figures_label_axes *axes,
                                struct gb_error *err)
{
    size_t all = 0;
    for (size_t g = 0; g < set->groups; g++) {
        if (!draw_unrelaxed(series, set, g, axes, &all, err)) {
            return false;
        }
    }
    if (all > 0) {
        gb_series_caption(series,
                          "Hollow: points that are not in equilibrium (%zu); the "
                          "means leave them out.",
                          all);
    }
    return true;
}
