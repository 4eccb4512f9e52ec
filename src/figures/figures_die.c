/* Figures of dies: poured beds, pressing, the full cycle, and profiles of the compact. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/number.h"
#include "figures/figures.h"
#include "figures/series.h"
#include "figures/states.h"
#include "io/state.h"
#include "many/die_summary.h"
#include "measure/average.h"
#include "measure/ball.h"
#include "pack/die/die.h"

/* Measures of a state in a die over height and radius. */

/* Errors: GB_ERR_INPUT unless the state is of a die. */
static bool check_die(const struct gb_state *state, const char *figure,
                      struct gb_error *err)
{
    return state->die_radius > 0.0 ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%s: a periodic cell has no wall; expected dies", figure);
}

/* Density over rings of the bore and bands of the height of the powder, or of what the
 * punch leaves; values as of gb_ball_density_map. */
static struct gb_density_map find_density_map(const struct gb_state *state, int rings,
                                              int bands, double *density)
{
    const struct gb_density_map map = {.rings = rings,
                                       .bands = bands,
                                       .radius = state->die_radius,
                                       .low = 0.0,
                                       .high = state->cell[2]};
    const double centre[2] = {0.5 * state->cell[0], 0.5 * state->cell[1]};
    gb_ball_density_map(&map, state->count, state->position, state->radius, centre,
                        density);
    return map;
}

/* Mean radial pressure on the wall in bands of the powder's height, MPa; NaN where the
 * open end of the bore lies below.  False when the state has no contacts with walls. */
static bool wall_profile(const struct gb_state *state, int bands, double *pressure)
{
    const double height = state->cell[2];
    const double area = 2.0 * M_PI * state->die_radius * height / bands;
    for (int b = 0; b < bands; b++) {
        const bool above = state->die_top < height * (b + 1) / bands;
        pressure[b] = above ? (double)NAN : 0.0;
    }
    for (int64_t k = 0; k < state->wall_count; k++) {
        const double *x = state->position + 3 * (int64_t)state->wall[2 * k];
        const double *force = state->wall_force + 3 * k;
        const double r[2] = {x[0] - 0.5 * state->cell[0], x[1] - 0.5 * state->cell[1]};
        const double axis = hypot(r[0], r[1]);
        if (state->wall[2 * k + 1] != GB_DIE_SIDE || !(axis > 0.0)) {
            continue;
        }
        const int b = (int)(x[2] / height * bands);
        pressure[b < bands ? b : bands - 1] -= 1e-6 * state->pascal_per_stress *
                                               (force[0] * r[0] + force[1] * r[1]) /
                                               (axis * area);
    }
    return state->wall_count > 0;
}

/* Mean of P3's measurements, section 2. */
static const double published_density = 0.65;

/* A density of every poured bed. */
struct beds {
    const char *name;          /* of the columns, in curve.csv too */
    const char *label, *title; /* in the figure, at the head of a sentence */
    int style;
    double *value;
};

/* The value at rest before pressing: the last point of the branch relax. */
static bool read_bed(double *value, const struct gb_runset_run *run, const char *column,
                     struct gb_error *err)
{
    double *x = NULL;
    double *y = NULL;
    size_t count = 0;
    if (!gb_runset_points(run, "relax", "step", column, &x, &y, &count, err)) {
        return false;
    }
    *value = y[count - 1];
    gb_alloc_free(x);
    gb_alloc_free(y);
    return true;
}

/* Filling does not depend on the law of pressing: equal seed and density are one bed. */
static bool is_repeated(const struct gb_runset *set, const double *density, size_t i)
{
    for (size_t k = 0; k < i; k++) {
        if (set->run[k].params.seed == set->run[i].params.seed &&
            density[k] == density[i]) {
            return true;
        }
    }
    return false;
}

