#include "draw/style/picture_colours.h"

#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "draw/style/picture_scale.h"
#include "io/state/state_stress.h"
#include "pack/cell/cell.h"

/* Diameters below this are shown in nm, others in um; m. */
static const double nanometre_below = 0.5e-6;

/* Pascal in the unit of stresses. */
static const double mpa_per_pa = 1e-6;

static bool colour_values(struct gb_picture_style *style, const double *value,
                          enum gb_picture_scale_start start, double per_si,
                          const struct gb_picture_style_request *request,
                          struct gb_error *err)
{
    if (!gb_picture_scale_fit(&style->scale, value, style->count, start, per_si, request,
                              err)) {
        return false;
    }
    for (size_t i = 0; i < style->count; i++) {
        gb_picture_scale_colour(&style->scale, value[i], &style->colour[3 * i]);
    }
    return true;
}

static bool colour_counts(struct gb_picture_style *style, const int32_t *number,
                          const char *title,
                          const struct gb_picture_style_request *request,
                          struct gb_error *err)
{
    style->scale.title = title;
    if (!gb_picture_scale_fit_whole(&style->scale, number, style->count, request, err)) {
        return false;
    }
    for (size_t i = 0; i < style->count; i++) {
        gb_picture_scale_colour(&style->scale, number[i], &style->colour[3 * i]);
    }
    return true;
}

static bool colour_coordination(struct gb_picture_style *style,
                                const struct gb_state *state,
                                const struct gb_picture_style_request *request,
                                struct gb_error *err)
{
    return colour_counts(style, state->contacts, "coordination number", request, err);
}

static bool colour_bridges(struct gb_picture_style *style, const struct gb_state *state,
                           const struct gb_picture_style_request *request,
                           struct gb_error *err)
{
    int32_t *number = gb_alloc_array(style->count, sizeof *number, err);
    if (number == NULL) {
        return false;
    }
    for (int64_t k = 0; k < state->pair_count; k++) {
        if (state->pair_bridged[k] != 0) {
            number[state->pair[2 * k]]++;
            number[state->pair[2 * k + 1]]++;
        }
    }
    const bool good = colour_counts(style, number, "bridges per particle", request, err);
    gb_alloc_free(number);
    return good;
}

static bool colour_pressure(struct gb_picture_style *style, const struct gb_state *state,
                            const struct gb_picture_style_request *request,
                            struct gb_error *err)
{
    double *value = gb_alloc_array(style->count, sizeof *value, err);
    struct gb_state_gaps gaps = {0};
    if (value == NULL || !gb_state_gaps_init(&gaps, state, err)) {
        gb_alloc_free(value);
        return false;
    }
    gb_state_stress_mean(state, &gaps, value);
    gb_state_gaps_finish(&gaps);
    for (size_t i = 0; i < style->count; i++) {
        value[i] *= mpa_per_pa;
    }
    style->scale.title = "mean particle stress (MPa)";
    const bool good =
        colour_values(style, value, GB_PICTURE_SCALE_FROM_DATA, mpa_per_pa, request, err);
    gb_alloc_free(value);
    return good;
}

/* Unit of lengths of a state. */
static bool uses_nanometres(const struct gb_state *state)
{
    return state->metre_per_length < nanometre_below;
}

static double units_per_metre(const struct gb_state *state)
{
    return uses_nanometres(state) ? 1e9 : 1e6;
}

static bool colour_size(struct gb_picture_style *style, const struct gb_state *state,
                        const struct gb_picture_style_request *request,
                        struct gb_error *err)
{
    double *value = gb_alloc_array(style->count, sizeof *value, err);
    if (value == NULL) {
        return false;
    }
    for (size_t i = 0; i < style->count; i++) {
        value[i] =
            units_per_metre(state) * (2.0 * state->radius[i] * state->metre_per_length);
    }
    style->scale.title =
        uses_nanometres(state) ? "diameter (nm)" : "diameter (\xce\xbcm)";
    const bool good = colour_values(style, value, GB_PICTURE_SCALE_FROM_DATA,
                                    units_per_metre(state), request, err);
    gb_alloc_free(value);
    return good;
}

static bool check_same_run(const struct gb_state *state, const struct gb_state *since,
                           struct gb_error *err)
{
    if (since == NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--color displacement needs --since DIR or POINT");
    }
    return (since->count == state->count && since->dimension == state->dimension &&
            since->seed == state->seed) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "--since: a state of %lld particles of seed %llu; accepted an "
                        "earlier state of the same run",
                        (long long)since->count, (unsigned long long)since->seed);
}

