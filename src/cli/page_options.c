#include "cli/page_options.h"

#include "draw/image/image.h"
#include "draw/image/print_size.h"

bool gb_page_options_take(const struct gb_page_options *options, int *width, int *height,
                          int *per_inch, struct gb_error *err)
{
    struct gb_print_size print;
    if (options->width == NULL) {
        return (options->per_inch == 0 ||
                gb_error_set(err, GB_ERR_INPUT, "--dpi: accepted with --width")) &&
               (options->size == NULL ||
                gb_image_parse_size(options->size, width, height, err));
    }
    if (options->size != NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "--size, --width: accepted one of them");
    }
    if (!gb_print_size_parse(options->width,
                             options->per_inch != 0 ? options->per_inch : 300, &print,
                             err)) {
        return false;
    }
    *width = print.width;
    *height = print.height;
    *per_inch = print.per_inch;
    return true;
}

void gb_page_options_finish(struct gb_page_options *options)
{
    g_free(options->size);
    g_free(options->width);
}
