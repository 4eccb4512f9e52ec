#include "cli/output/moduli_output.h"

#include <math.h>
#include <stdio.h>

#include <glib.h>

#include "base/number.h"
#include "base/text/visible.h"

/* "123.4" or "123.4 +- 0.5". */
static void print_value(const struct gb_moduli_state *state, const char *column,
                        int digits)
{
    const int k = gb_moduli_table_find(column);
    const double error = gb_moduli_states_error(state, k);
    char text[GB_NUMBER_ERROR_MAX];
    if (!isfinite(gb_moduli_states_mean(state, k))) {
        gb_visible_print(stdout, "-");
        return;
    }
    if (error > 0.0) {
        gb_number_error(gb_moduli_states_mean(state, k), error, 2, " +- ", text);
    } else {
        g_snprintf(text, sizeof text, "%.*g", digits, gb_moduli_states_mean(state, k));
    }
    gb_visible_print(stdout, "%s", text);
}

static double plain(const struct gb_moduli_state *state, const char *column)
{
    return gb_moduli_states_mean(state, gb_moduli_table_find(column));
}

static void print_matrix(const struct gb_moduli_state *state)
{
    static const char *const axes[] = {"xx", "yy", "zz", "yz", "xz", "xy"};
    gb_visible_print(stdout, "C, GPa ");
    for (int n = 0; n < 6; n++) {
        gb_visible_print(stdout, "%11s", axes[n]);
    }
    gb_visible_put(stdout, "\n");
    for (int m = 0; m < 6; m++) {
        gb_visible_print(stdout, "    %s ", axes[m]);
        for (int n = 0; n < 6; n++) {
            gb_visible_print(stdout, "%11.5f", state->c_gpa[m][n] / state->count);
        }
        gb_visible_put(stdout, "\n");
    }
}

static void print_line(const struct gb_moduli_state *state, const char *title,
                       const char *const columns[][2], const char *unit)
{
    gb_visible_print(stdout, "%-15s", title);
    for (int k = 0; columns[k][0] != NULL; k++) {
        gb_visible_print(stdout, "%s%s ", k > 0 ? ", " : "", columns[k][1]);
        print_value(state, columns[k][0], 5);
    }
    gb_visible_print(stdout, "%s%s\n", unit[0] ? " " : "", unit);
}

static void print_derived(const struct gb_moduli_state *state)
{
    static const char *const hill[][2] = {
        {"K_GPa", "K"}, {"G_GPa", "G"}, {"E_GPa", "E"}, {NULL, NULL}};
    static const char *const voigt[][2] = {
        {"K_voigt_GPa", "K"}, {"G_voigt_GPa", "G"}, {NULL, NULL}};
    static const char *const reuss[][2] = {
        {"K_reuss_GPa", "K"}, {"G_reuss_GPa", "G"}, {NULL, NULL}};
    static const char *const nu[][2] = {{"nu", "nu"}, {NULL, NULL}};
    static const char *const axial[][2] = {
        {"axial_C11_GPa", "C11"}, {"axial_C12_GPa", "C12"}, {"axial_C13_GPa", "C13"},
        {"axial_C33_GPa", "C33"}, {"axial_C44_GPa", "C44"}, {NULL, NULL}};
    static const char *const misfit[][2] = {{"axial_misfit", "share of C"}, {NULL, NULL}};
    static const char *const waves[][2] = {{"vp_z_m_s", "P along z"},
                                           {"vp_x_m_s", "across"},
                                           {"vs_z_m_s", "S along z"},
                                           {"vs_x_m_s", "across"},
                                           {NULL, NULL}};
    print_line(state, "Hill", hill, "GPa");
    print_line(state, "", nu, "");
    print_line(state, "Voigt", voigt, "GPa");
    print_line(state, "Reuss", reuss, "GPa");
    print_line(state, "axis z", axial, "GPa");
    print_line(state, "  left out", misfit, "");
    print_line(state, "waves", waves, "m/s");
}

void gb_moduli_output_state(const struct gb_moduli_state *state)
{
    gb_visible_print(stdout, "density        ");
    print_value(state, "density", 6);
    gb_visible_print(stdout, ", p ");
    print_value(state, "p_MPa", 6);
    gb_visible_print(stdout, " MPa (x %.5g, y %.5g, z %.5g)\n", plain(state, "px_MPa"),
                     plain(state, "py_MPa"), plain(state, "pz_MPa"));
    if (state->count + state->missing > 1) {
        gb_visible_print(stdout,
                         "replicas       %d of %d, errors are standard errors of the "
                         "mean\n",
                         state->count, state->count + state->missing);
    }
    gb_visible_print(
        stdout,
        "probe          strain %.3g; half of it differs by %.1e of the largest C\n",
        plain(state, "probe_strain"), plain(state, "sizes_differ"));
    gb_visible_print(
        stdout, "state          residual %.1e, relaxed by %.2g d (rms), %.2g d at most\n",
        plain(state, "residual"), plain(state, "moved_rms_d"),
        plain(state, "moved_most_d"));
    if (isfinite(plain(state, "elastic_range"))) {
        gb_visible_print(stdout, "elastic range  %s%.3g (a secant has lost 5 %%)\n",
                         state->range_open ? "above " : "",
                         plain(state, "elastic_range"));
    }
    print_matrix(state);
    print_derived(state);
}
