#include "figures/figures.h"

#include <string.h>

#include "figures/figures_compute.h"

#define RHO   "<i>\xcf\x81</i>"
#define DELTA "\xce\x94"
#define DENSITY_AXIS                                                                     \
    {                                                                                    \
        .name = "density", .label = "relative density " RHO                              \
    }
#define PRESSURE_AXIS                                                                    \
    {                                                                                    \
        .name = "p_MPa", .label = "pressure <i>p</i> (MPa)"                              \
    }
#define MODULUS_AXIS                                                                     \
    {                                                                                    \
        .name = "modulus_GPa", .label = "elastic modulus (GPa)"                          \
    }
#define HEIGHT_AXIS                                                                      \
    {                                                                                    \
        .name = "z", .label = "relative height <i>z</i> / <i>H</i>"                      \
    }
#define RATE_AXIS                                                                        \
    {                                                                                    \
        .name = "rate_per_s", .label = "densification rate <i>v</i> (1/s)", .log = true, \
        .several = true                                                                  \
    }

/* Keys of what follows the loading branch. */
static const char *const after_loading[] = {"loading.hold", "loading.record_time", NULL};

static const struct gb_figures_row table[] = {
    {"time", "pressure against time, every run and the mean", "P2 Fig. 1",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = {.name = "time_ns", .label = "time <i>t</i> (ns)"}, .y = PRESSURE_AXIS,
     .compute = gb_figures_time},
    {"densification", "pressure against density, with the asymptote in 2D",
     "P1 Fig. 5, P2 Fig. 2", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .ignored_keys = after_loading, .x = DENSITY_AXIS, .y = PRESSURE_AXIS,
     .compute = gb_figures_densification},
    {"difference", "pressure minus that of the reference, with P2 (9)", "P2 Fig. 3",
     GB_FIGURES_RUNS, GB_FIGURES_ON_REQUEST, GB_FIGURES_REFERENCE,
     .ignored_keys = after_loading, .x = DENSITY_AXIS,
     .y = {.name = "difference_MPa",
           .label = "pressure difference " DELTA "<i>p</i> (MPa)"},
     .compute = gb_figures_difference},
    {"rate", "pressure at given densities against rate, with power law", "P2 sec. 3",
     GB_FIGURES_RUNS, GB_FIGURES_ON_REQUEST, GB_FIGURES_DENSITY,
     .ignored_keys = after_loading, .x = RATE_AXIS,
     .y = {.name = "p_MPa", .label = "pressure <i>p</i> (MPa)", .log = true},
     .compute = gb_figures_rate},
    {"rate-difference", "pressure above the static one against rate, with P2 (9)",
     "P2 Fig. 4", GB_FIGURES_RUNS, GB_FIGURES_ON_REQUEST, GB_FIGURES_DENSITY,
     .ignored_keys = after_loading, .x = RATE_AXIS,
     .y = {.name = "difference_MPa",
           .label = "pressure above the static one <i>p</i> \xe2\x88\x92 "
                    "<i>p</i><sub>stat</sub> (MPa)"},
     .compute = gb_figures_rate_difference},
    {"relaxation", "relaxation times after compression, from the fitted decay",
     "P2 Table 1", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = RATE_AXIS,
     .y = {.name = "tau_ns",
           .label = "relaxation time <i>\xcf\x84</i> (ns)",
           .log = true},
     .compute = gb_figures_relaxation},
    {"relaxation-amplitude", "amplitudes of the fitted decay after compression",
     "P2 Table 1", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = RATE_AXIS,
     .y = {.name = "amplitude_MPa",
           .label = "amplitude <i>p<sub>i</sub></i> (MPa)",
           .log = true},
     .compute = gb_figures_relaxation_amplitude},
    {"decay", "pressure after compression against time, with its fit", "P2 (4)",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = {.name = "t_ns",
           .label = "time since the end of compression <i>t</i> (ns)",
           .log = true},
     .y = PRESSURE_AXIS, .compute = gb_figures_decay},
    {"unloading", "density against pressure, loading and unloading", "P1 Fig. 11, 12",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = PRESSURE_AXIS, .y = DENSITY_AXIS,
     .compute = gb_figures_unloading},
    {"continuum", "pressure against density, with continuum theory for three geometries",
     "P1 Fig. 12", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = DENSITY_AXIS,
     .y = PRESSURE_AXIS, .compute = gb_figures_continuum},
    {"fit", "density against pressure with fitted equations of compaction, residuals", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .ignored_keys = after_loading,
     .x = {.name = "p_MPa", .label = "pressure <i>p</i> (MPa)", .log = true},
     .y = DENSITY_AXIS, .compute = gb_figures_fit},
    {"heckel", "Heckel plot with its straightest stretch and the yield pressure",
     "Heckel 1961", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .ignored_keys = after_loading,
     .x = PRESSURE_AXIS,
     .y = {.name = "log_porosity", .label = "ln(1 / (1 \xe2\x88\x92 " RHO "))"},
     .compute = gb_figures_heckel},
    {"coordination", "mean coordination number against density", "P1 Fig. 8, P2 (8)",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .ignored_keys = after_loading,
     .x = DENSITY_AXIS,
     .y = {.name = "coordination", .label = "mean coordination number"},
     .compute = gb_figures_coordination},
    {"lateral", "lateral-to-axial stress ratio against density", "P1 Fig. 13",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .ignored_keys = after_loading,
     .x = DENSITY_AXIS,
     .y = {.name = "ratio",
           .label = "lateral-to-axial stress ratio <i>p<sub>x</sub></i> / "
                    "<i>p<sub>z</sub></i>"},
     .compute = gb_figures_lateral},
    {"path", "deviatoric stress against mean pressure, leg by leg", "", GB_FIGURES_RUNS,
     GB_FIGURES_IN_REPORT,
     .x = {.name = "p_MPa", .label = "mean pressure <i>p</i> (MPa)"},
     .y = {.name = "q_MPa", .label = "deviatoric stress <i>q</i> (MPa)"},
     .compute = gb_figures_legs_path},
    {"stress-strain", "deviatoric stress against the strain of the legs", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .y = {.name = "q_MPa", .label = "deviatoric stress <i>q</i> (MPa)"},
     .compute = gb_figures_legs_stress_strain},
    {"size-effect", "density difference at one pressure against particle diameter",
     "P1 Fig. 6", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, GB_FIGURES_PRESSURE,
     .x = {.name = "diameter_nm", .label = "particle diameter <i>d</i> (nm)"},
     .y = {.name = "difference_points",
           .label = "difference of relative density " DELTA RHO " (%)"},
     .compute = gb_figures_size_effect},
    {"sweep",
     "density at one pressure against a varied key, one line per value of others", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, GB_FIGURES_PRESSURE, .y = DENSITY_AXIS,
     .compute = gb_figures_sweep},
    {"rdf", "radial distribution function", "P1 Fig. 4, 7", GB_FIGURES_STATES,
     GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "r", .label = "distance <i>r</i> / <i>d</i>"},
     .y = {.name = "g", .label = "radial distribution function <i>g</i>(<i>r</i>)"},
     .compute = gb_figures_rdf},
    {"contacts", "fraction of particles with each coordination number", "P1 sec. V",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "contacts", .label = "coordination number"},
     .y = {.name = "share_percent", .label = "fraction of particles (%)"},
     .compute = gb_figures_contacts},
    {"force-angle", "mean normal force against the contact angle to z", "P1 Fig. 14",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "angle_deg",
           .label =
               "angle between contact and <i>z</i> axis, <i>\xce\xb8</i> (\xc2\xb0)"},
     .compute = gb_figures_force_angle},
    {"sizes", "particle sizes by number, with the log-normal law",
     "P1 Fig. 10, P3 Fig. 14", GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .compute = gb_figures_sizes},
    {"sizes-volume", "particle sizes by volume, with the log-normal law", "P3 Fig. 14",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .compute = gb_figures_sizes_volume},
    {"poured-density", "density of poured powder over beds, with its statistics",
     "P3 Fig. 4, Table 1", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = {.name = "bed", .label = "bed"}, .y = DENSITY_AXIS,
     .compute = gb_figures_poured_density},
    {"die-section", "section of a bed with the sphere of the central density",
     "P3 Fig. 15", GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "x_um", .label = "distance from the axis <i>x</i> (\xc2\xb5m)"},
     .y = {.name = "z_um", .label = "height <i>z</i> (\xc2\xb5m)"},
     .compute = gb_figures_die_section},
    {"die-height", "axial strain against pressure in a die", "P3 Fig. 17",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = PRESSURE_AXIS,
     .y = {.name = "height_change",
           .label = "axial strain " DELTA "<i>H</i> / <i>H</i><sub>0</sub>"},
     .compute = gb_figures_die_height},
    {"die-density", "density of a compact in a die and of its central region",
     "P3 Fig. 18-20", GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = PRESSURE_AXIS,
     .y = DENSITY_AXIS, .compute = gb_figures_die_density},
    {"die-cycle", "punch pressure against density: loading, unloading, ejected", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT, .x = DENSITY_AXIS, .y = PRESSURE_AXIS,
     .compute = gb_figures_die_cycle},
    {"die-ejection", "force of ejection against the travel of the compact", "",
     GB_FIGURES_RUNS, GB_FIGURES_IN_REPORT,
     .x = {.name = "travel_um",
           .label = "travel of the compact through the die <i>s</i> (\xc2\xb5m)"},
     .y = {.name = "force_mN", .label = "force of ejection <i>F</i> (mN)"},
     .compute = gb_figures_die_cycle_ejection},
    {"die-wall", "radial pressure on the wall of a die over the height", "",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT, .x = HEIGHT_AXIS,
     .y = {.name = "wall_MPa", .label = "wall pressure <i>p<sub>r</sub></i> (MPa)"},
     .compute = gb_figures_die_profile_wall},
    {"die-axial", "density of a compact in a die over the height", "", GB_FIGURES_STATES,
     GB_FIGURES_IN_REPORT, GB_FIGURES_AT, .x = HEIGHT_AXIS, .y = DENSITY_AXIS,
     .compute = gb_figures_die_profile_axial},
    {"die-radial", "density of a compact in a die against the distance from the axis", "",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "r", .label = "distance from the axis <i>r</i> / <i>R</i>"},
     .y = DENSITY_AXIS, .compute = gb_figures_die_profile_radial},
    {"die-map", "density of a compact in a die over radius and height", "",
     GB_FIGURES_STATES, GB_FIGURES_IN_REPORT, GB_FIGURES_AT,
     .x = {.name = "r_um", .label = "distance from the axis <i>r</i> (\xc2\xb5m)"},
     .y = {.name = "z_um", .label = "height <i>z</i> (\xc2\xb5m)"},
     .compute = gb_figures_die_map},
    {"contact", "normal force of two particles, loading and unloading", "P1 Fig. 1",
     GB_FIGURES_SCENE, .preset = "p1-set2-16nm",
     .x = {.name = "h", .label = "overlap <i>h</i> / <i>d</i>"},
     .y = {.name = "force_nN", .label = "normal force <i>f<sub>n</sub></i> (nN)"},
     .compute = gb_figures_contact},
    {"bridge-strength", "strength of a bridge of three lengths", "P1 Fig. 2",
     GB_FIGURES_SCENE, .preset = "p1-set2-16nm",
     .x = {.name = "h", .label = "overlap <i>h</i> / <i>d</i>"},
     .y = {.name = "strength_GPa",
           .label = "bridge strength <i>\xcf\x83<sub>u</sub></i> (GPa)"},
     .compute = gb_figures_bridge_strength},
    {"hollomon", "stress against strain of hardening materials", "P3 Fig. 9",
     GB_FIGURES_SCENE, .preset = "p3-pair",
     .x = {.name = "strain_percent", .label = "strain <i>\xce\xb5</i> (%)"},
     .y = {.name = "stress_MPa", .label = "stress <i>\xcf\x83</i> (MPa)"},
     .compute = gb_figures_hollomon},
    {"pair", "force between two equal spheres, elastic and plastic", "P3 Fig. 10",
     GB_FIGURES_SCENE, .preset = "p3-pair",
     .x = {.name = "h_nm", .label = "indentation <i>h</i> (nm)"},
     .y = {.name = "force_mN", .label = "force <i>F</i> (mN)"},
     .compute = gb_figures_pair_force},
    {"line", "force on a small sphere between two large ones", "P3 Fig. 11",
     GB_FIGURES_SCENE, .preset = "p3-line",
     .x = {.name = "h_nm", .label = "indentation <i>h</i> (nm)"},
     .y = {.name = "force_mN", .label = "force <i>F</i> (mN)"},
     .compute = gb_figures_pair_force},
    {"critical-step", "critical time step of two equal spheres", "P3 Fig. 12",
     GB_FIGURES_SCENE, .preset = "p3-pair",
     .x = {.name = "h_nm", .label = "indentation <i>h</i> (nm)"},
     .y = {.name = "step_ns",
           .label = "critical time step " DELTA "<i>t</i><sub>cr</sub> (ns)"},
     .compute = gb_figures_pair_step},
    {"card", "yield points and fitted Drucker-Prager cap, from greenbody card", "",
     GB_FIGURES_TABLE, .x = {.name = "p_MPa", .label = "mean pressure <i>p</i> (MPa)"},
     .y = {.name = "q_MPa", .label = "deviatoric stress <i>q</i> (MPa)"},
     .compute = gb_figures_card},
    {"card-uniaxial", "lateral-to-axial stress ratio, simulated and of the card", "",
     GB_FIGURES_TABLE, .x = DENSITY_AXIS,
     .y = {.name = "ratio",
           .label = "lateral-to-axial stress ratio <i>p<sub>x</sub></i> / "
                    "<i>p<sub>z</sub></i>"},
     .compute = gb_figures_card_uniaxial},
    {"yield", "yield points, fitted ellipse and plastic flow, from greenbody yield", "",
     GB_FIGURES_TABLE, .x = {.name = "p_MPa", .label = "mean pressure <i>p</i> (MPa)"},
     .y = {.name = "q_MPa", .label = "deviatoric stress <i>q</i> (MPa)"},
     .compute = gb_figures_yield},
    {"strength", "strength after unloading against pressing, from greenbody strength", "",
     GB_FIGURES_TABLE,
     .y = {.name = "strength_MPa", .label = "strength <i>\xcf\x83</i> (MPa)"},
     .compute = gb_figures_strength},
    {"strength-curves", "stress against strain of the tests of greenbody strength", "",
     GB_FIGURES_TABLE, .options = GB_FIGURES_AT,
     .x = {.name = "strain_percent", .label = "strain <i>\xce\xb5</i> (%)"},
     .y = {.name = "stress_MPa", .label = "stress <i>\xcf\x83</i> (MPa)"},
     .compute = gb_figures_strength_curves},
    {"moduli", "Young's, bulk, shear modulus and Poisson's ratio, of greenbody moduli",
     "", GB_FIGURES_TABLE, .x = DENSITY_AXIS, .y = MODULUS_AXIS,
     .compute = gb_figures_moduli},
    {"moduli-axial", "elastic constants of the axis z against density", "",
     GB_FIGURES_TABLE, .x = DENSITY_AXIS, .y = MODULUS_AXIS,
     .compute = gb_figures_moduli_axial},
    {"chart", "accuracy against cost of numerical settings, from greenbody chart", "",
     GB_FIGURES_TABLE,
     .x = {.name = "cpu_s", .label = "processor time of one cell (s)", .log = true},
     .y = {.name = "bound_points",
           .label = "density error (% of theoretical density)",
           .log = true},
     .compute = gb_figures_chart},
    {"chart-error", "density error at one pressure against force evaluations", "",
     GB_FIGURES_TABLE, .options = GB_FIGURES_PRESSURE,
     .x = {.name = "evaluations", .label = "force evaluations of one cell", .log = true},
     .y = {.name = "error_points", .label = "density error (% of theoretical density)"},
     .compute = gb_figures_chart_error},
    {"chart-quantity", "deviation of a reported quantity against cost", "",
     GB_FIGURES_TABLE,
     .x = {.name = "cost", .label = "time of a cell over the default's", .log = true},
     .y = {.name = "error_points", .label = "deviation from the tightest setting (%)"},
     .compute = gb_figures_chart_quantity},
    {0},
};

