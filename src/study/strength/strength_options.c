#include "study/strength/strength_options.h"

#include <stddef.h>

#include "study/compact/cells.h"

const struct gb_strength_test_row gb_strength_options_tests[GB_STRENGTH_TESTS] = {
    [GB_STRENGTH_TENSION] = {"tension", "triaxial to -%g %% at x = y = 0 MPa", -1.0, 2},
    [GB_STRENGTH_COMPRESSION] = {"compression", "triaxial to %g %% at x = y = 0 MPa", 1.0,
                                 2},
    [GB_STRENGTH_SHEAR] = {"shear", "shear xz to %g %% at z = 0 MPa", -1.0, 4},
};

void gb_strength_options_init(struct gb_strength_options *options)
{
    *options = (struct gb_strength_options){
        .marks = {.count = 3, .point = {{false, 50e6}, {false, 100e6}, {false, 200e6}}},
        .replicas = 8,
        .step = 1e-3,
        .strain_most = 0.1,
        .fall = 0.6,
        .tolerance = 3e-3,
    };
}

bool gb_strength_options_check(const struct gb_strength_options *options,
                               struct gb_error *err)
{
    if (options->replicas < 1 || options->replicas > GB_STRENGTH_REPLICAS_MAX) {
        return gb_error_set(err, GB_ERR_INPUT, "--replicas %d: must be between 1 and %d",
                            options->replicas, GB_STRENGTH_REPLICAS_MAX);
    }
    return (options->marks.count > 0 && options->marks.every == 0) ||
           gb_error_set(
               err, GB_ERR_INPUT,
               "--at: accepted pressures and densities, as in '50 MPa; 100 MPa'");
}

/* Members that a worker needs. */
static const struct gb_cells_number numbers[] = {
    {"step", offsetof(struct gb_strength_options, step)},
    {"strain_most", offsetof(struct gb_strength_options, strain_most)},
    {"fall", offsetof(struct gb_strength_options, fall)},
    {"tolerance", offsetof(struct gb_strength_options, tolerance)},
};

void gb_strength_options_write(const struct gb_strength_options *options,
                               const struct gb_keep_point *mark, GString *text)
{
    gb_cells_write(text, mark, options, numbers, G_N_ELEMENTS(numbers));
}

void gb_strength_options_read(struct gb_strength_options *options,
                              struct gb_keep_point *mark, GKeyFile *question)
{
    gb_strength_options_init(options);
    gb_cells_read(question, mark, options, numbers, G_N_ELEMENTS(numbers));
}
