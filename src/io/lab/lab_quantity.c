#include "io/lab/lab_quantity.h"

#include <math.h>
#include <string.h>

const struct gb_lab_quantity_row gb_lab_quantity_rows[GB_LAB_QUANTITIES] = {
    {"density", "density_error", "density", 0.0, 1.0},
    {"lateral_ratio", "lateral_ratio_error", "lateral ratio", 0.0, 10.0},
    {"coordination", "coordination_error", "coordination", 0.0, 15.0},
    {"unloading_modulus_GPa", "unloading_modulus_GPa_error", "unloading modulus, GPa",
     0.0, INFINITY},
};

const char *const gb_lab_quantity_columns[] = {"p_MPa", "lateral_ratio", "coordination",
                                               "unloading_modulus_GPa", NULL};

bool gb_lab_quantity_is_further(const char *name)
{
    for (int q = GB_LAB_QUANTITY_DENSITY + 1; q < GB_LAB_QUANTITIES; q++) {
        const struct gb_lab_quantity_row *row = &gb_lab_quantity_rows[q];
        if (strcmp(name, row->name) == 0 || strcmp(name, row->error) == 0) {
            return true;
        }
    }
    return strcmp(name, "weight") == 0;
}
