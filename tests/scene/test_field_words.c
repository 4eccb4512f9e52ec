/* Parameters found by symbol, synonym and meaning; errors that name the likely one. */
#include "scene/field/field_words.h"

#include <glib.h>
#include <string.h>

#include "scene/field/nearest_key.h"

/* The parameter that a search offers first. */
static char *first(const char *text)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    const struct gb_field *best = NULL;
    int rank = 0;
    for (size_t i = 0; i < count; i++) {
        const int own = gb_field_words_rank(&fields[i], text);
        if (own > rank) {
            rank = own;
            best = &fields[i];
        }
    }
    return best != NULL ? g_strconcat(best->group, ".", best->key, NULL) : g_strdup("");
}

static void test_search(void)
{
    static const struct {
        const char *text, *found;
    } rows[] = {
        {"friction", "contact.mu"},
        {"Friction coefficient", "contact.mu"},
        {"mu", "contact.mu"},
        {"\u03bc", "contact.mu"}, /* Greek mu */
        {"\u00b5", "contact.mu"}, /* micro sign */
        {"contact.mu", "contact.mu"},
        {"wall friction", "contact.mu_wall"},
        {"mu wall", "contact.mu_wall"},
        {"\u03b1", "contact.alpha"},
        {"alpha", "contact.alpha"},
        {"ALPHA", "contact.alpha"},
        {"\u03c3", "particles.sigma"},
        {"\u03b5", "material.epsilon"},
        {"\u03bd", "material.poisson"},
        {"\u03c1", "material.density"},
        {"E", "material.young"},
        {"N", "particles.count"},
        {"size", "particles.diameter"},
        {"grain size", "particles.diameter"},
        {"elastic modulus", "material.young"},
        {"attraction", "material.epsilon"},
        {"van der waals", "material.epsilon"},
        {"seed", "structure.seed"},
        {"springback", "die.cycle"},
        {"unloading", "loading.unload_from"},
        {"gap", "contact.alpha"},
        {"bridge", "contact.bridge_length"},
        {"convergence", "numerics.tolerance"},
        {"particle periodic", "particles.count"}, /* words of the meaning */
        {"nonsense", ""},
        {"friction nonsense", ""},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        char *found = first(rows[k].text);
        g_test_message("%s", rows[k].text);
        g_assert_cmpstr(found, ==, rows[k].found);
        g_free(found);
    }
}

/* Every word belongs to a parameter, which it finds, and every key is found by itself. */
static void test_words(void)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    for (size_t i = 0; i < count; i++) {
        char **words =
            g_strsplit(fields[i].words != NULL ? fields[i].words : "", ",", -1);
        for (size_t k = 0; words[k] != NULL; k++) {
            g_test_message("%s: %s", fields[i].key, words[k]);
            g_assert_cmpint(gb_field_words_rank(&fields[i], g_strstrip(words[k])), >, 10);
        }
        g_strfreev(words);
        char *full = g_strconcat(fields[i].group, ".", fields[i].key, NULL);
        char *found = first(full);
        g_assert_cmpstr(found, ==, full);
        g_free(found);
        g_free(full);
    }
}

static void test_meant(void)
{
    static const struct {
        const char *given, *meant;
    } rows[] = {
        {"friction", "did you mean contact.mu? "},
        {"contact.friction", "did you mean contact.mu? "},
        {"wall friction", "did you mean contact.mu_wall? "},
        {"muu", "did you mean contact.mu? "},
        {"contact.alhpa", "did you mean contact.alpha? "},
        {"size", ""}, /* of many */
        {"nonsense", ""},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        char text[128];
        g_assert_cmpstr(gb_nearest_key(rows[k].given, text, sizeof text), ==,
                        rows[k].meant);
    }
}

static void refuses(const char *assignment, const char *error)
{
    struct gb_params params;
    struct gb_error err = {0};
    gb_params_init(&params);
    g_assert_false(gb_params_assign(&params, assignment, &err));
    g_assert_cmpstr(err.text, ==, error);
}

static void test_commas(void)
{
    refuses("mu=0,15",
            "contact.mu = 0,15: decimals have a point, thousands no mark: 0.15");
    refuses("contact.mu=,15", "contact.mu = ,15: must be between 0 and 2");
    refuses("count=1,000", "particles.count = 1,000: decimals have a point, thousands no "
                           "mark: 1.000");
    refuses("count=1,000,000",
            "particles.count = 1,000,000: decimals have a point, thousands no mark");
    refuses("until=1,5 GPa",
            "loading.until = 1,5 GPa: decimals have a point, thousands no mark: 1.5 GPa");
    refuses("bridge_length=0,008 d", "contact.bridge_length = 0,008 d: decimals have a "
                                     "point, thousands no mark: 0.008 d");
    refuses(
        "unload_from=0,1 GPa",
        "loading.unload_from = 0,1 GPa: decimals have a point, thousands no mark: 0.1 "
        "GPa");
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/field-words/search", test_search);
    g_test_add_func("/field-words/words", test_words);
    g_test_add_func("/field-words/meant", test_meant);
    g_test_add_func("/field-words/commas", test_commas);
    return g_test_run();
}
