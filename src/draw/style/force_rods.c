#include "draw/style/force_rods.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "draw/style/picture_colours.h"
#include "draw/style/round_number.h"
#include "pack/cell/cell.h"
#include "pack/die/die.h"

/* Radius of the thickest and the thinnest rods, d. */
static const double max_radius = 0.17;
static const double min_radius = 0.006;

/* Quantile of the forces that, rounded up, has the thickest rod; larger forces are as thick:
 * a few large ones would make all others thin. */
static const double max_force_quantile = 0.99;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double gb_force_rods_radius(double ratio)
{
    return fmax(max_radius * fmin(ratio, 1.0), min_radius);
}

/* The walls of a state's die; a funnel that it does not have is not touched. */
static struct gb_die walls_of(const struct gb_state *state)
{
    const double size = hypot(state->funnel_slope, 1.0);
    return (struct gb_die){.radius = state->die_radius,
                           .funnel = state->funnel_height > 0.0,
                           .height = state->funnel_height,
                           .outlet = state->funnel_outlet,
                           .sine = state->funnel_slope / size,
                           .cosine = 1.0 / size,
                           .punch = isfinite(state->punch_height),
                           .punch_position = state->punch_height,
                           .bore = !isfinite(state->die_top) ? GB_DIE_BORE_ENDLESS
                                   : state->die_top > 0.0    ? GB_DIE_BORE_OPEN
                                                             : GB_DIE_BORE_GONE,
                           .top = state->die_top};
}

/* Normal force of a contact with a wall, E d^2, and the way from the wall to the particle's
 * centre; 0 where the state does not tell the place of the wall. */
static double wall_normal(const struct gb_state *state, const struct gb_die *die,
                          int64_t line, double unit[3])
{
    const int32_t particle = state->wall[2 * line];
    const double *at = state->position + 3 * (int64_t)particle;
    const double x[3] = {at[0] - 0.5 * state->cell[0], at[1] - 0.5 * state->cell[1],
                         at[2]};
    const double overlap =
        gb_die_overlap(die, (enum gb_die_wall)state->wall[2 * line + 1], x,
                       state->radius[particle], unit);
    return isfinite(overlap) ? gb_vec_dot(state->wall_force + 3 * line, unit) : 0.0;
}

/* Quantile of the forces for the thickest rods and the largest force, N. */
static bool find_largest(const struct gb_state *state, const struct gb_die *die,
                         double newton, double *quantile, double *largest,
                         struct gb_error *err)
{
    const size_t pairs = (size_t)state->pair_count;
    const size_t count = pairs + (size_t)state->wall_count;
    double *force = gb_alloc_array(count + 1, sizeof *force, err);
    if (force == NULL) {
        return false;
    }
    for (size_t k = 0; k < pairs; k++) {
        force[k] = fabs(state->pair_normal[k]);
    }
    for (size_t k = pairs; k < count; k++) {
        double unit[3];
        force[k] = fabs(wall_normal(state, die, (int64_t)(k - pairs), unit));
    }
    qsort(force, count, sizeof *force, compare);
    *quantile = *largest = 0.0;
    if (count > 0) {
        *quantile =
            newton * force[(size_t)ceil(max_force_quantile * (double)(count - 1))];
        *largest = newton * force[count - 1];
    }
    gb_alloc_free(force);
    return true;
}

static void put_rod(struct gb_picture_style *style, const double *from,
                    const double span[3], double fraction, double radius,
                    const uint8_t rgb[3])
{
    float *rod = &style->rod[7 * style->rods];
    for (int k = 0; k < 3; k++) {
        rod[k] = (float)from[k];
        rod[3 + k] = (float)(from[k] + fraction * span[k]);
    }
    rod[6] = (float)radius;
    memcpy(&style->rod_colour[3 * style->rods], rgb, 3);
    style->rods++;
}

/* Rod of a contact; two halves where it crosses a periodic wall. */
static void put_contact(struct gb_picture_style *style, const struct gb_state *state,
                        const struct gb_cell *cell, int64_t pair, double radius,
                        const uint8_t rgb[3])
{
    const int32_t *ends = &state->pair[2 * pair];
    const double *a = &state->position[3 * ends[0]];
    const double *b = &state->position[3 * ends[1]];
    const double direct[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    double span[3] = {direct[0], direct[1], direct[2]};
    gb_cell_nearest(cell, span);
    const bool inside = fabs(span[0] - direct[0]) + fabs(span[1] - direct[1]) +
                            fabs(span[2] - direct[2]) <
                        1e-9;
    if (inside) {
        put_rod(style, a, span, 1.0, radius, rgb);
        return;
    }
    const double back[3] = {-span[0], -span[1], -span[2]};
    put_rod(style, a, span, 0.5, radius, rgb);
    put_rod(style, b, back, 0.5, radius, rgb);
}

/* Rods from centres to walls. */
static void put_walls(struct gb_picture_style *style, const struct gb_state *state,
                      const struct gb_die *die,
                      const struct gb_picture_colours_row *colours, double newton)
{
    for (int64_t k = 0; k < state->wall_count; k++) {
        const int32_t particle = state->wall[2 * k];
        double unit[3];
        const double normal = wall_normal(state, die, k, unit);
        if (style->hidden[particle] != 0 || normal == 0.0) {
            continue;
        }
        const double ratio = fabs(normal) * newton / style->max_force_n;
        gb_vec_scale(unit, -state->radius[particle]);
        put_rod(style, state->position + 3 * (int64_t)particle, unit, 1.0,
                gb_force_rods_radius(ratio),
                style->legend[colours->wall_class(normal)].rgb);
    }
}

bool gb_force_rods_make(struct gb_picture_style *style, const struct gb_state *state,
                        const struct gb_picture_style_request *request,
                        struct gb_error *err)
{
    const struct gb_picture_colours_row *colours = request->forces;
    const size_t max_rods = 2 * (size_t)state->pair_count + (size_t)state->wall_count + 1;
    const struct gb_die die = walls_of(state);
    const double newton =
        state->pascal_per_stress * state->metre_per_length * state->metre_per_length;
    const struct gb_cell cell = gb_state_cell(state);
    double quantile = 0.0;
    double largest = 0.0;
    style->rod = gb_alloc_array(max_rods, 7 * sizeof *style->rod, err);
    style->rod_colour = gb_alloc_array(max_rods, 3, err);
    if (style->rod == NULL || style->rod_colour == NULL ||
        !find_largest(state, &die, newton, &quantile, &largest, err)) {
        return false;
    }
    memcpy(style->legend, colours->legend, sizeof style->legend);
    style->legend_count = 2;
    style->max_force_n = request->max_force_n > 0.0 ? request->max_force_n
                         : quantile > 0.0           ? gb_round_number_above(quantile)
                                                    : newton;
    style->forces_above = largest > style->max_force_n;
    for (int64_t k = 0; k < state->pair_count; k++) {
        const int32_t *ends = &state->pair[2 * k];
        if (style->hidden[ends[0]] != 0 || style->hidden[ends[1]] != 0) {
            continue;
        }
        const double ratio = fabs(state->pair_normal[k]) * newton / style->max_force_n;
        put_contact(style, state, &cell, k, gb_force_rods_radius(ratio),
                    style->legend[colours->force_class(state, k)].rgb);
    }
    put_walls(style, state, &die, colours, newton);
    return true;
}
