#include "figures/report/report_conditions.h"

#include <math.h>
#include <string.h>

#include "scene/derived.h"
#include "scene/loading_kind.h"
#include "scene/normal_law.h"

enum { MATERIAL, PARTICLES, CELLS, SEEDS, LAW, LOADING, FIDELITY };
enum { SEEDS_LISTED = 6, VALUES_IN_CAPTION = 3 };

const char *const gb_report_conditions_heads[GB_REPORT_CONDITIONS] = {
    "material", "particles", "cells", "seeds", "contact law", "loading", "fidelity"};

/* Value of a key as in a preset. */
static void append_value(GString *text, const struct gb_params *params, const char *group,
                         const char *key)
{
    char *buffer = g_malloc(GB_PARAMS_VALUE_MAX);
    const struct gb_field *field = gb_params_find(group, key);
    g_string_append(text, gb_params_format(params, field, buffer, GB_PARAMS_VALUE_MAX));
    g_free(buffer);
}

static void append_key(GString *text, const char *before, const struct gb_params *params,
                       const char *group, const char *key)
{
    g_string_append(text, before);
    append_value(text, params, group, key);
}

static void append_particles(GString *text, const struct gb_params *params)
{
    g_string_append_printf(text, "%" G_GINT64_FORMAT " %s, ", params->count,
                           params->dimension == 2 ? "discs" : "spheres");
    if (params->distribution == GB_DISTRIBUTION_MONO) {
        append_key(text, "d = ", params, "particles", "diameter");
    } else {
        append_value(text, params, "particles", "distribution");
    }
}

static int compare_seeds(const void *a, const void *b)
{
    const uint64_t one = *(const uint64_t *)a;
    const uint64_t two = *(const uint64_t *)b;
    return (one > two) - (one < two);
}

/* "1, 2, 5", or "1 to 10 (10)" of many. */
static void append_seeds(GString *text, const struct gb_runset *set, size_t group)
{
    uint64_t *seeds = g_new(uint64_t, set->count);
    size_t count = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (set->run[i].group == group) {
            seeds[count++] = set->run[i].params.seed;
        }
    }
    qsort(seeds, count, sizeof *seeds, compare_seeds);
    if (count > SEEDS_LISTED) {
        g_string_append_printf(text,
                               "%" G_GUINT64_FORMAT " to %" G_GUINT64_FORMAT " (%zu)",
                               seeds[0], seeds[count - 1], count);
    } else {
        for (size_t i = 0; i < count; i++) {
            g_string_append_printf(text, "%s%" G_GUINT64_FORMAT, i > 0 ? ", " : "",
                                   seeds[i]);
        }
    }
    g_free(seeds);
}

static void append_law(GString *text, const struct gb_params *params)
{
    g_string_append(text, gb_normal_law_of(params)->name);
    append_key(text, ", mu = ", params, "contact", "mu");
    if (gb_normal_law_of(params)->pair) {
        return;
    }
    if (gb_derived_bridge_length_m(params) < gb_derived_reference_m(params)) {
        append_key(text, ", bridges from ", params, "contact", "bridge_length");
    } else {
        g_string_append(text, ", no bridges");
    }
    g_string_append(text, params->epsilon_j > 0.0 ? ", attraction" : "");
}

static void append_loading(GString *text, const struct gb_params *params)
{
    const struct gb_loading_kind *kind = gb_loading_kind_of(params);
    if (gb_loading_kind_follows_path(params)) {
        append_key(text, "path ", params, "loading", "path");
        return;
    }
    if (kind->periodic_cell) {
        append_value(text, params, "loading", "geometry");
    } else {
        g_string_append(text, "die");
    }
    append_key(text, " to ", params, "loading", "until");
    if (kind->given_rate) {
        append_key(text, ", rate ", params, "loading", "rate");
    }
    if (kind->unloading_branches && params->unload_count > 0) {
        GString *from = g_string_new(NULL);
        append_value(from, params, "loading", "unload_from");
        g_string_replace(from, ";", ",", 0); /* conditions are separated by ';' */
        g_string_append_printf(text, ", unloading from %s", from->str);
        g_string_free(from, TRUE);
    }
}

char *gb_report_conditions_of(const struct gb_runset *set, size_t group, int condition)
{
    const struct gb_params *params = &gb_runset_first(set, group)->params;
    GString *text = g_string_new(NULL);
    switch (condition) {
    case MATERIAL:
        g_string_append(text, params->material);
        break;
    case PARTICLES:
        append_particles(text, params);
        break;
    case CELLS:
        g_string_append_printf(text, "%zu", gb_runset_members(set, group));
        break;
    case SEEDS:
        append_seeds(text, set, group);
        break;
    case LAW:
        append_law(text, params);
        break;
    case LOADING:
        append_loading(text, params);
        break;
    default:
        append_value(text, params, "numerics", "fidelity");
    }
    return g_string_free(text, FALSE);
}

/* Values of a condition in the order of the groups, each once. */
static GPtrArray *values_of(const struct gb_runset *set, int condition)
{
    GPtrArray *values = g_ptr_array_new_with_free_func(g_free);
    for (size_t g = 0; g < set->groups; g++) {
        char *value = gb_report_conditions_of(set, g, condition);
        if (g_ptr_array_find_with_equal_func(values, value, g_str_equal, NULL)) {
            g_free(value);
        } else {
            g_ptr_array_add(values, value);
        }
    }
    return values;
}

static void append_condition(GString *text, const struct gb_runset *set, int condition)
{
    static const char *const before[GB_REPORT_CONDITIONS] = {[CELLS] = "cells: ",
                                                             [SEEDS] = "seeds ",
                                                             [LAW] = "law ",
                                                             [FIDELITY] = "fidelity "};
    GPtrArray *values = values_of(set, condition);
    g_string_append(text, text->len > 0 ? "; " : "Conditions: ");
    g_string_append(text, before[condition] != NULL ? before[condition] : "");
    if (values->len > VALUES_IN_CAPTION) {
        g_string_append_printf(text, "%u values of %s (Table 1)", values->len,
                               gb_report_conditions_heads[condition]);
    }
    for (guint k = 0; k < values->len && values->len <= VALUES_IN_CAPTION; k++) {
        g_string_append_printf(text, "%s%s", k > 0 ? " or " : "",
                               (const char *)g_ptr_array_index(values, k));
    }
    g_ptr_array_unref(values);
}

char *gb_report_conditions_caption(const struct gb_runset *set)
{
    GString *text = g_string_new(NULL);
    for (int k = 0; k < GB_REPORT_CONDITIONS; k++) {
        append_condition(text, set, k);
    }
    g_string_append_c(text, '.');
    return g_string_free(text, FALSE);
}
