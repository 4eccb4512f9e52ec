#include <math.h>
#include <string.h>

#include <glib.h>
#include <gsl/gsl_errno.h>

#include "study/card.h"
#include "study/compact.h"

enum { LEVELS = 3, CELLS = 4 };

static const double bulk = 8e9, shear_modulus = 6e9;

/* A probe that is elastic up to p1 and flows plastically after it: volume and shear strain
 * of the flow in the proportion 1 : 2, stress constant. */
static void test_probe(void)
{
    struct gb_compact_probe probe = {
        .direction = 0.5,
        .elastic = {{{1.0 / bulk, 0.0}, {0.0, 1.0 / (3.0 * shear_modulus)}}},
        .state = g_array_new(FALSE, FALSE, sizeof(struct gb_compact_state))};
    struct gb_yield_point point;
    for (int i = 0; i <= 20; i++) {
        const double elastic = fmin(i, 10), plastic = fmax(i - 10, 0);
        const struct gb_compact_state state = {
            .p = 50e6 + 2e6 * elastic,
            .q = 1e6 * elastic,
            .volume = 2e6 * elastic / bulk + 1e-3 * plastic,
            .shear = 1e6 * elastic / (3.0 * shear_modulus) + 2e-3 * plastic};
        g_array_append_val(probe.state, state);
    }
    g_assert_true(gb_compact_probe_point(&probe, 1e-2, 1.0, &point));
    g_assert_cmpfloat_with_epsilon(point.p_pa, 70e6, 1.0);
    g_assert_cmpfloat_with_epsilon(point.q_pa, 10e6, 1.0);
    g_assert_cmpfloat_with_epsilon(point.flow_shear, 5e-3, 1e-9);
    g_assert_cmpfloat_with_epsilon(point.flow_volume, 2.5e-3, 1e-9);
    g_assert_false(gb_compact_probe_point(&probe, 3e-2, 1.0, &point));
    gb_compact_probe_finish(&probe);
}

static struct gb_cap cap_of(int level)
{
    struct gb_cap cap = {
        .d = 20e6 * (level + 1), .beta = 0.8, .r = 0.8 + 0.1 * level, .a = 0.03};
    return gb_cap_with_end(&cap, 80e6 * pow(2.0, level));
}

static struct gb_card_options options_of(void)
{
    struct gb_card_options options;
    gb_card_options_init(&options);
    options.levels = LEVELS;
    options.path = GB_CARD_ISOTROPIC;
    options.replicas = CELLS;
    for (int k = 0; k < LEVELS; k++) {
        options.density[k] = 0.40 + 0.05 * k;
    }
    return options;
}

/* Where the ray of a direction from inside meets the surface. */
static void meet(const struct gb_cap *cap, double from, double direction,
                 struct gb_yield_point *point)
{
    double inside = 0.0, outside = 4.0 * gb_cap_end(cap);
    for (int i = 0; i < 200; i++) {
        const double middle = 0.5 * (inside + outside);
        const double p = from + middle * cos(direction);
        const double q = middle * fabs(sin(direction));
        *(q < gb_cap_height(cap, p) ? &inside : &outside) = middle;
    }
    point->p_pa = from + inside * cos(direction);
    point->q_pa = inside * sin(direction);
    gb_cap_flow(cap, point->p_pa, point->q_pa, &point->flow_volume, &point->flow_shear);
}

/* Cells whose points lie on known surfaces, scattered by `scatter` in size. */
static void make_cells(struct gb_card_cell cell[CELLS],
                       const struct gb_card_options *options, double scatter)
{
    for (int c = 0; c < CELLS; c++) {
        memset(&cell[c], 0, sizeof cell[c]);
        cell[c].point = g_array_new(FALSE, FALSE, sizeof(struct gb_yield_point));
        for (int k = 0; k < GB_CARD_PATHS; k++) {
            cell[c].curve[k] = g_array_new(FALSE, FALSE, sizeof(struct gb_card_pressed));
        }
        const double size = 1.0 + scatter * (c - 0.5 * (CELLS - 1));
        for (int k = 0; k < LEVELS; k++) {
            const struct gb_cap cap = cap_of(k);
            cell[c].level[k] = (struct gb_card_level){.density = options->density[k],
                                                      .p_pa = size * gb_cap_end(&cap),
                                                      .bulk = bulk,
                                                      .shear_modulus = shear_modulus};
            for (int d = 0; d < options->directions; d++) {
                struct gb_yield_point point = {.density = options->density[k],
                                               .direction = gb_card_direction(options, d),
                                               .replica = c + 1};
                meet(&cap, 0.5 * gb_cap_end(&cap), point.direction, &point);
                point.p_pa *= size;
                point.q_pa *= size;
                g_array_append_val(cell[c].point, point);
            }
        }
    }
}

