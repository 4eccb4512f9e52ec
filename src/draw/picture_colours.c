/* Quantities that colour a picture: first the scale from values to colours, then one function
 * for each quantity, then their table. */
#include "draw/picture_colours.h"

#include <glib.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/mat.h"
#include "base/number.h"
#include "draw/picture_style.h"
#include "io/state_forces.h"
#include "pack/cell/cell.h"

enum start { FROM_DATA, FROM_ZERO };

/* Quantiles in place of outliers, and the ratio of spans from which on they are used. */
static const double low_quantile = 0.02, high_quantile = 0.98;
static const double outlier_ratio = 1.5;
/* Values that differ by less than this fraction are one value. */
static const double one_value = 1e-9;
/* Ticks that a linear scale has about. */
static const double ticks = 6.0;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool is_one_value(const struct gb_picture_style_scale *scale)
{
    return !(scale->high - scale->low >
             one_value * fmax(fabs(scale->low), fabs(scale->high)));
}

/* Quantiles, or the ends of the sorted values. */
static void take_ends(struct gb_picture_style_scale *scale, const double *sorted,
                      size_t count)
{
    const double last = (double)(count - 1);
    const double low = sorted[0];
    const double high = sorted[count - 1];
    scale->low = sorted[(size_t)(low_quantile * last)];
    scale->high = sorted[(size_t)ceil(high_quantile * last)];
    const bool wide =
        scale->log ? log(high / low) > outlier_ratio * log(scale->high / scale->low)
                   : high - low > outlier_ratio * (scale->high - scale->low);
    if (!wide || is_one_value(scale)) { /* outliers may be the only other values */
        scale->low = low;
        scale->high = high;
    }
}

/* Outwards to ticks; a wider scale may have wider steps. */
static void round_ends(struct gb_picture_style_scale *scale)
{
    const double low = scale->low;
    const double high = scale->high;
    if (scale->log) {
        scale->low = gb_number_round_below(low);
        scale->high = gb_number_round_above(high);
        return;
    }
    for (int k = 0; k < 2; k++) {
        const double step = gb_number_nearest_step((scale->high - scale->low) / ticks);
        scale->low = step * floor(low / step + 1e-9);
        scale->high = step * ceil(high / step - 1e-9);
    }
}

static void fit_data(struct gb_picture_style_scale *scale, const double *sorted,
                     size_t count, enum start start)
{
    take_ends(scale, sorted, count);
    if (start == FROM_ZERO && !scale->log) {
        scale->low = 0.0;
    }
    if (is_one_value(scale)) {
        scale->low = scale->high;
        return;
    }
    if (scale->map != NULL && scale->map->diverging && scale->low < 0.0 &&
        scale->high > 0.0) {
        scale->high = fmax(-scale->low, scale->high);
        scale->low = -scale->high;
    }
    round_ends(scale);
}

static bool is_ranged(const struct gb_picture_style_request *request)
{
    return request->high > request->low || request->ranged;
}

static void take_range(struct gb_picture_style_scale *scale,
                       const struct gb_picture_style_request *request, double per_si)
{
    const bool common = request->high > request->low;
    scale->low = common ? request->low : per_si * request->range_si[0];
    scale->high = common ? request->high : per_si * request->range_si[1];
}

static bool fit_sorted(struct gb_picture_style_scale *scale, const double *sorted,
                       size_t count, size_t first, enum start start, double per_si,
                       const struct gb_picture_style_request *request,
                       struct gb_error *err)
{
    if (is_ranged(request)) {
        take_range(scale, request, per_si);
    } else if (first < count) {
        fit_data(scale, sorted + first, count - first, start);
    } else {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "--log: no value is above 0; a logarithmic scale needs at least one");
    }
    if (scale->log && !(scale->low > 0.0)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--range: expected from above 0 with --log");
    }
    const double rounding = one_value * (scale->high - scale->low);
    scale->below = rounding > 0.0 && scale->low - sorted[0] > rounding;
    scale->above = rounding > 0.0 && sorted[count - 1] - scale->high > rounding;
    return true;
}

/* Ends, in the unit of the values: those of the request (per_si: of its SI numbers), else of the data,
 * rounded outwards to ticks.  Of the data: minimum and maximum, or the quantiles 2 % and 98 %
 * where the outliers beyond them would extend the scale by more than half; equal for one
 * value.  A diverging scale of values of both signs is centred at 0.  A logarithmic scale
 * takes the values above 0.
 * Errors: GB_ERR_INPUT for a logarithmic scale without such values or from 0 down,
 * GB_ERR_MEMORY. */