/* Returns the number of different beds, 0 and err on failure. */
static size_t read_beds(struct beds *whole, struct beds *central,
                        const struct gb_runset *set, struct gb_error *err)
{
    double *density = g_new0(double, 2 * set->count);
    size_t beds = 0;
    bool good = true;
    for (size_t i = 0; i < set->count && good; i++) {
        good = read_bed(&density[i], &set->run[i], whole->name, err) &&
               read_bed(&density[set->count + i], &set->run[i], central->name, err);
        if (good && !is_repeated(set, density, i)) {
            whole->value[beds] = density[i];
            central->value[beds++] = density[set->count + i];
        }
    }
    g_free(density);
    return good ? beds : 0;
}

/* Table 1 of one density, in the first row of its columns, as a comment and in the caption;
 * a line at the mean with the standard deviation as its band. */
static void draw_statistics(struct gb_series *series, const struct beds *beds,
                            size_t count, const double *x)
{
    const double mean = gsl_stats_mean(beds->value, 1, count);
    const double deviation =
        count > 1 ? gsl_stats_sd_m(beds->value, 1, count, mean) : (double)NAN;
    const struct {
        const char *name;
        double value;
    } table[] = {{"mean", mean},
                 {"standard_deviation", deviation},
                 {"standard_error", deviation / sqrt((double)count)},
                 {"least", gsl_stats_min(beds->value, 1, count)},
                 {"largest", gsl_stats_max(beds->value, 1, count)}};
    GString *note = g_string_new(NULL);
    for (size_t k = 0; k < G_N_ELEMENTS(table); k++) {
        gb_series_column(series, "%s_%s", beds->name, table[k].name)[0] = table[k].value;
        if (isfinite(table[k].value)) {
            g_string_append_printf(note, ", %s %.5g", table[k].name, table[k].value);
        }
    }
    gb_series_note(series, "%s: %zu bed%s%s", beds->name, count, count > 1 ? "s" : "",
                   note->str);
    g_string_free(note, TRUE);
    double *line = gb_series_column(series, "%s_line", beds->name);
    double *band = gb_series_column(series, "%s_band", beds->name);
    for (size_t i = 0; i < series->rows; i++) {
        line[i] = mean;
        band[i] = deviation;
    }
    gb_series_draw(series, x, line, band, GB_FIGURE_LINE, beds->style, NULL);
    char number[GB_NUMBER_ERROR_MAX];
    gb_series_caption(
        series, "%s: %s.", beds->title,
        gb_number_error(mean, count > 1 ? deviation : (double)NAN, 2, " ± ", number));
}

static void draw_beds(struct gb_series *series, const struct beds *beds, size_t count)
{
    double *bed = gb_series_column(series, "bed");
    double *edge = gb_series_column(series, "line_bed");
    double *published = gb_series_column(series, "P3_measured");
    for (size_t i = 0; i < series->rows; i++) {
        bed[i] = i < count ? (double)(i + 1) : (double)NAN;
        edge[i] = 0.5 + (double)i * (double)count / (double)(series->rows - 1);
        published[i] = published_density;
    }
    gb_series_caption(
        series,
        "Mean (line) and standard deviation (band) of poured powder before pressing.");
    for (int k = 0; k < 2; k++) {
        double *value = gb_series_column(series, "%s", beds[k].name);
        for (size_t i = 0; i < count; i++) {
            value[i] = beds[k].value[i];
        }
        gb_series_draw(series, bed, value, NULL, GB_FIGURE_POINTS, beds[k].style,
                       beds[k].label);
        draw_statistics(series, &beds[k], count, edge);
    }
    gb_series_draw(series, edge, published, NULL, GB_FIGURE_LINE, gb_figure_black(1),
                   "P3, measured mean");
    series->x.low = 0.5;
    series->x.high = 0.5 + (double)count;
}

