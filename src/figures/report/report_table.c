#include "figures/report/report_table.h"

#include <math.h>
#include <string.h>

#include "base/file.h"
#include "base/number.h"

void gb_report_table_begin(struct gb_report_table *table, const char *const *heads)
{
    table->columns = 0;
    table->markup = -1;
    for (int k = 0; heads[k] != NULL; k++) {
        table->heads[table->columns++] = heads[k];
    }
    table->cells = g_ptr_array_new_with_free_func(g_free);
}

void gb_report_table_put(struct gb_report_table *table, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    g_ptr_array_add(table->cells, g_strdup_vprintf(format, arguments));
    va_end(arguments);
}

void gb_report_table_put_mean(struct gb_report_table *table, double mean, double error,
                              int decimals)
{
    if (fabs(mean) < 0.5 * pow(10.0, -decimals)) {
        mean = 0.0; /* no "-0" */
    }
    if (!isfinite(mean)) {
        gb_report_table_put(table, "%s", "");
    } else if (error > 0.0) {
        char number[GB_NUMBER_ERROR_MAX];
        gb_report_table_put(table, "%s",
                            gb_number_error(mean, error, 2, " \xc2\xb1 ", number));
    } else {
        gb_report_table_put(table, "%.*f", decimals, mean);
    }
}

static void append_csv(GString *text, const char *const *cells,
                       const struct gb_report_table *table)
{
    for (guint k = 0; k < table->columns; k++) {
        char *plain =
            (int)k == table->markup ? gb_page_plain(cells[k]) : g_strdup(cells[k]);
        char **parts = g_strsplit(plain, "\"", -1);
        char *quoted = g_strjoinv("\"\"", parts);
        g_string_append_printf(text, "%s\"%s\"", k > 0 ? "," : "", quoted);
        g_free(quoted);
        g_free(plain);
        g_strfreev(parts);
    }
    g_string_append_c(text, '\n');
}

bool gb_report_table_end(struct gb_report *report, struct gb_report_table *table,
                         const char *name, const char *caption, struct gb_error *err)
{
    if (table->cells->len == 0) {
        g_ptr_array_unref(table->cells);
        return true;
    }
    char *numbered = g_strdup_printf("Table %d. %s", ++report->tables, caption);
    char *file = g_strdup_printf("tables/%s.csv", name);
    char *path = g_build_filename(report->folder, file, NULL);
    GString *text = g_string_new(NULL);
    append_csv(text, table->heads, table);
    for (guint k = 0; k + table->columns <= table->cells->len; k += table->columns) {
        append_csv(text, (const char *const *)table->cells->pdata + k, table);
    }
    const bool good = gb_file_replace(path, text->str, text->len, err);
    const struct gb_page_table_content content = {numbered, file, table->heads,
                                                  table->columns, table->markup};
    gb_page_table(&report->page, &content, table->cells);
    g_string_free(text, TRUE);
    g_free(numbered);
    g_free(path);
    g_free(file);
    g_ptr_array_unref(table->cells);
    return good;
}

char *gb_report_table_scene(const struct gb_runset *set, size_t group)
{
    char *label = gb_runset_label(set, group);
    if (*label != '\0' && strlen(label) < 120) {
        return label;
    }
    g_free(label);
    return g_strdup(gb_runset_first(set, group)->params.title);
}
