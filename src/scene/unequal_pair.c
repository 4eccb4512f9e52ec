#include "scene/unequal_pair.h"

void gb_unequal_pair_init(struct gb_law_unequal *law, const struct gb_model *model,
                          double first, double second)
{
    gb_law_unequal_init(law, &model->rod, &model->bridge, &model->dispersion, first,
                        second);
}