/* P3 Fig. 4 and table 1. */
static bool compute_poured_density(struct gb_series *series,
                                   const struct gb_figures_input *input,
                                   struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    double *values = g_new0(double, 2 * set->count);
    struct beds beds[2] = {
        {"density", "whole specimen", "Whole", 0, values},
        {"central_density", "central region", "Central", 1, values + set->count}};
    const size_t count = gb_series_check_die(set, "poured-density", err)
                             ? read_beds(&beds[0], &beds[1], set, err)
                             : 0;
    if (count > 0) {
        gb_series_init(series, GSL_MAX(count, 2));
        gb_series_note(series, "relative densities of poured powder at rest, before "
                               "pressing; equal beds of several runs count once");
        draw_beds(series, beds, count);
    }
    g_free(values);
    return count > 0;
}

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
    gb_series_draw(series, x, z, NULL, GB_FIGURE_FAINT, gb_figure_black(0), NULL);
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
                      "specimen %.4f, sphere of %.3g µm %.4f.",
                      whole, 2e6 * radius * state->metre_per_length, central);
}

static bool draw_section(struct gb_series *series, const struct gb_state *state,
                         double radius, struct gb_error *err)
{
    const double um = 1e6 * state->metre_per_length;
    if (!check_die(state, "die-section", err)) {
        return false;
    }
    const double height = height_of(state);
    if (!(2.0 * radius <= height) || radius > state->die_radius) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "die-section: a specimen %.4g um high in a die %.4g um wide has no room "
            "for a sphere %.4g um in diameter",
            um * height, 2.0 * um * state->die_radius, 2.0 * um * radius);
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
static bool compute_die_section(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    struct gb_states_set states;
    if (input->set->count > 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "die-section: one section shows one bed; expected one run");
    }
    if (!gb_states_set_read(&states, input, err)) {
        return false;
    }
    const struct gb_state *state = states.state[0];
    const double radius =
        0.5 * input->set->run[0].params.central_m / state->metre_per_length;
    const bool good = draw_section(series, state, radius, err);
    gb_states_set_finish(&states);
    return good;
}

/* A column of curve.csv over the set pressure. */
struct column {
    const char *name;
    const char *suffix; /* of the labels */
    int style, stride;  /* style of the first group, and between groups */
};

/* Mean of every group. */
static bool draw_column(struct gb_series *series, const struct gb_runset *set,
                        const struct gb_series_sample *sample, const double *grid,
                        const struct column *column, struct gb_error *err)
{
    bool good = true;
    for (size_t g = 0; g < set->groups && good; g++) {
        double *mean = gb_series_column(series, "%s_%zu", column->name, g + 1);
        double *error = gb_series_column(series, "%s_se_%zu", column->name, g + 1);
        char *label = gb_series_group_label(set, g, NULL);
        char *text = g_strconcat(label, column->suffix, NULL);
        good = gb_series_mean(sample, set, g, mean, error, err);
        gb_series_draw(series, grid, mean, error, GB_FIGURE_LINE,
                       (int)g * column->stride + column->style, text);
        g_free(text);
        g_free(label);
    }
    return good;
}

/* P3 Fig. 17. */
static bool compute_die_height(struct gb_series *series,
                               const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_series_sample sample;
    const struct gb_runset *set = input->set;
    if (!gb_series_check_die(set, "die-height", err) ||
        !gb_series_sample(&sample, set, "load", "wanted_MPa", "height_change", err)) {
        return false;
    }
    gb_series_init(series, sample.size);
    gb_series_note_groups(series, set);
    const double *grid = gb_series_sample_grid(series, &sample, "p_MPa");
    const struct column strain = {"height_change", "", 0, 1};
    const bool good = draw_column(series, set, &sample, grid, &strain, err);
    gb_series_sample_finish(&sample);
    return good;
}

