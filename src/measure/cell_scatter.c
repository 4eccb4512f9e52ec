#include "measure/cell_scatter.h"

#include <math.h>

static const double deviation = 0.0064;
static const double of_count = 1000.0;
static const double exponent = 0.4;

double gb_cell_scatter(const struct gb_params *params)
{
    const bool random = params->structure == GB_STRUCTURE_GROWN;
    return random && params->kind == GB_KIND_QUASISTATIC && params->dimension == 3 &&
                   params->from.path[0] == '\0' && params->count > 0
               ? deviation * pow(of_count / (double)params->count, exponent)
               : (double)NAN;
}