const struct gb_figures_row *gb_figures_table(void)
{
    return table;
}

const struct gb_figures_row *gb_figures_find(const char *name)
{
    for (const struct gb_figures_row *row = table; row->name != NULL; row++) {
        if (strcmp(row->name, name) == 0) {
            return row;
        }
    }
    return NULL;
}

void gb_figures_group(const struct gb_figures_row *row, struct gb_runset *set)
{
    if (row->ignored_keys != NULL) {
        gb_runset_merge(set, row->ignored_keys);
    }
}

/* The function may have set the range of an axis, and its name where the row has none. */
static void set_axis(struct gb_series_axis *axis, const struct gb_series_axis *row)
{
    if (row->name != NULL) {
        axis->name = row->name;
        axis->label = row->label;
        axis->log = row->log;
        axis->several = row->several;
    }
}

void gb_figures_axes(const struct gb_figures_row *row, struct gb_series *series)
{
    set_axis(&series->x, &row->x);
    set_axis(&series->y, &row->y);
}

bool gb_figures_run(const struct gb_figures_row *row, struct gb_series *series,
                    const struct gb_figures_input *input, struct gb_error *err)
{
    const bool done = row->compute(series, input, err);
    if (done) {
        gb_figures_axes(row, series);
    }
    return done;
}

