#include "io/lab/lab_private.h"

#include <stdint.h>
#include <string.h>

/* Words of the columns `branch` and `series`. */

/* "Loading", "Belastung" and "Entlastung" are the words of a curve.csv. */
static const char *branch_word(const char *text)
{
    static const struct {
        const char *start, *word;
    } words[] = {{"load", "load"},
                 {"belast", "load"},
                 {"charge", "load"},
                 {"unload", "unload"},
                 {"entlast", "unload"},
                 {"d\xc3\xa9"
                  "charge",
                  "unload"},
                 {"down", "unload"},
                 {"up", "load"}};
    char *lower = g_utf8_strdown(text, -1);
    const char *found = text;
    for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
        if (g_str_has_prefix(lower, words[i].start)) {
            found = words[i].word;
            break;
        }
    }
    g_free(lower);
    return found;
}

/* Merged cells of a spreadsheet have their word in the first row. */
static void continue_words(struct gb_lab_reading *reading)
{
    bool continued = false;
    for (size_t i = 1; i < reading->count; i++) {
        if (*reading->word[i] == '\0' && *reading->word[i - 1] != '\0') {
            reading->word[i] = reading->word[i - 1];
            continued = true;
        }
    }
    if (continued) {
        g_string_append(reading->said, ", empty series continue the one above");
    }
}

static size_t count_different(const struct gb_lab_reading *reading)
{
    GHashTable *set = g_hash_table_new(g_str_hash, g_str_equal);
    for (size_t i = 0; i < reading->count; i++) {
        g_hash_table_add(set, (char *)(uintptr_t)reading->word[i]);
    }
    const size_t different = g_hash_table_size(set);
    g_hash_table_destroy(set);
    return different;
}

/* Where every row has a word of its own, it is the name of a compact. */
static void drop_row_names(struct gb_lab_reading *reading)
{
    struct gb_lab_column *series = &reading->column[GB_LAB_ROLE_SERIES];
    if (series->guessed && reading->count > 1 &&
        count_different(reading) == reading->count) {
        series->index = GB_LAB_NONE;
        for (size_t i = 0; i < reading->count; i++) {
            reading->word[i] = "";
        }
    }
}

void gb_lab_words_settle(struct gb_lab_reading *reading)
{
    if (reading->column[GB_LAB_ROLE_BRANCH].index != GB_LAB_NONE) {
        for (size_t i = 0; i < reading->count; i++) {
            reading->word[i] = branch_word(reading->word[i]);
        }
    } else if (reading->column[GB_LAB_ROLE_SERIES].index != GB_LAB_NONE) {
        continue_words(reading);
        drop_row_names(reading);
    }
}