/* P3 Fig. 18 to 20. */
static bool compute_die_density(struct gb_series *series,
                                const struct gb_figures_input *input,
                                struct gb_error *err)
{
    static const struct column columns[2] = {
        {"density", ", whole compact", 0, 2},
        {"central_density", ", central region", 1, 2}};
    struct gb_series_sample whole;
    struct gb_series_sample central = {0};
    const struct gb_runset *set = input->set;
    if (!gb_series_check_die(set, "die-density", err) ||
        !gb_series_sample(&whole, set, "load", "wanted_MPa", "density", err)) {
        return false;
    }
    bool good =
        gb_series_sample(&central, set, "load", "wanted_MPa", "central_density", err);
    if (good) {
        gb_series_init(series, whole.size);
        gb_series_note_groups(series, set);
        const double *grid = gb_series_sample_grid(series, &whole, "p_MPa");
        good = draw_column(series, set, &whole, grid, &columns[0], err) &&
               draw_column(series, set, &central, grid, &columns[1], err);
    }
    gb_series_sample_finish(&central);
    gb_series_sample_finish(&whole);
    return good;
}

enum { TRAVEL_POINTS = 101 };

static bool check_cycle(const struct gb_runset *set, const char *figure,
                        struct gb_error *err)
{
    return gb_series_check_die(set, figure, err) && gb_die_summary_check(set, err);
}

/* Rows of a run that the curve joins: all from loading to the rest in the die. */
static bool is_in_die(const char *branch)
{
    return strcmp(branch, "load") == 0 || strcmp(branch, "unload") == 0 ||
           strcmp(branch, "in-die") == 0;
}

static size_t longest(const struct gb_runset *set)
{
    size_t rows = 1;
    for (size_t i = 0; i < set->count; i++) {
        rows = MAX(rows, gb_table_rows(set->run[i].table));
    }
    return rows;
}

/* The first run of a group as a line with its label, the others thin; a marker at the
 * density of the ejected compact. */
static void draw_run(struct gb_series *series, const struct gb_runset *set, size_t run)
{
    const struct gb_table *table = set->run[run].table;
    const size_t group = set->run[run].group;
    const double *density = gb_table_column(table, "density", NULL);
    const double *pressure = gb_table_column(table, "p_MPa", NULL);
    const bool first = gb_runset_first(set, group) == &set->run[run];
    double *x = gb_series_column(series, "density_%zu", run + 1);
    double *y = gb_series_column(series, "p_MPa_%zu", run + 1);
    double *ejected = gb_series_column(series, "density_ejected_%zu", run + 1);
    double *none = gb_series_column(series, "p_MPa_ejected_%zu", run + 1);
    size_t count = 0;
    for (size_t k = 0; k < gb_table_rows(table); k++) {
        const char *branch = gb_table_word(table, k);
        if (is_in_die(branch)) {
            x[count] = density[k];
            y[count++] = pressure[k];
        } else if (strcmp(branch, "ejected") == 0) {
            ejected[0] = density[k];
            none[0] = 0.0;
        }
    }
    char *label = first ? gb_series_group_label(set, group, NULL) : NULL;
    gb_series_draw(series, x, y, NULL, first ? GB_FIGURE_LINE : GB_FIGURE_FAINT,
                   (int)group, label);
    gb_series_draw(series, ejected, none, NULL, GB_FIGURE_POINTS, (int)group, NULL);
    g_free(label);
}

static bool compute_die_cycle(struct gb_series *series,
                              const struct gb_figures_input *input, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    if (!check_cycle(set, "die-cycle", err)) {
        return false;
    }
    gb_series_init(series, longest(set));
    gb_series_list_groups(series, set);
    for (size_t i = 0; i < set->count; i++) {
        draw_run(series, set, i);
    }
    gb_series_caption(series,
                      "Loading, unloading and rest in the die of every bed; markers: "
                      "ejected compacts.");
    return true;
}

