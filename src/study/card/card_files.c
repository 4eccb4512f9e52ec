#include "study/card/card_files.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include "measure/cap/cap_fit.h"
#include "study/compact/study_text.h"

static void add_comment(GString *text, const char *comment, const char *mark)
{
    char **lines = g_strsplit(comment, "\n", 0);
    for (int i = 0; lines[i] != NULL; i++) {
        if (lines[i][0] != '\0') {
            g_string_append_printf(text, "%s %s\n", mark, lines[i]);
        }
    }
    g_strfreev(lines);
}

static GString *begin(const char *comment, const char *mark)
{
    GString *text = g_string_new(NULL);
    add_comment(text, comment, mark);
    return text;
}

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

static GString *begin_with_misses(const struct gb_card_study *study, const char *comment,
                                  const char *mark)
{
    GString *text = begin(comment, mark);
    GString *misses = gb_card_files_misses(study);
    add_comment(text, misses->str, mark);
    g_string_free(misses, TRUE);
    return text;
}

/* ",value,low,high" */
static void append_value(GString *text, const struct gb_fit_value *value, double factor)
{
    const double number[] = {value->value * factor, value->low * factor,
                             value->high * factor};
    g_string_append_c(text, ',');
    gb_study_text_cells(text, number, G_N_ELEMENTS(number));
}

GString *gb_card_files_card(const struct gb_card_study *study, const char *comment)
{
    GString *text = begin_with_misses(study, comment, "#");
    g_string_append(text, "density,pressed_MPa");
    for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
        const char *name = gb_card_rows[n].name;
        g_string_append_printf(text, ",%s,%s_low,%s_high", name, name, name);
    }
    g_string_append(text, ",transition,rms_MPa\n");
    for (int k = 0; k < study->levels; k++) {
        g_string_append_printf(text, "%.6g,%.6g", study->card.density[k],
                               study->card.pressed_pa[k] / 1e6);
        for (int n = 0; n < GB_CARD_QUANTITIES; n++) {
            append_value(text, &study->quantity[k][n], gb_card_rows[n].factor);
        }
        g_string_append_printf(text, ",%g,%.4g\n", study->options.transition,
                               study->card.rms[k] / 1e6);
    }
    return text;
}

GString *gb_card_files_points(const struct gb_card_study *study, const char *comment)
{
    static const char *const sides[] = {[GB_CAP_FIT_SHEAR] = "shear",
                                        [GB_CAP_FIT_CAP] = "cap",
                                        [GB_CAP_FIT_LEFT_OUT] = "tension"};
    GString *text = begin(comment, "#");
    g_string_append(text, "density,direction_deg,p_MPa,p_MPa_error,q_MPa,q_MPa_error,"
                          "flow_volume,flow_shear,side\n");
    for (size_t i = 0; i < study->points; i++) {
        const struct gb_yield_point *point = &study->point[i];
        g_string_append_printf(
            text, "%.6g,%.4g,%.6g,%.3g,%.6g,%.3g,%.4g,%.4g,%s\n", point->density,
            point->direction * 180.0 / M_PI, point->p_pa / 1e6, point->p_error_pa / 1e6,
            point->q_pa / 1e6, point->q_error_pa / 1e6, point->flow_volume,
            point->flow_shear, sides[gb_cap_fit_side_of(point)]);
    }
    return text;
}

GString *gb_card_files_path(const struct gb_card_study *study, enum gb_card_path path,
                            const char *comment)
{
    static const char *const names[] = {"ratio", "card_ratio", "pz_MPa", "card_pz_MPa"};
    GString *text = begin(comment, "#");
    g_string_append(text, "density");
    for (size_t n = 0; n < G_N_ELEMENTS(names); n++) {
        g_string_append_printf(text, ",%s,%s_low,%s_high", names[n], names[n], names[n]);
    }
    g_string_append_c(text, '\n');
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        const struct gb_card_compared *at = &study->curve[path][i];
        if (!isfinite(at->simulated_ratio.value) ||
            !isfinite(at->predicted_ratio.value)) {
            continue;
        }
        g_string_append_printf(text, "%.6g", at->density);
        append_value(text, &at->simulated_ratio, 1.0);
        append_value(text, &at->predicted_ratio, 1.0);
        append_value(text, &at->simulated_pz, 1e-6);
        append_value(text, &at->predicted_pz, 1e-6);
        g_string_append_c(text, '\n');
    }
    return text;
}

GString *gb_card_files_abaqus(const struct gb_card_study *study, const char *comment,
                              double mass_density)
{
    GString *text = begin_with_misses(study, comment, "**");
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
