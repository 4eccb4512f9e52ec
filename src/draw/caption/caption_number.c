#include "draw/caption/caption_number.h"

#include <stdio.h>
#include <string.h>

void gb_caption_number_format(double value, enum gb_dimension dimension, int digits,
                              char *text, size_t size)
{
    char plain[48];
    gb_units_format_short(value, dimension, digits, plain, sizeof plain);
    const char *micro = strstr(plain, " u");
    if (micro != NULL) {
        snprintf(text, size, "%.*s \xce\xbc%s", (int)(micro - plain), plain, micro + 2);
    } else {
        snprintf(text, size, "%s", plain);
    }
}