/* Travel of a run since ejection began, um, and the force at each point of it. */
static bool read_ejection(const struct gb_runset_run *run, double **travel,
                          double **force, size_t *count, struct gb_error *err)
{
    double *rest = NULL, *level = NULL;
    size_t rests = 0;
    if (!gb_runset_points(run, "eject", "time_ns", "wall_friction_mN", travel, force,
                          count, err)) {
        return false;
    }
    const bool good = gb_runset_points(run, "in-die", "time_ns", "wall_friction_mN",
                                       &rest, &level, &rests, err);
    for (size_t k = 0; good && k < *count; k++) {
        (*travel)[k] = 1e-3 * run->params.eject_m_s * ((*travel)[k] - rest[rests - 1]);
    }
    gb_alloc_free(rest);
    gb_alloc_free(level);
    return good;
}

/* Force of every run on a grid of travels that all of them reach. */
static bool sample_ejection(const struct gb_runset *set, double *grid, double *rows,
                            struct gb_error *err)
{
    double least = HUGE_VAL;
    bool good = true;
    for (int pass = 0; pass < 2 && good; pass++) {
        for (int k = 0; k < TRAVEL_POINTS; k++) {
            grid[k] = least * k / (TRAVEL_POINTS - 1);
        }
        for (size_t i = 0; i < set->count && good; i++) {
            double *x = NULL, *y = NULL;
            size_t count = 0;
            good = read_ejection(&set->run[i], &x, &y, &count, err);
            if (good && pass == 0) {
                least = fmin(least, x[count - 1]);
            } else if (good) {
                const struct gb_average_curve curve = {x, y, count};
                good = gb_average_resample(&curve, grid, TRAVEL_POINTS,
                                           rows + i * TRAVEL_POINTS, err);
            }
            gb_alloc_free(x);
            gb_alloc_free(y);
        }
    }
    return good;
}

static bool compute_die_cycle_ejection(struct gb_series *series,
                                       const struct gb_figures_input *input,
                                       struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    if (!check_cycle(set, "die-ejection", err)) {
        return false;
    }
    double *rows = g_new(double, set->count *TRAVEL_POINTS);
    gb_series_init(series, TRAVEL_POINTS);
    double *grid = gb_series_column(series, "travel_um");
    const bool good = sample_ejection(set, grid, rows, err);
    if (good) {
        gb_series_note_groups(series, set);
        gb_states_set_means(series, set, rows, grid, "force_mN");
    }
    g_free(rows);
    return good;
}

/* A profile along one coordinate of a die, as a share of its extent. */
struct profile {
    const char *figure, *coordinate, *quantity;
    int bins;
    bool (*fill)(const struct gb_state *state, int bins, double *value);
    const char *missing; /* what a state lacks when fill fails */
};

static bool fill_axial(const struct gb_state *state, int bins, double *value)
{
    find_density_map(state, 1, bins, value);
    return true;
}

static bool fill_radial(const struct gb_state *state, int bins, double *value)
{
    find_density_map(state, bins, 1, value);
    return true;
}

static bool fill_rows(double *rows, const struct gb_states_set *states,
                      const struct profile *profile, struct gb_error *err)
{
    for (size_t i = 0; i < states->count; i++) {
        if (!check_die(states->state[i], profile->figure, err)) {
            return false;
        }
        if (!profile->fill(states->state[i], profile->bins,
                           rows + i * (size_t)profile->bins)) {
            return gb_error_set(err, GB_ERR_INPUT, "%s: %s", profile->figure,
                                profile->missing);
        }
    }
    return true;
}

static bool draw_profile(struct gb_series *series, const struct gb_figures_input *input,
                         const struct profile *profile, struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_states_set states;
    if (!gb_states_set_read(&states, input, err)) {
        return false;
    }
    gb_series_init(series, (size_t)profile->bins);
    double *rows = g_new(double, set->count * series->rows);
    double *x = gb_series_column(series, "%s", profile->coordinate);
    for (int k = 0; k < profile->bins; k++) {
        x[k] = (k + 0.5) / profile->bins;
    }
    const bool good = fill_rows(rows, &states, profile, err);
    if (good) {
        gb_series_note_groups(series, set);
        gb_states_set_means(series, set, rows, x, profile->quantity);
        gb_states_set_caption(series, &states);
        series->x.low = 0.0;
        series->x.high = 1.0;
    }
    g_free(rows);
    gb_states_set_finish(&states);
    return good;
}

