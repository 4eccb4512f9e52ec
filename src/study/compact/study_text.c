#include "study/compact/study_text.h"

#include <math.h>

#include "io/text_file.h"

void gb_study_text_comment(GString *text, const char *comment)
{
    char **lines = g_strsplit(comment, "\n", -1);
    for (size_t i = 0; lines[i] != NULL; i++) {
        g_string_append_printf(text, "# %s\n", lines[i]);
    }
    g_strfreev(lines);
}

void gb_study_text_cells(GString *text, const double *number, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (i > 0) {
            g_string_append_c(text, ',');
        }
        if (isfinite(number[i])) {
            g_string_append_printf(text, "%.8g", number[i]);
        }
    }
}

void gb_study_text_numbers(GString *text, const double *number, size_t count)
{
    gb_study_text_cells(text, number, count);
    g_string_append_c(text, '\n');
}

/* Digits behind the point that show two of the error. */
static int digits_of(double error, double value)
{
    const double scale = error > 0.0 ? error : 0.01 * fabs(value);
    const double digits = scale > 0.0 ? 1.0 - floor(log10(scale)) : 2.0;
    return (int)fmin(6.0, fmax(0.0, digits));
}

void gb_study_text_value(GString *text, const char *head,
                         const struct gb_fit_value *value, double factor)
{
    const double number = factor * value->value, error = factor * value->error;
    g_string_append(text, head);
    if (!isfinite(number)) {
        g_string_append_c(text, '-');
        return;
    }
    const int digits = digits_of(isfinite(error) ? error : 0.0, number);
    g_string_append_printf(text, "%.*f", digits, number);
    if (isfinite(error)) {
        g_string_append_printf(text, " \xc2\xb1 %.*f", digits, error);
    }
}

bool gb_study_text_write(const struct gb_study_text_file *file, size_t count,
                         const char *directory, struct gb_error *err)
{
    bool good = true;
    for (size_t i = 0; i < count; i++) {
        char *path = g_build_filename(directory, file[i].name, NULL);
        good = good && gb_text_file_replace(path, file[i].text->str, file[i].text->len,
                                            GB_TEXT_FILE_OF_RUN, err);
        g_string_free(file[i].text, TRUE);
        g_free(path);
    }
    return good;
}
