#include "figures/figures_compute.h"

#include <math.h>

#include "figures/packings/die_profile.h"
#include "figures/packings/state_set.h"
#include "measure/ball.h"

/* Points of a circle, and a gap behind it. */
enum { CIRCLE_POINTS = 96, CIRCLE = CIRCLE_POINTS + 2 };

/* Points along the outline of the specimen. */
enum { OUTLINE = 5 };

static void add_circle(double *x, double *z, const double centre[2], double radius)
{
    for (int k = 0; k <= CIRCLE_POINTS; k++) {
        const double angle = 2.0 * M_PI * k / CIRCLE_POINTS;
        x[k] = centre[0] + radius * cos(angle);
        z[k] = centre[1] + radius * sin(angle);
    }
}

/* Radius of the circle in which the plane through the axis cuts a particle; 0: not. */
static double cut_radius(const struct gb_state *state, int64_t i)
{
    const double y = state->position[3 * i + 1] - 0.5 * state->cell[1];
    const double square = state->radius[i] * state->radius[i] - y * y;
    return square > 0.0 ? sqrt(square) : 0.0;
}

static size_t count_cut(const struct gb_state *state)
{
    size_t count = 0;
    for (int64_t i = 0; i < state->count; i++) {
        count += cut_radius(state, i) > 0.0;
    }
    return count;
}

static void draw_particles(struct gb_series *series, const struct gb_state *state,
                           double um)
{
    double *x = gb_series_column(series, "particle_x_um");
    double *z = gb_series_column(series, "particle_z_um");
    size_t at = 0;
    for (int64_t i = 0; i < state->count; i++) {
        const double radius = cut_radius(state, i);
        const double *position = state->position + 3 * i;
        if (radius > 0.0) {
            add_circle(
                x + at, z + at,
                (double[2]){um * (position[0] - 0.5 * state->cell[0]), um * position[2]},
                um * radius);
            at += CIRCLE;
        }
    }
    gb_series_draw(series, x, z, NULL, GB_FIGURE_FAINT,
                   gb_figure_black(0), NULL);
}

/* Wall, floor and the height of the powder. */
static void draw_bore(struct gb_series *series, double radius, double height)
{
    double *x = gb_series_column(series, "bore_x_um");
    double *z = gb_series_column(series, "bore_z_um");
    const double outline[OUTLINE][2] = {{-radius, height},
                                        {-radius, 0.0},
                                        {radius, 0.0},
                                        {radius, height},
                                        {-radius, height}};
    for (int k = 0; k < OUTLINE; k++) {
        x[k] = outline[k][0];
        z[k] = outline[k][1];
    }
    gb_series_draw(series, x, z, NULL, GB_FIGURE_LINE, 0, "specimen");
}

static void draw_sphere(struct gb_series *series, double radius, double height)
{
    double *x = gb_series_column(series, "sphere_x_um");
    double *z = gb_series_column(series, "sphere_z_um");
    add_circle(x, z, (double[2]){0.0, 0.5 * height}, radius);
    gb_series_draw(series, x, z, NULL, GB_FIGURE_LINE, 1, "measuring sphere");
}

/* Height of the recorded density: that of the punch, which particles enter by their overlap,
 * d. */
static double height_of(const struct gb_state *state)
{
    const double top = state->cell[2];
    const double density = state->point.density;
    return density > 0.0 ? top *
                               gb_ball_density_whole(state->count, state->radius,
                                                     state->die_radius, top) /
                               density
                         : top;
}

/* Densities of the specimen and of the sphere, as columns and in the caption. */
static void measure(struct gb_series *series, const struct gb_state *state, double radius,
                    double height)
{
    const double centre[3] = {0.5 * state->cell[0], 0.5 * state->cell[1], 0.5 * height};
    const double whole =
        gb_ball_density_whole(state->count, state->radius, state->die_radius, height);
    const double central = gb_ball_density_central(state->count, state->position,
                                                   state->radius, centre, radius);
    gb_series_column(series, "density")[0] = whole;
    gb_series_column(series, "central_density")[0] = central;
    gb_series_caption(series,
                      "Particles cut by a plane through the axis. Relative density: "
                      "specimen %.4f, sphere of %.3g \xc2\xb5m %.4f.",
                      whole, 2e6 * radius * state->metre_per_length, central);
}

static bool draw(struct gb_series *series, const struct gb_state *state, double radius,
                 struct gb_error *err)
{
    const double um = 1e6 * state->metre_per_length;
    if (!gb_die_profile_check(state, "die-section", err)) {
        return false;
    }
    const double height = height_of(state);
    if (!(2.0 * radius <= height) || radius > state->die_radius) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "die-section: a specimen of %.4g um has no room for a sphere of "
            "%.4g um",
            um * height, 2.0 * um * radius);
    }
    gb_series_init(series, count_cut(state) * CIRCLE + CIRCLE);
    draw_particles(series, state, um);
    draw_bore(series, um * state->die_radius, um * height);
    draw_sphere(series, um * radius, um * height);
    measure(series, state, radius, height);
    series->equal_scales = true;
    return true;
}

/* P3 Fig. 15. */
bool gb_figures_die_section(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_state_set states;
    if (input->set->count > 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "die-section: one section shows one bed; accepted one run");
    }
    if (!gb_state_set_read(&states, input, err)) {
        return false;
    }
    const struct gb_state *state = states.state[0];
    const double radius =
        0.5 * input->set->run[0].params.central_m / state->metre_per_length;
    const bool good = draw(series, state, radius, err);
    gb_state_set_finish(&states);
    return good;
}
