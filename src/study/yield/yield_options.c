#include "study/yield/yield_options.h"

#include <math.h>

#include "study/compact/cells.h"

const double gb_yield_options_offset[GB_YIELD_OFFSETS] = {0.5, 1.0, 2.0};

void gb_yield_options_init(struct gb_yield_options *options)
{
    *options = (struct gb_yield_options){
        .marks = {.count = 2, .point = {{true, 0.5}, {true, 0.55}}},
        .replicas = 8,
        .directions = 12,
        .inside = 0.5,
        .offset = 1e-3,
        .step = 5e-5,
        .strain_most = 0.03,
        .tolerance = 1e-3,
    };
}

static bool refuse(struct gb_error *err, const char *name, double value,
                   const char *accepted)
{
    return gb_error_set(err, GB_ERR_INPUT, "--%s %g: must be %s", name, value, accepted);
}

static bool check_marks(const struct gb_keep_points *marks, struct gb_error *err)
{
    if (marks->count == 0 || marks->every > 0) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--at: accepted densities and pressures, as in 'density = "
                            "0.5; 100 MPa'");
    }
    for (int i = 0; i < marks->count; i++) {
        if (marks->point[i].by_density && !(marks->point[i].value < 0.95)) {
            return refuse(err, "density", marks->point[i].value, "below 0.95");
        }
    }
    return true;
}

bool gb_yield_options_check(const struct gb_yield_options *options, struct gb_error *err)
{
    if (options->replicas < 1 || options->replicas > GB_YIELD_REPLICAS_MAX) {
        return refuse(err, "replicas", options->replicas, "between 1 and 1000");
    }
    if (options->directions < 8 || options->directions > GB_YIELD_DIRECTIONS_MAX ||
        options->directions % 4 != 0) {
        return refuse(err, "directions", options->directions,
                      "between 8 and 72, a multiple of 4");
    }
    if (!(options->inside > 0.0 && options->inside < 1.0)) {
        return refuse(err, "inside", options->inside, "between 0 and 1");
    }
    if (!(options->offset >= 1e-4 && options->offset <= 0.02)) {
        return refuse(err, "offset", 100.0 * options->offset, "between 0.01 and 2 %");
    }
    return check_marks(&options->marks, err);
}

double gb_yield_options_direction(const struct gb_yield_options *options, int index)
{
    return 2.0 * G_PI * index / options->directions;
}

/* Members that a worker needs. */
static const struct gb_cells_number numbers[] = {
    {"inside", offsetof(struct gb_yield_options, inside)},
    {"offset", offsetof(struct gb_yield_options, offset)},
    {"step", offsetof(struct gb_yield_options, step)},
    {"strain_most", offsetof(struct gb_yield_options, strain_most)},
    {"tolerance", offsetof(struct gb_yield_options, tolerance)},
};

void gb_yield_options_write(const struct gb_yield_options *options,
                            const struct gb_keep_point *mark, GString *text)
{
    g_string_append_printf(text, "directions=%d\n", options->directions);
    gb_cells_write(text, mark, options, numbers, G_N_ELEMENTS(numbers));
}

void gb_yield_options_read(struct gb_yield_options *options, struct gb_keep_point *mark,
                           GKeyFile *question)
{
    gb_yield_options_init(options);
    options->directions = (int)gb_cells_option(question, "directions");
    gb_cells_read(question, mark, options, numbers, G_N_ELEMENTS(numbers));
}
