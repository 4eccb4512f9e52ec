#include "scene/field/field_words.h"

#include <string.h>

#include <glib.h>

#include "scene/field/params_table.h"

enum { EXACT = 100, SYNONYM = 80, BEGINS = 60, CONTAINS = 50, WORDS = 10 };

/* Name of a Greek letter: alpha to omega, final sigma included, and the micro sign. */
static const char *greek_name(gunichar ch)
{
    static const char *const names[] = {"alpha",   "beta", "gamma", "delta", "epsilon",
                                        "zeta",    "eta",  "theta", "iota",  "kappa",
                                        "lambda",  "mu",   "nu",    "xi",    "omicron",
                                        "pi",      "rho",  "sigma", "sigma", "tau",
                                        "upsilon", "phi",  "chi",   "psi",   "omega"};
    enum { FIRST = 0x3b1, MICRO = 0xb5, EPSILON_SYMBOL = 0x3f5, PHI_SYMBOL = 0x3d5 };
    if (ch == MICRO) {
        return "mu";
    }
    if (ch == EPSILON_SYMBOL || ch == PHI_SYMBOL) {
        return ch == PHI_SYMBOL ? "phi" : "epsilon";
    }
    return ch >= FIRST && ch < FIRST + G_N_ELEMENTS(names) ? names[ch - FIRST] : NULL;
}

/* Lower case, Greek letters by name, one blank between words; g_free. */
static char *normal_form(const char *text)
{
    char *valid = g_utf8_make_valid(text, -1);
    char *lower = g_utf8_strdown(valid, -1);
    GString *form = g_string_new("");
    for (const char *at = lower; *at != '\0'; at = g_utf8_next_char(at)) {
        const gunichar ch = g_utf8_get_char(at);
        const char *name = greek_name(ch);
        if (name != NULL) {
            g_string_append(form, name);
        } else if (ch == '_' || ch == '-' || g_unichar_isspace(ch)) {
            g_string_append(form,
                            form->len > 0 && form->str[form->len - 1] != ' ' ? " " : "");
        } else {
            g_string_append_unichar(form, ch);
        }
    }
    g_free(lower);
    g_free(valid);
    return g_strchomp(g_string_free(form, FALSE));
}

/* Does a word of the text begin with this? */
static bool word_begins(const char *text, const char *begin)
{
    for (const char *at = strstr(text, begin); at != NULL; at = strstr(at + 1, begin)) {
        if (at == text || !g_ascii_isalnum(at[-1])) {
            return true;
        }
    }
    return false;
}

static bool has_synonym(const char *words, const char *wanted)
{
    char **list = g_strsplit(words, ",", -1);
    bool found = false;
    for (size_t i = 0; list[i] != NULL; i++) {
        found = found || strcmp(g_strstrip(list[i]), wanted) == 0;
    }
    g_strfreev(list);
    return found;
}

/* Is each word of `wanted` the beginning of a word of the description? */
static bool all_begin(const char *description, const char *wanted)
{
    char **word = g_strsplit(wanted, " ", -1);
    bool all = true;
    for (size_t i = 0; word[i] != NULL; i++) {
        all = all && word_begins(description, word[i]);
    }
    g_strfreev(word);
    return all;
}

int gb_field_words_rank(const struct gb_field *field, const char *text)
{
    char *wanted = normal_form(text);
    char *key = normal_form(field->key);
    char *full = g_strconcat(field->group, ".", key, NULL);
    char *words = normal_form(field->words != NULL ? field->words : "");
    char *meaning = normal_form(field->meaning);
    char *description =
        g_strconcat(field->group, " ", key, " ", words, " ", meaning, NULL);
    const int rank = strcmp(key, wanted) == 0 || strcmp(full, wanted) == 0 ? EXACT
                     : has_synonym(words, wanted)                          ? SYNONYM
                     : g_str_has_prefix(key, wanted)                       ? BEGINS
                     : strstr(full, wanted) != NULL                        ? CONTAINS
                     : all_begin(description, wanted)                      ? WORDS
                                                                           : 0;
    g_free(description);
    g_free(meaning);
    g_free(words);
    g_free(full);
    g_free(key);
    g_free(wanted);
    return rank;
}

const struct gb_field *gb_field_words_find(const char *word)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_table(&count);
    const struct gb_field *found = NULL;
    for (size_t i = 0; i < count; i++) {
        if (gb_field_words_rank(&fields[i], word) == SYNONYM) {
            if (found != NULL) {
                return NULL;
            }
            found = &fields[i];
        }
    }
    return found;
}
