#include "base/table_build.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/table_private.h"

static size_t text_length(const struct gb_table_content *content)
{
    size_t length = 0;
    for (size_t k = 0; k < content->columns; k++) {
        length += strlen(content->name[k]) + 1;
    }
    for (size_t i = 0; content->word != NULL && i < content->rows; i++) {
        length += strlen(content->word[i]) + 1;
    }
    return length;
}

/* Copies a string behind the text. */
static char *append(struct gb_table *table, const char *text)
{
    char *at = table->text + table->length;
    const size_t size = strlen(text) + 1;
    memcpy(at, text, size);
    table->length += size;
    return at;
}

static bool reserve(struct gb_table *table, const struct gb_table_content *content,
                    struct gb_error *err)
{
    const size_t rows = content->rows;
    table->path = g_strdup(content->path);
    table->columns = content->columns;
    table->rows = rows;
    table->words = table->units = table->wholes = content->columns;
    table->text = gb_alloc_array(text_length(content) + 1, 1, err);
    table->value = gb_alloc_array(content->columns * rows, sizeof *table->value, err);
    table->word = gb_alloc_array(rows, sizeof *table->word, err);
    table->line = gb_alloc_array(rows, sizeof *table->line, err);
    return table->text && table->value && table->word && table->line;
}

static void fill(struct gb_table *table, const struct gb_table_content *content)
{
    for (size_t k = 0; k < table->columns; k++) {
        table->name[k] = append(table, content->name[k]);
        for (size_t i = 0; i < table->rows; i++) {
            table->value[k * table->rows + i] =
                content->value[k] != NULL ? content->value[k][i] : (double)NAN;
        }
        if (content->value[k] == NULL) {
            table->words = k;
        }
    }
    for (size_t i = 0; i < table->rows; i++) {
        table->line[i] = content->line[i];
        if (content->word != NULL) {
            table->word[i] = append(table, content->word[i]);
        }
    }
}

bool gb_table_build(struct gb_table **out, const struct gb_table_content *content,
                    struct gb_error *err)
{
    struct gb_table *table = gb_alloc_array(1, sizeof *table, err);
    if (table == NULL || !reserve(table, content, err)) {
        gb_table_destroy(table);
        return false;
    }
    fill(table, content);
    *out = table;
    return true;
}

void gb_table_build_keep(struct gb_table *table, const char *word)
{
    const size_t before = table->rows;
    size_t kept = 0;
    for (size_t i = 0; i < before; i++) {
        if (strcmp(gb_table_word(table, i), word) == 0) {
            for (size_t k = 0; k < table->columns; k++) {
                table->value[k * before + kept] = table->value[k * before + i];
            }
            if (table->words < table->columns) {
                table->word[kept] = table->word[i];
            }
            table->line[kept++] = table->line[i];
        }
    }
    for (size_t k = 1; k < table->columns && kept < before; k++) {
        memmove(&table->value[k * kept], &table->value[k * before],
                kept * sizeof *table->value);
    }
    table->rows = kept;
}