static void test_values(void)
{
    const struct gb_card_options options = options_of();
    struct gb_card_cell cell[CELLS];
    struct gb_yield_point *point = g_new0(struct gb_yield_point, GB_CARD_POINTS_MAX);
    struct gb_card_values card;
    struct gb_error err = {0};
    make_cells(cell, &options, 0.02);
    const size_t size = gb_card_fit_points(cell, CELLS, -1, &options, point);
    g_assert_cmpuint(size, ==, (size_t)(LEVELS * options.directions));
    if (!gb_card_fit_values(&card, cell, CELLS, -1, &options, point, size, &err)) {
        g_error("%s", err.text);
    }
    for (int k = 0; k < LEVELS; k++) {
        /* points on the short transition count as failure or cap: within a D */
        const struct gb_cap cap = cap_of(k);
        const double *value = card.value[k];
        g_assert_cmpfloat_with_epsilon(value[GB_CARD_D], cap.d, 0.05 * cap.d);
        g_assert_cmpfloat_with_epsilon(value[GB_CARD_BETA], cap.beta, 0.05);
        g_assert_cmpfloat_with_epsilon(value[GB_CARD_R], cap.r, 0.05 * cap.r);
        g_assert_cmpfloat_with_epsilon(value[GB_CARD_P_B], gb_cap_end(&cap),
                                       0.01 * gb_cap_end(&cap));
        g_assert_cmpfloat_with_epsilon(
            value[GB_CARD_YOUNG],
            9.0 * bulk * shear_modulus / (3.0 * bulk + shear_modulus), 1e3);
        g_assert_cmpfloat_with_epsilon(value[GB_CARD_PLASTIC],
                                       log(options.density[k] / options.density[0]) -
                                           (gb_cap_end(&cap) - 80e6) / bulk,
                                       1e-12);
    }
    for (int c = 0; c < CELLS; c++) {
        gb_card_cell_finish(&cell[c]);
    }
    g_free(point);
}

/* Loaded isotropically the card gives back its hardening table: p_b at the density of each
 * row, less the offset by which the probes have flowed. */
static void test_material(void)
{
    const struct gb_card_options options = options_of();
    struct gb_card_values card = {.start_density = 0.0};
    struct gb_cap_row rows[GB_CARD_LEVELS_MAX];
    struct gb_error err = {0};
    for (int k = 0; k < LEVELS; k++) {
        const struct gb_cap cap = cap_of(k);
        const double value[GB_CARD_QUANTITIES] = {
            [GB_CARD_D] = cap.d,
            [GB_CARD_BETA] = cap.beta,
            [GB_CARD_R] = cap.r,
            [GB_CARD_P_A] = cap.p_a,
            [GB_CARD_P_B] = gb_cap_end(&cap),
            [GB_CARD_PLASTIC] = log(options.density[k] / options.density[0]) -
                                (gb_cap_end(&cap) - 80e6) / bulk,
            [GB_CARD_YOUNG] = 9.0 * bulk * shear_modulus / (3.0 * bulk + shear_modulus),
            [GB_CARD_POISSON] = (3.0 * bulk - 2.0 * shear_modulus) /
                                (2.0 * (3.0 * bulk + shear_modulus))};
        card.density[k] = options.density[k];
        memcpy(card.value[k], value, sizeof value);
    }
    const struct gb_cap_material material =
        gb_card_fit_material(&card, LEVELS, options.transition, rows);
    g_assert_true(gb_cap_check(&material, &err));
    struct gb_cap_state state = {.density = 0.40 * exp(-80e6 / bulk)};
    for (int k = 0; k < LEVELS; k++) {
        const double each = log(options.density[k] / state.density) / 3.0;
        const double strain[6] = {each, each, each, 0.0, 0.0, 0.0};
        const struct gb_cap cap = cap_of(k);
        g_assert_true(gb_cap_strain(&material, &state, strain, &err));
        g_assert_cmpfloat_with_epsilon(gb_cap_mean(state.pressure), gb_cap_end(&cap),
                                       2e-3 * gb_cap_end(&cap));
    }
}

/* The fragment has a row per density in each block, in MPa and degrees. */
static void test_abaqus(void)
{
    struct gb_card_study *study = g_new0(struct gb_card_study, 1);
    study->levels = 2;
    study->options.transition = 0.03;
    study->card.start_density = 0.5;
    for (int k = 0; k < 2; k++) {
        study->card.density[k] = 0.5 + 0.1 * k;
        study->card.value[k][GB_CARD_D] = 20e6;
        study->card.value[k][GB_CARD_BETA] = M_PI / 4.0;
        study->card.value[k][GB_CARD_R] = 0.7;
        study->card.value[k][GB_CARD_P_B] = 1e8 * (k + 1);
        study->card.value[k][GB_CARD_PLASTIC] = 0.1 * k;
        study->card.value[k][GB_CARD_YOUNG] = 12e9;
        study->card.value[k][GB_CARD_POISSON] = 0.2;
    }
    GString *text = gb_card_files_abaqus(study, "greenbody card", 4000.0);
    static const char *const wanted[] = {
        "*DENSITY\n2e-09\n", "12000, 0.2, , 0.5\n12000, 0.2, , 0.6\n",
        "20, 45, 0.7, 0., 0.03, 1., , 0.5\n20, 45, 0.7, 0., 0.03, 1., , 0.6\n",
        "*CAP HARDENING\n** p_b, plastic volumetric strain\n100, 0\n200, 0.1\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(wanted); i++) {
        g_assert_nonnull(strstr(text->str, wanted[i]));
    }
    g_string_free(text, TRUE);
    g_free(study);
}

