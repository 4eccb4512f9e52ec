#ifndef GB_FIGURES_LAWS_ROD_MODEL_H
#define GB_FIGURES_LAWS_ROD_MODEL_H

#include "scene/model.h"

/* Model of a scene with the contact laws of P1.  Errors: those of gb_model_init;
 * GB_ERR_INPUT for a scene with other contact laws. */
bool gb_rod_model_init(struct gb_model *model, const struct gb_params *scene,
                       const char *figure, struct gb_error *err);

#endif
