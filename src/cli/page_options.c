#include "cli/page_options.h"

#include "draw/image/image.h"

bool gb_page_options_take(const struct gb_page_options *options, int *width, int *height,
                          int *per_inch, struct gb_error *err)
{
    struct gb_image_print print;
    if (options->width == NULL) {
        return (options->per_inch == 0 ||
                gb_error_set(err, GB_ERR_INPUT, "--dpi: expected with --width")) &&
               (options->size == NULL ||
                gb_image_parse_size(options->size, width, height, err));
    }
    if (options->size != NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "--size, --width: expected one of them");
    }
    if (!gb_image_parse_print(options->width,
                              options->per_inch != 0 ? options->per_inch : 300, &print,
                              err)) {
        return false;
    }
    *width = print.width;
    *height = print.height;
    *per_inch = print.per_inch;
    return true;
}

static void append_column(GString *text, const struct gb_image_journal *row,
                          const char *columns, double mm)
{
    if (mm > 0.0) {
        char *name = g_strconcat(row->name, columns, NULL);
        g_string_append_printf(text, "  %-13s%5g mm", name, mm);
        g_free(name);
    } else {
        g_string_append_printf(text, "  %21s", "");
    }
}

char *gb_page_options_journals(void)
{
    GString *text = g_string_new("Columns of journals for --width: one, one and a half, "
                                 "two (sources in docs/figures.md):\n");
    for (const struct gb_image_journal *row = gb_image_journals; row->name != NULL;
         row++) {
        append_column(text, row, "", row->single_mm);
        append_column(text, row, "-1.5", row->middle_mm);
        append_column(text, row, "-2", row->double_mm);
        g_string_append_c(text, '\n');
    }
    return g_string_free(text, FALSE);
}

void gb_page_options_finish(struct gb_page_options *options)
{
    g_free(options->size);
    g_free(options->width);
}
