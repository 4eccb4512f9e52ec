#ifndef GB_SCENE_UNEQUAL_PAIR_H
#define GB_SCENE_UNEQUAL_PAIR_H

#include "law/law_unequal.h"
#include "scene/model.h"

/* The laws of a model for two particles of the given diameters (in d). */
void gb_unequal_pair_init(struct gb_law_unequal *law, const struct gb_model *model,
                          double first, double second);

#endif
