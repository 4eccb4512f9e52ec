#include "study/card/card_options.h"

#include <math.h>

#include <string.h>

#include "measure/cap/cap.h"

/* Beyond 135 degrees it is tension.  The surface of a compact that was pressed uniaxially is
 * not the same in extension: only compression counts. */
const struct gb_card_path_row gb_card_options_paths[GB_CARD_PATHS] = {
    [GB_CARD_UNIAXIAL] = {"uniaxial", "uniaxial to density 0.99", 0.0, 0.75 * M_PI},
    [GB_CARD_ISOTROPIC] = {"isotropic", "isotropic to density 0.99", -0.75 * M_PI,
                           0.75 * M_PI},
};

bool gb_card_options_path(enum gb_card_path *path, const char *name, struct gb_error *err)
{
    for (int k = 0; k < GB_CARD_PATHS; k++) {
        if (strcmp(name, gb_card_options_paths[k].name) == 0) {
            *path = (enum gb_card_path)k;
            return true;
        }
    }
    return gb_error_set(err, GB_ERR_INPUT,
                        "--compacts '%.40s': accepted uniaxial, isotropic", name);
}

void gb_card_options_init(struct gb_card_options *options)
{
    *options = (struct gb_card_options){.replicas = 8,
                                        .directions = 19,
                                        .inside = 0.5,
                                        .offset = 1e-2,
                                        .step = 1e-4,
                                        .strain_most = 0.06,
                                        .press_tolerance = 5e-3,
                                        .tolerance = 1e-3,
                                        .transition = GB_CAP_TRANSITION,
                                        .flow = 1.0};
}

double gb_card_options_direction(const struct gb_card_options *options, int index)
{
    const struct gb_card_path_row *row = &gb_card_options_paths[options->path];
    return row->direction_from +
           (row->direction_to - row->direction_from) * index / (options->directions - 1);
}

static bool refuse(struct gb_error *err, const char *name, double value,
                   const char *accepted)
{
    return gb_error_set(err, GB_ERR_INPUT, "--%s %g: accepted %s", name, value, accepted);
}

bool gb_card_options_check(const struct gb_card_options *options, struct gb_error *err)
{
    if (options->replicas < 3 || options->replicas > 1000) {
        return refuse(err, "replicas", options->replicas, "3 to 1000");
    }
    if (options->directions < 15 || options->directions > GB_CARD_DIRECTIONS_MAX) {
        return refuse(err, "directions", options->directions, "15 to 72");
    }
    if (!(options->offset >= 1e-4 && options->offset <= 0.02)) {
        return refuse(err, "offset", 100.0 * options->offset, "0.01 to 2 %");
    }
    if (!(options->transition >= 0.0 && options->transition <= 0.1)) {
        return refuse(err, "transition", options->transition, "0 to 0.1");
    }
    if (!(options->flow >= 0.0 && options->flow <= 10.0)) {
        return refuse(err, "flow", options->flow, "0 to 10");
    }
    for (int k = 0; k < options->levels; k++) {
        const double density = options->density[k];
        if (!(density > 0.0 && density < 0.95) ||
            (k > 0 && density <= options->density[k - 1])) {
            return refuse(err, "densities", density, "0 to 0.95, ascending");
        }
    }
    return true;
}
