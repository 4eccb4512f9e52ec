#include "study/card/card_files.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include "base/listing.h"
#include "measure/cap_fit.h"

GString *gb_card_files_misses(const struct gb_card_study *study)
{
    static const char *const sides[] = {"shear failure", "cap"};
    const double quantile = gsl_cdf_tdist_Pinv(0.975, study->options.replicas - 1.0);
    GString *text = g_string_new(NULL);
    for (int k = 0; k < study->levels; k++) {
        for (int side = 0; side < 2; side++) {
            const struct gb_cap_fit_misses *misses = &study->card.misses[k][side];
            const double interval = quantile * misses->error;
            if (misses->distance > interval) {
                g_string_append_printf(
                    text,
                    "density %.3f, %s: the surface is %.3g MPa (rms) from its own points, "
                    "which are known to within %.2g MPa (95 %%)\n",
                    study->card.density[k], sides[side], misses->distance / 1e6,
                    interval / 1e6);
            }
        }
    }
    return text;
}

static void add_value(struct gb_listing *listing, const struct gb_fit_value *value,
                      double factor)
{
    gb_listing_number(listing, value->value * factor);
    gb_listing_number(listing, value->low * factor);
    gb_listing_number(listing, value->high * factor);
}

static void add_columns(struct gb_listing *listing, const char *name)
{
    gb_listing_column(listing, "%.8g", "%s", name);
    gb_listing_column(listing, "%.8g", "%s_low", name);
    gb_listing_column(listing, "%.8g", "%s_high", name);
}

GString *gb_card_files_card(const struct gb_card_study *study, const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    GString *misses = gb_card_files_misses(study);
    gb_listing_comment(listing, comment);
    gb_listing_comment(listing, misses->str);
    gb_listing_columns(listing, "%.6g", "density,pressed_MPa");
    for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
        add_columns(listing, gb_card_rows[n].name);
    }
    gb_listing_columns(listing, "%g", "transition");
    gb_listing_columns(listing, "%.4g", "rms_MPa");
    for (int k = 0; k < study->levels; k++) {
        gb_listing_number(listing, study->card.density[k]);
        gb_listing_number(listing, study->card.pressed_pa[k] / 1e6);
        for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
            add_value(listing, &study->quantity[k][n], gb_card_rows[n].factor);
        }
        gb_listing_number(listing, study->options.transition);
        gb_listing_number(listing, study->card.rms[k] / 1e6);
    }
    g_string_free(misses, TRUE);
    return gb_listing_end(listing, GB_LISTING_CSV);
}

GString *gb_card_files_points(const struct gb_card_study *study, const char *comment)
{
    static const char *const sides[] = {[GB_CAP_FIT_SHEAR] = "shear",
                                        [GB_CAP_FIT_CAP] = "cap",
                                        [GB_CAP_FIT_LEFT_OUT] = "tension"};
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%.6g", "density");
    gb_listing_columns(listing, "%.4g", "direction_deg");
    gb_listing_columns(listing, "%.6g", "p_MPa");
    gb_listing_columns(listing, "%.3g", "p_MPa_error");
    gb_listing_columns(listing, "%.6g", "q_MPa");
    gb_listing_columns(listing, "%.3g", "q_MPa_error");
    gb_listing_columns(listing, "%.4g", "flow_volume,flow_shear");
    gb_listing_columns(listing, "%s", "side");
    for (size_t i = 0; i < study->points; i++) {
        const struct gb_yield_point *point = &study->point[i];
        const double number[] = {point->density,     point->direction * 180.0 / M_PI,
                                 point->p_pa / 1e6,  point->p_error_pa / 1e6,
                                 point->q_pa / 1e6,  point->q_error_pa / 1e6,
                                 point->flow_volume, point->flow_shear};
        gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
        gb_listing_text(listing, sides[gb_cap_fit_side_of(point)]);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

GString *gb_card_files_path(const struct gb_card_study *study, enum gb_card_path path,
                            const char *comment)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    gb_listing_columns(listing, "%.6g", "density");
    add_columns(listing, "ratio");
    add_columns(listing, "card_ratio");
    add_columns(listing, "pz_MPa");
    add_columns(listing, "card_pz_MPa");
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        const struct gb_card_compared *at = &study->curve[path][i];
        if (!isfinite(at->simulated_ratio.value) ||
            !isfinite(at->predicted_ratio.value)) {
            continue;
        }
        gb_listing_number(listing, at->density);
        add_value(listing, &at->simulated_ratio, 1.0);
        add_value(listing, &at->predicted_ratio, 1.0);
        add_value(listing, &at->simulated_pz, 1e-6);
        add_value(listing, &at->predicted_pz, 1e-6);
    }
    return gb_listing_end(listing, GB_LISTING_CSV);
}

static void add_comment(GString *text, const char *comment)
{
    char **lines = g_strsplit(comment, "\n", 0);
    for (int i = 0; lines[i] != NULL; i++) {
        if (lines[i][0] != '\0') {
            g_string_append_printf(text, "** %s\n", lines[i]);
        }
    }
    g_strfreev(lines);
}

GString *gb_card_files_abaqus(const struct gb_card_study *study, const char *comment,
                              double mass_density)
{
    GString *text = g_string_new(NULL);
    GString *misses = gb_card_files_misses(study);
    add_comment(text, comment);
    add_comment(text, misses->str);
    g_string_free(misses, TRUE);
    g_string_append_printf(
        text,
        "** Units: mm, N, MPa, tonne.  Field variable 1: relative density of the "
        "powder,\n"
        "** to be updated by a user subroutine (USDFLD, VUSDFLD) as %.6g times\n"
        "** exp(-volumetric strain): that is its initial value.\n"
        "*MATERIAL, NAME=GREEN_BODY\n*DENSITY\n%.6g\n*ELASTIC, DEPENDENCIES=1\n"
        "** E, nu, temperature, relative density\n",
        study->card.start_density, study->card.start_density * mass_density * 1e-12);
    for (int k = 0; k < study->levels; k++) {
        const double *value = study->card.value[k];
        g_string_append_printf(text, "%.6g, %.5g, , %.6g\n", value[GB_CARD_YOUNG] / 1e6,
                               value[GB_CARD_POISSON], study->card.density[k]);
    }
    g_string_append(text, "*CAP PLASTICITY, DEPENDENCIES=1\n"
                          "** d, beta (degrees), R, initial plastic volumetric strain, "
                          "alpha, K, temperature,\n** relative density\n");
    for (int k = 0; k < study->levels; k++) {
        const double *value = study->card.value[k];
        g_string_append_printf(text, "%.6g, %.5g, %.5g, 0., %g, 1., , %.6g\n",
                               value[GB_CARD_D] / 1e6, value[GB_CARD_BETA] * 180.0 / M_PI,
                               value[GB_CARD_R], study->options.transition,
                               study->card.density[k]);
    }
    g_string_append(text, "*CAP HARDENING\n** p_b, plastic volumetric strain\n");
    for (int k = 0; k < study->levels; k++) {
        const double *value = study->card.value[k];
        g_string_append_printf(text, "%.6g, %.6g\n", value[GB_CARD_P_B] / 1e6,
                               value[GB_CARD_PLASTIC]);
    }
    return text;
}
