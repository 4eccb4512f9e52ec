#include "study/study_text.h"

#include <math.h>

#include "base/number.h"
#include "io/text_file.h"

void gb_study_text_value(GString *text, const char *head,
                         const struct gb_fit_value *value, double factor)
{
    const double number = factor * value->value, error = factor * value->error;
    g_string_append(text, head);
    if (!isfinite(number)) {
        g_string_append_c(text, '-');
        return;
    }
    char buffer[GB_NUMBER_ERROR_MAX];
    g_string_append(text, gb_number_error(number, error, 2, " \xc2\xb1 ", buffer));
}

void gb_study_text_mean(struct gb_listing *listing, const struct gb_fit_value *value,
                        double factor)
{
    GString *text = g_string_new(NULL);
    gb_study_text_value(text, "", value, factor);
    gb_listing_text(listing, text->str);
    g_string_free(text, TRUE);
}

void gb_study_text_interval(GString *text, const char *head, const char *format,
                            const struct gb_fit_value *value, double factor)
{
    char number[3][GB_NUMBER_MAX];
    if (!isfinite(value->value)) {
        g_string_append_printf(text, "%s-", head);
        return;
    }
    g_string_append_printf(text, "%s%s (%s to %s)", head,
                           gb_number_shown(format, factor * value->value, number[0]),
                           gb_number_shown(format, factor * value->low, number[1]),
                           gb_number_shown(format, factor * value->high, number[2]));
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