/* Displacement since a state without the strain of the cell, m. */
static double displacement(const struct gb_cell *cell, const struct gb_state *state,
                           const struct gb_state *since, size_t i)
{
    const struct gb_cell before = gb_state_cell(since);
    const struct gb_deformation motion = gb_cell_motion(&before, cell);
    double u[3];
    gb_mat_apply(motion.f, since->position + 3 * i, u);
    for (size_t k = 0; k < 3; k++) {
        u[k] = state->position[3 * i + k] - u[k];
    }
    gb_cell_nearest(cell, u);
    return gb_vec_length(u) * state->metre_per_length;
}

static bool colour_displacement(struct gb_picture_style *style,
                                const struct gb_state *state,
                                const struct gb_picture_style_request *request,
                                struct gb_error *err)
{
    const struct gb_cell cell = gb_state_cell(state);
    if (!check_same_run(state, request->since, err)) {
        return false;
    }
    double *value = gb_alloc_array(style->count, sizeof *value, err);
    if (value == NULL) {
        return false;
    }
    for (size_t i = 0; i < style->count; i++) {
        value[i] = units_per_metre(state) * displacement(&cell, state, request->since, i);
    }
    style->scale.title =
        uses_nanometres(state) ? "displacement (nm)" : "displacement (\xce\xbcm)";
    const bool good = colour_values(style, value, GB_PICTURE_SCALE_FROM_ZERO,
                                    units_per_metre(state), request, err);
    gb_alloc_free(value);
    return good;
}

static int by_sign(const struct gb_state *state, int64_t pair)
{
    return state->pair_normal[pair] >= 0.0 ? 0 : 1;
}

static int by_bridge(const struct gb_state *state, int64_t pair)
{
    return state->pair_bridged[pair] != 0 ? 0 : 1;
}

static int wall_by_sign(double normal)
{
    return normal >= 0.0 ? 0 : 1;
}

/* Walls have no bridges. */
static int wall_unbridged(double normal)
{
    (void)normal;
    return 1;
}

static const struct gb_picture_colours_row table[] = {
    {"coordination", "contacts per particle", GB_PICTURE_COLOURS_PARTICLES,
     .particles = colour_coordination},
    {"pressure", "mean particle stress", GB_PICTURE_COLOURS_PARTICLES,
     .particles = colour_pressure, .dimension = GB_DIM_PRESSURE},
    {"bridges", "bridges per particle", GB_PICTURE_COLOURS_PARTICLES,
     .particles = colour_bridges},
    {"size", "particle diameter", GB_PICTURE_COLOURS_PARTICLES, .particles = colour_size,
     .dimension = GB_DIM_LENGTH},
    {"displacement", "displacement since --since without the strain of the cell",
     GB_PICTURE_COLOURS_PARTICLES, .particles = colour_displacement,
     .dimension = GB_DIM_LENGTH},
    {"sign", "compressive or tensile force", GB_PICTURE_COLOURS_FORCES,
     .legend = {{"compressive", {38, 96, 160}}, {"tensile", {222, 104, 24}}},
     .force_class = by_sign, .wall_class = wall_by_sign},
    {"bridged", "contact with or without a bridge", GB_PICTURE_COLOURS_FORCES,
     .legend = {{"bridged contact", {150, 78, 132}},
                {"unbridged contact", {86, 160, 211}}},
     .force_class = by_bridge, .wall_class = wall_unbridged},
    {0},
};

const struct gb_picture_colours_row *gb_picture_colours_table(void)
{
    return table;
}

const struct gb_picture_colours_row *gb_picture_colours_find(const char *name)
{
    for (const struct gb_picture_colours_row *row = table; row->name != NULL; row++) {
        if (strcmp(row->name, name) == 0) {
            return row;
        }
    }
    return NULL;
}

char *gb_picture_colours_names(enum gb_picture_colours_kind kind)
{
    GString *names = g_string_new(NULL);
    for (const struct gb_picture_colours_row *row = table; row->name != NULL; row++) {
        if (row->kind == kind) {
            g_string_append_printf(names, "%s%s", names->len > 0 ? ", " : "", row->name);
        }
    }
    return g_string_free(names, FALSE);
}
