#include "figures/laws/hardening_models.h"

#include <math.h>

const struct gb_hardening_model gb_hardening_models[GB_HARDENING_MODELS] = {
    {0.0, NAN, "<i>m</i> = 0", "m0"},
    {0.05, NAN, "<i>m</i> = 0.05", "m0.05"},
    {0.1, NAN, "<i>m</i> = 0.1", "m0.1"},
    {0.2, NAN, "<i>m</i> = 0.2", "m0.2"},
    {0.05, 1480e6, "<i>m</i> = 0.05, 1480 MPa", "m0.05_printed"},
};

struct gb_params gb_hardening_models_scene(const struct gb_params *scene, int row)
{
    const struct gb_hardening_model *model = &gb_hardening_models[row];
    struct gb_params params = *scene;
    params.hardening = model->exponent;
    params.hollomon_pa =
        isnan(model->strength_pa) ? params.hollomon_pa : model->strength_pa;
    return params;
}