static bool compute_die_profile_wall(struct gb_series *series,
                                     const struct gb_figures_input *input,
                                     struct gb_error *err)
{
    static const struct profile profile = {
        "die-wall",
        "z",
        "wall_MPa",
        12,
        wall_profile,
        "the state has no contacts with walls; expected states in the die, of version "
        "0.2.0 on"};
    return draw_profile(series, input, &profile, err);
}

static bool compute_die_profile_axial(struct gb_series *series,
                                      const struct gb_figures_input *input,
                                      struct gb_error *err)
{
    static const struct profile profile = {"die-axial", "z",        "density",
                                           16,          fill_axial, ""};
    return draw_profile(series, input, &profile, err);
}

static bool compute_die_profile_radial(struct gb_series *series,
                                       const struct gb_figures_input *input,
                                       struct gb_error *err)
{
    static const struct profile profile = {"die-radial", "r",         "density",
                                           16,           fill_radial, ""};
    return draw_profile(series, input, &profile, err);
}

/* Share of the cells beyond either end of the colours. */
static const double extreme_share = 0.02;

enum { RINGS = 10, BANDS = 16, CELLS = RINGS * BANDS };

/* Mean over the states, on the extent of the first. */
static bool mean_map(const struct gb_states_set *states, double *mean,
                     struct gb_error *err)
{
    double density[CELLS];
    memset(mean, 0, CELLS * sizeof *mean);
    for (size_t i = 0; i < states->count; i++) {
        if (!check_die(states->state[i], "die-map", err)) {
            return false;
        }
        find_density_map(states->state[i], RINGS, BANDS, density);
        for (int k = 0; k < CELLS; k++) {
            mean[k] += density[k] / (double)states->count;
        }
    }
    return true;
}

/* One row per cell: its middle and its density. */
static void set_columns(struct gb_series *series, const double *x, const double *y,
                        const double *density)
{
    double *r = gb_series_column(series, "r_um");
    double *z = gb_series_column(series, "z_um");
    double *value = gb_series_column(series, "density");
    for (int k = 0; k < CELLS; k++) {
        const int i = k / BANDS, j = k % BANDS;
        r[k] = 0.5 * (x[i] + x[i + 1]);
        z[k] = 0.5 * (y[j] + y[j + 1]);
        value[k] = density[k];
    }
}

/* Range of the colours: all cells but the extreme ones, which are small rings about the
 * axis. */
static void set_colours(struct gb_figure_map *map, const double *density)
{
    double sorted[CELLS];
    memcpy(sorted, density, sizeof sorted);
    gsl_sort(sorted, 1, CELLS);
    map->low = gsl_stats_quantile_from_sorted_data(sorted, 1, CELLS, extreme_share);
    map->high =
        gsl_stats_quantile_from_sorted_data(sorted, 1, CELLS, 1.0 - extreme_share);
}

static void set_map(struct gb_series *series, const struct gb_state *state,
                    const double *density)
{
    double x[RINGS + 1], y[BANDS + 1];
    const double um = 1e6 * state->metre_per_length;
    struct gb_figure_map map = {.columns = RINGS,
                                .rows = BANDS,
                                .x = x,
                                .y = y,
                                .value = density,
                                .label = "relative density <i>ρ</i>"};
    for (int i = 0; i <= RINGS; i++) {
        x[i] = um * state->die_radius * i / RINGS;
    }
    for (int j = 0; j <= BANDS; j++) {
        y[j] = um * state->cell[2] * j / BANDS;
    }
    set_colours(&map, density);
    map.high = map.high > map.low ? map.high : map.low + 1.0;
    set_columns(series, x, y, density);
    gb_series_map(series, &map);
    series->x.low = series->y.low = 0.0;
    series->x.high = x[RINGS];
    series->y.high = y[BANDS];
}

