#include "scene/quasistatic_scene.h"

#include <stdio.h>
#include <string.h>

bool gb_quasistatic_scene_check(const struct gb_params *params, struct gb_error *err)
{
    (void)params;
    (void)err;
    return true;
}

void gb_quasistatic_scene_freeze(struct gb_model *model, const struct gb_params *params)
{
    (void)model;
    (void)params;
}

const char *gb_quasistatic_scene_note(const struct gb_model *model, int index,
                                      char *buffer, size_t size)
{
    const struct gb_numerics *numerics = &model->numerics;
    if (index != 0) {
        return NULL;
    }
    snprintf(buffer, size,
             "relaxer %s, strain steps in %d part%s, tolerance %g of the mean contact "
             "force%s, at most %lld evaluations per part, %s precision",
             numerics->relaxer, numerics->parts, numerics->parts == 1 ? "" : "s",
             numerics->tolerance,
             strcmp(numerics->relaxer, "predict") == 0 ? " (less under light loads)" : "",
             (long long)numerics->max_evaluations,
             numerics->single ? "single" : "double");
    return buffer;
}