char *gb_figures_describe(const struct gb_figures_row *row)
{
    return *row->source != '\0' ? g_strdup_printf("%s (%s)", row->doc, row->source)
                                : g_strdup(row->doc);
}

char *gb_figures_names(unsigned options)
{
    GString *names = g_string_new(NULL);
    for (const struct gb_figures_row *row = table; row->name != NULL; row++) {
        if ((row->options & options) == options) {
            g_string_append_printf(names, "%s%s", names->len > 0 ? ", " : "", row->name);
        }
    }
    return g_string_free(names, FALSE);
}

static const struct {
    unsigned option;
    const char *words;
} options[] = {
    {GB_FIGURES_REFERENCE, "--reference"},
    {GB_FIGURES_DENSITY, "--density"},
    {GB_FIGURES_PRESSURE, "--pressure"},
    {GB_FIGURES_AT, "--at"},
};

bool gb_figures_check_options(const struct gb_figures_row *row, unsigned given,
                              struct gb_error *err)
{
    for (size_t k = 0; k < G_N_ELEMENTS(options); k++) {
        if ((given & options[k].option & ~row->options) != 0) {
            char *names = gb_figures_names(options[k].option);
            gb_error_set(err, GB_ERR_INPUT, "%s is for the figure%s %s", options[k].words,
                         strchr(names, ',') != NULL ? "s" : "", names);
            g_free(names);
            return false;
        }
    }
    if ((row->options & ~given & GB_FIGURES_REFERENCE) != 0) {
        return gb_error_set(err, GB_ERR_INPUT, "the figure %s needs --reference DIR",
                            row->name);
    }
    return true;
}