/* One map of the mean over all beds, which are of one group. */
static bool compute_die_map(struct gb_series *series,
                            const struct gb_figures_input *input, struct gb_error *err)
{
    struct gb_states_set states;
    double mean[CELLS];
    if (input->set->groups > 1) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "die-map: one map shows one scene; expected runs that differ "
                            "by their seed only");
    }
    if (!gb_states_set_read(&states, input, err)) {
        return false;
    }
    const bool good = mean_map(&states, mean, err);
    if (good) {
        gb_series_init(series, CELLS);
        gb_series_list_groups(series, input->set);
        set_map(series, states.state[0], mean);
        gb_states_set_caption(series, &states);
        gb_series_caption(series, "%zu bed%s; %d rings, %d bands.", states.count,
                          states.count > 1 ? "s, mean" : "", RINGS, BANDS);
    }
    gb_states_set_finish(&states);
    return good;
}

#define HEIGHT_AXIS                                                                      \
    {                                                                                    \
        .name = "z", .label = "relative height <i>z</i> / <i>H</i>"                      \
    }

const struct gb_figures_row gb_figures_die_rows[] = {
    {"poured-density", "density of poured powder over beds, with its statistics",
     "P3 Fig. 4, Table 1", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = {.name = "bed", .label = "bed"}, .y = GB_FIGURES_DENSITY_AXIS,
     .compute = compute_poured_density},
    {"die-section", "section of a bed with the sphere of the central density",
     "P3 Fig. 15", GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "x_um", .label = "distance from the axis <i>x</i> (µm)"},
     .y = {.name = "z_um", .label = "height <i>z</i> (µm)"},
     .compute = compute_die_section},
    {"die-height", "axial strain against pressure in a die", "P3 Fig. 17",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = GB_FIGURES_PRESSURE_AXIS,
     .y = {.name = "height_change",
           .label = "axial strain Δ<i>H</i> / <i>H</i><sub>0</sub>"},
     .compute = compute_die_height},
    {"die-density", "density of a compact in a die and of its central region",
     "P3 Fig. 18-20", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = GB_FIGURES_PRESSURE_AXIS, .y = GB_FIGURES_DENSITY_AXIS,
     .compute = compute_die_density},
    {"die-cycle", "punch pressure against density: loading, unloading, ejected", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = GB_FIGURES_DENSITY_AXIS,
     .y = GB_FIGURES_PRESSURE_AXIS, .compute = compute_die_cycle},
    {"die-ejection", "force of ejection against the travel of the compact", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = {.name = "travel_um",
           .label = "travel of the compact through the die <i>s</i> (µm)"},
     .y = {.name = "force_mN", .label = "force of ejection <i>F</i> (mN)"},
     .compute = compute_die_cycle_ejection},
    {"die-wall", "radial pressure on the wall of a die over the height", "",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT, .x = HEIGHT_AXIS,
     .y = {.name = "wall_MPa", .label = "wall pressure <i>p<sub>r</sub></i> (MPa)"},
     .compute = compute_die_profile_wall},
    {"die-axial", "density of a compact in a die over the height", "", GB_FIGURES_STATES,
     GB_FIGURES_IN_REPORT, GB_FIGURES_AT, .x = HEIGHT_AXIS, .y = GB_FIGURES_DENSITY_AXIS,
     .compute = compute_die_profile_axial},
    {"die-radial", "density of a compact in a die against the distance from the axis", "",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "r", .label = "distance from the axis <i>r</i> / <i>R</i>"},
     .y = GB_FIGURES_DENSITY_AXIS, .compute = compute_die_profile_radial},
    {"die-map", "density of a compact in a die over radius and height", "",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "r_um", .label = "distance from the axis <i>r</i> (µm)"},
     .y = {.name = "z_um", .label = "height <i>z</i> (µm)"}, .compute = compute_die_map},
    {0},
};
