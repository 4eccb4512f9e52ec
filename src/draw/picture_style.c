#include "draw/picture_style.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "draw/force_rods.h"
#include "draw/image/palette.h"
#include "pack/cell/cell.h"

/* Values beyond these shares of all would take the colours from the rest. */
static const double low_share = 0.02;
static const double high_share = 0.98;
/* Of the radius, so that forces are seen between particles. */
static const float shrunk = 0.38F;
/* Particles that are there for the forces only. */
static const float dot = 0.1F;

void gb_picture_style_init(struct gb_picture_style_request *request)
{
    *request = (struct gb_picture_style_request){
        .force = GB_PICTURE_STYLE_SIGN, .slice_axis = -1, .cut_axis = -1};
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Volume of the cell or the die over that of the particles (areas in 2D), d. */
static double room_per_solid(const struct gb_state *state)
{
    double room = state->cell[0] * state->cell[2];
    double solid = 0.0;
    if (state->dimension == 3) {
        room *= state->cell[1];
    }
    if (state->die_radius > 0.0) {
        room = M_PI * state->die_radius * state->die_radius * state->cell[2];
    }
    for (int64_t i = 0; i < state->count; i++) {
        solid += pow(state->radius[i], state->dimension);
    }
    return room / solid;
}

void gb_picture_style_pressure(const struct gb_state *state, double *pressure)
{
    const double room = room_per_solid(state);
    struct gb_cell cell;
    gb_cell_init(&cell, state->dimension, state->cell);
    memset(pressure, 0, (size_t)state->count * sizeof *pressure);
    for (int64_t k = 0; k < state->pair_count; k++) {
        const int32_t *ends = &state->pair[2 * k];
        const double *a = &state->position[3 * ends[0]];
        const double *b = &state->position[3 * ends[1]];
        double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        gb_cell_nearest(&cell, r);
        const double half = 0.5 * gb_vec_dot(&state->pair_force[3 * k], r) *
                            state->pascal_per_stress / state->dimension;
        for (int end = 0; end < 2; end++) {
            const double solid = pow(state->radius[ends[end]], state->dimension);
            pressure[ends[end]] += half / (room * solid);
        }
    }
}

/* Colours along the scale between two quantiles of the values. */
static bool colour_values(struct gb_picture_style *dress, const double *value,
                          const struct gb_picture_style_request *request,
                          struct gb_error *err)
{
    double *sorted = gb_alloc_array(dress->count, sizeof *sorted, err);
    struct gb_picture_style_scale *scale = &dress->scale;
    if (sorted == NULL) {
        return false;
    }
    memcpy(sorted, value, dress->count * sizeof *sorted);
    qsort(sorted, dress->count, sizeof *sorted, compare);
    const double last = (double)(dress->count - 1);
    const bool from_zero = request->colour == GB_PICTURE_STYLE_DISPLACEMENT;
    scale->low = from_zero ? 0.0 : sorted[(size_t)(low_share * last)];
    scale->high = sorted[(size_t)ceil(high_share * last)];
    if (request->high > request->low) {
        scale->low = request->low;
        scale->high = request->high;
    }
    if (!(scale->high > scale->low)) {
        scale->high = scale->low + fmax(fabs(scale->low) * 1e-3, 1e-12);
    }
    scale->below = sorted[0] < scale->low;
    scale->above = sorted[dress->count - 1] > scale->high;
    gb_alloc_free(sorted);
    for (size_t i = 0; i < dress->count; i++) {
        gb_palette_field((value[i] - scale->low) / (scale->high - scale->low),
                         &dress->colour[3 * i]);
    }
    return true;
}

static void colour_counts(struct gb_picture_style *dress, const int32_t *number)
{
    dress->scale.whole = true;
    dress->scale.high = GB_PALETTE_CONTACTS;
    for (size_t i = 0; i < dress->count; i++) {
        gb_palette_contacts(number[i], &dress->colour[3 * i]);
        dress->scale.above = dress->scale.above || number[i] > GB_PALETTE_CONTACTS;
    }
}

static bool colour_bridges(struct gb_picture_style *dress, const struct gb_state *state,
                           struct gb_error *err)
{
    int32_t *number = gb_alloc_array(dress->count, sizeof *number, err);
    if (number == NULL) {
        return false;
    }
    for (int64_t k = 0; k < state->pair_count; k++) {
        if (state->pair_bridged[k] != 0) {
            number[state->pair[2 * k]]++;
            number[state->pair[2 * k + 1]]++;
        }
    }
    dress->scale.title = "bridges per particle";
    colour_counts(dress, number);
    gb_alloc_free(number);
    return true;
}

static bool same_particles(const struct gb_state *state, const struct gb_state *since,
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

/* Length of the path since a state, beside the strain of the cell, m. */
static double displacement(const struct gb_cell *cell, const struct gb_state *state,
                           const struct gb_state *since, size_t i)
{
    double u[3];
    for (size_t k = 0; k < 3; k++) {
        u[k] = state->position[3 * i + k] -
               since->position[3 * i + k] * state->cell[k] / since->cell[k];
    }
    gb_cell_nearest(cell, u);
    return gb_vec_length(u) * state->metre_per_length;
}

static double value_of(const struct gb_cell *cell, const struct gb_state *state,
                       const struct gb_picture_style_request *request, size_t i)
{
    return request->colour == GB_PICTURE_STYLE_SIZE
               ? 2.0 * state->radius[i] * state->metre_per_length
               : displacement(cell, state, request->since, i);
}

static bool colour_field(struct gb_picture_style *dress, const struct gb_state *state,
                         const struct gb_picture_style_request *request,
                         struct gb_error *err)
{
    static const char *const titles[2][2] = {
        {"diameter (nm)", "diameter (\xce\xbcm)"},
        {"displacement (nm)", "displacement (\xce\xbcm)"}};
    const bool pressure = request->colour == GB_PICTURE_STYLE_PRESSURE;
    const bool moved = request->colour == GB_PICTURE_STYLE_DISPLACEMENT;
    const bool nano = state->metre_per_length < 0.5e-6;
    struct gb_cell cell;
    double *value = gb_alloc_array(dress->count, sizeof *value, err);
    if (value == NULL) {
        return false;
    }
    gb_cell_init(&cell, state->dimension, state->cell);
    if (pressure) {
        gb_picture_style_pressure(state, value);
    }
    for (size_t i = 0; i < dress->count; i++) {
        value[i] = pressure ? 1e-6 * value[i]
                            : (nano ? 1e9 : 1e6) * value_of(&cell, state, request, i);
    }
    dress->scale.title =
        pressure ? "pressure of the contacts (MPa)" : titles[moved][nano ? 0 : 1];
    const bool good = colour_values(dress, value, request, err);
    gb_alloc_free(value);
    return good;
}

static bool colour(struct gb_picture_style *dress, const struct gb_state *state,
                   const struct gb_picture_style_request *request, struct gb_error *err)
{
    switch (request->colour) {
    case GB_PICTURE_STYLE_PRESSURE:
    case GB_PICTURE_STYLE_SIZE:
        return colour_field(dress, state, request, err);
    case GB_PICTURE_STYLE_DISPLACEMENT:
        return same_particles(state, request->since, err) &&
               colour_field(dress, state, request, err);
    case GB_PICTURE_STYLE_BRIDGES:
        return colour_bridges(dress, state, err);
    case GB_PICTURE_STYLE_COORDINATION:
    case GB_PICTURE_STYLE_SIGN:
    case GB_PICTURE_STYLE_BRIDGED:
        break;
    }
    dress->scale.title = "coordination number";
    colour_counts(dress, state->contacts);
    return true;
}

/* Whether a particle is left out by slice or cut. */
static bool is_hidden(const struct gb_state *state,
                      const struct gb_picture_style_request *request,
                      const double *position)
{
    double share[3];
    for (int k = 0; k < 3; k++) {
        share[k] = position[k] / state->cell[k];
    }
    if (request->slice_axis >= 0) {
        const int k = request->slice_axis;
        const double away = fabs(share[k] - request->slice_at) * state->cell[k];
        return away > 0.5 * request->slice_width;
    }
    if (request->cut_axis >= 0 && share[request->cut_axis] > request->cut_at) {
        return true;
    }
    return request->cut_corner && share[0] > 0.5 && share[1] < 0.5 && share[2] > 0.5;
}

/* Forces alone: particles are grey dots that say where they are. */
static void make_dots(struct gb_picture_style *dress)
{
    static const uint8_t grey[3] = {150, 152, 156};
    dress->shrink = dot;
    dress->scale.title = NULL;
    for (size_t i = 0; i < dress->count; i++) {
        memcpy(&dress->colour[3 * i], grey, 3);
    }
}

bool gb_picture_style_create(struct gb_picture_style **out, const struct gb_state *state,
                             const struct gb_picture_style_request *request,
                             struct gb_error *err)
{
    *out = NULL;
    struct gb_picture_style *dress = gb_alloc_array(1, sizeof *dress, err);
    if (dress == NULL) {
        return false;
    }
    dress->count = (size_t)state->count;
    dress->shrink = request->show == GB_PICTURE_STYLE_PARTICLES ? 1.0F : shrunk;
    dress->colour = gb_alloc_array(dress->count, 3, err);
    dress->hidden = gb_alloc_array(dress->count, 1, err);
    bool good = dress->colour != NULL && dress->hidden != NULL;
    for (size_t i = 0; i < dress->count && good; i++) {
        dress->hidden[i] = is_hidden(state, request, &state->position[3 * i]);
    }
    if (request->show == GB_PICTURE_STYLE_FORCES) {
        good = good && gb_force_rods_make(dress, state, request, err);
        if (good) {
            make_dots(dress);
        }
    } else {
        good = good && colour(dress, state, request, err) &&
               (request->show == GB_PICTURE_STYLE_PARTICLES ||
                gb_force_rods_make(dress, state, request, err));
    }
    if (!good) {
        gb_picture_style_destroy(dress);
        return false;
    }
    *out = dress;
    return true;
}

void gb_picture_style_destroy(struct gb_picture_style *dress)
{
    if (dress == NULL) {
        return;
    }
    gb_alloc_free(dress->colour);
    gb_alloc_free(dress->hidden);
    gb_alloc_free(dress->rod);
    gb_alloc_free(dress->rod_colour);
    gb_alloc_free(dress);
}
