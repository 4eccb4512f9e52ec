#include "figures/laws/rod_model.h"

bool gb_rod_model_init(struct gb_model *model, const struct gb_params *scene,
                       const char *figure, struct gb_error *err)
{
    if (!gb_model_init(model, scene, err)) {
        return false;
    }
    return !model->cohesionless ||
           gb_error_set(err, GB_ERR_INPUT, "%s: accepted contact.normal = rod", figure);
}