static bool fit_scale(struct gb_picture_style_scale *scale, const double *value,
                      size_t count, enum start start, double per_si,
                      const struct gb_picture_style_request *request,
                      struct gb_error *err)
{
    double *sorted = gb_alloc_array(count, sizeof *sorted, err);
    if (sorted == NULL) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        sorted[i] = value[i];
    }
    qsort(sorted, count, sizeof *sorted, compare);
    size_t first = 0; /* of the values that the scale can have */
    while (request->log && first < count && !(sorted[first] > 0.0)) {
        first++;
    }
    scale->map = request->map;
    scale->log = request->log;
    const bool good =
        fit_sorted(scale, sorted, count, first, start, per_si, request, err);
    gb_alloc_free(sorted);
    return good;
}

/* Whole numbers from 0 to the last one with a colour of its own, or of the request. */
static bool fit_whole(struct gb_picture_style_scale *scale, const int32_t *number,
                      size_t count, const struct gb_picture_style_request *request,
                      struct gb_error *err)
{
    scale->whole = true;
    scale->map = request->map;
    scale->high = GB_IMAGE_MAP_CONTACTS;
    if (request->log) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--log: whole numbers; expected with --color pressure, size "
                            "or displacement");
    }
    if (is_ranged(request)) {
        take_range(scale, request, 1.0);
        scale->low = round(scale->low);
        scale->high = round(scale->high);
    }
    for (size_t i = 0; i < count; i++) {
        scale->below = scale->below || number[i] < scale->low;
        scale->above = scale->above || number[i] > scale->high;
    }
    return true;
}

void gb_picture_colours_at(const struct gb_picture_style_scale *scale, double value,
                           uint8_t rgb[3])
{
    double share = 0.5;
    if (scale->high > scale->low) {
        share = !scale->log   ? (value - scale->low) / (scale->high - scale->low)
                : value > 0.0 ? log(value / scale->low) / log(scale->high / scale->low)
                              : 0.0;
    }
    gb_image_map_colour(scale->map, share, rgb);
}

/* Diameters below this are shown in nm, others in um; m. */
static const double nanometre_below = 0.5e-6;

/* Pascal in the unit of stresses. */
static const double mpa_per_pa = 1e-6;

static bool colour_values(struct gb_picture_style *style, const double *value,
                          enum start start, double per_si,
                          const struct gb_picture_style_request *request,
                          struct gb_error *err)
{
    if (!fit_scale(&style->scale, value, style->count, start, per_si, request, err)) {
        return false;
    }
    for (size_t i = 0; i < style->count; i++) {
        gb_picture_colours_at(&style->scale, value[i], &style->colour[3 * i]);
    }
    return true;
}

static bool colour_counts(struct gb_picture_style *style, const int32_t *number,
                          const char *title,
                          const struct gb_picture_style_request *request,
                          struct gb_error *err)
{
    style->scale.title = title;
    if (!fit_whole(&style->scale, number, style->count, request, err)) {
        return false;
    }
    for (size_t i = 0; i < style->count; i++) {
        gb_picture_colours_at(&style->scale, number[i], &style->colour[3 * i]);
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
    if (value == NULL || !gb_state_forces_gaps_init(&gaps, state, err)) {
        gb_alloc_free(value);
        return false;
    }
    gb_state_forces_stress_mean(state, &gaps, value);
    gb_state_forces_gaps_finish(&gaps);
    for (size_t i = 0; i < style->count; i++) {
        value[i] *= mpa_per_pa;
    }
    style->scale.title = "mean particle stress (MPa)";
    const bool good = colour_values(style, value, FROM_DATA, mpa_per_pa, request, err);
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
    style->scale.title = uses_nanometres(state) ? "diameter (nm)" : "diameter (μm)";
    const bool good =
        colour_values(style, value, FROM_DATA, units_per_metre(state), request, err);
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
                        "--since: a state of %lld particles of seed %llu; expected an "
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
        uses_nanometres(state) ? "displacement (nm)" : "displacement (μm)";
    const bool good =
        colour_values(style, value, FROM_ZERO, units_per_metre(state), request, err);
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