/* One point of the cap moved by 20 %, errors of 0.5 %: the lines name its density and side,
 * and no other. */
static void test_misses(void)
{
    struct gb_card_study *study = g_new0(struct gb_card_study, 1);
    struct gb_card_cell cell[CELLS];
    struct gb_error err = {0};
    study->options = options_of();
    study->options.flow = 0.0;
    study->levels = LEVELS;
    make_cells(cell, &study->options, 0.02);
    for (int moved = 0; moved < 2; moved++) {
        study->points =
            gb_card_fit_points(cell, CELLS, -1, &study->options, study->point);
        for (size_t i = 0; i < study->points && moved; i++) {
            struct gb_yield_point *point = &study->point[i];
            const bool is_other = point->density != study->options.density[1];
            point->p_pa *= is_other || point->direction != 0.0 ? 1.0 : 1.2;
            point->p_error_pa = 0.005 * fabs(point->p_pa);
            point->q_error_pa = 0.005 * fabs(point->q_pa);
        }
        g_assert_true(gb_card_fit_values(&study->card, cell, CELLS, -1, &study->options,
                                         study->point, study->points, &err));
        GString *text = gb_card_files_misses(study);
        g_test_message("%s", text->str);
        g_assert_true((strstr(text->str, "density 0.450, cap: ") != NULL) == moved);
        g_assert_null(strstr(text->str, "density 0.400"));
        g_assert_null(strstr(text->str, "density 0.500"));
        GString *abaqus = gb_card_files_abaqus(study, "greenbody card", 4000.0);
        g_assert_true(strstr(abaqus->str, "** density 0.450, cap: ") != NULL || !moved);
        g_string_free(abaqus, TRUE);
        g_string_free(text, TRUE);
    }
    for (int c = 0; c < CELLS; c++) {
        gb_card_cell_finish(&cell[c]);
    }
    g_free(study);
}

/* Numbers that are not there are empty in the tables. */
static void test_absent(void)
{
    struct gb_card_study *study = g_new0(struct gb_card_study, 1);
    study->options = options_of();
    study->levels = 2;
    for (int k = 0; k < 2; k++) {
        for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
            study->quantity[k][n] = (struct gb_fit_value){NAN, NAN, -NAN, INFINITY};
        }
    }
    GString *text = gb_card_files_card(study, "greenbody card");
    g_assert_null(strstr(text->str, "nan"));
    g_assert_null(strstr(text->str, "inf"));
    g_string_free(text, TRUE);
    g_free(study);
}

static void test_options(void)
{
    struct gb_card_options options = options_of();
    struct gb_error err = {0};
    g_assert_true(gb_card_options_check(&options, &err));
    options.density[1] = options.density[0];
    g_assert_false(gb_card_options_check(&options, &err));
    g_assert_nonnull(strstr(err.text, "--densities"));
    options = options_of();
    options.replicas = 2;
    g_assert_false(gb_card_options_check(&options, &err));
    g_assert_nonnull(strstr(err.text, "--replicas 2"));
}

/* A predicted curve 10 % above a simulated one, and 0.02 in p_x/p_z.  Points at which a cell
 * has ended, or before the first density, count for nothing. */
static void test_misfit(void)
{
    struct gb_card_compared curve[GB_CARD_CURVE_POINTS];
    struct gb_card_misfit misfit;
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        curve[i] = (struct gb_card_compared){.density = 0.3 + 0.005 * i,
                                             .simulated_ratio.value = 0.4,
                                             .predicted_ratio.value = 0.42,
                                             .simulated_pz.value = 1e6 * (i + 1),
                                             .predicted_pz.value = 1.1e6 * (i + 1)};
    }
    curve[0].predicted_ratio.value = 0.2;
    curve[GB_CARD_CURVE_POINTS - 1].simulated_ratio.value = NAN;
    curve[GB_CARD_CURVE_POINTS - 2].predicted_pz.value = NAN;
    gb_card_misfit_measure(&misfit, curve, 0.302);
    g_assert_cmpfloat_with_epsilon(misfit.ratio, 0.02, 1e-12);
    g_assert_cmpfloat_with_epsilon(misfit.ratio_most, 0.02, 1e-12);
    g_assert_cmpfloat_with_epsilon(misfit.pressure, 0.1, 1e-12);
    g_assert_cmpfloat(misfit.density, >, 0.005);
    g_assert_cmpfloat(misfit.density_most, <, 0.03);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    gsl_set_error_handler_off();
    g_test_add_func("/card/probe", test_probe);
    g_test_add_func("/card/values", test_values);
    g_test_add_func("/card/material", test_material);
    g_test_add_func("/card/abaqus", test_abaqus);
    g_test_add_func("/card/misses", test_misses);
    g_test_add_func("/card/absent", test_absent);
    g_test_add_func("/card/options", test_options);
    g_test_add_func("/card/misfit", test_misfit);
    return g_test_run();
}
