#include "scene/field/first_defaults.h"

#include <string.h>

void gb_first_defaults_init(struct gb_params *params)
{
    gb_params_init(params);
    params->generator = GB_GENERATOR_MT19937;
}

bool gb_first_defaults_meant(const char *text)
{
    static const char line[] = "# greenbody 0.1.";
    return strncmp(text, line, sizeof line - 1) == 0;
}
