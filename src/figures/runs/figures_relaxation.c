#include "figures/figures_compute.h"

#include <math.h>

#include "figures/runs/runs_check.h"
#include "many/mean_curves.h"

/* Fit of the mean curve of a group. */
struct group_fit {
    struct gb_fit_decay decay;
    double fall_error, efold_error;
    bool fitted;
};

/* Standard errors by the jackknife: fits without one run each; a fit that fails is left
 * out. */
static void jackknife(struct group_fit *fit, struct gb_average_curve *curves,
                      size_t members)
{
    double *fall = g_new(double, 2 * members);
    double *efold = fall + members;
    for (size_t i = 0; i < members; i++) {
        struct gb_fit_decay without;
        struct gb_error ignored = {0};
        const struct gb_average_curve removed = curves[i];
        curves[i] = curves[members - 1]; /* the order does not affect a mean */
        const bool good = members > 1 && gb_mean_curves_decay(&without, curves,
                                                                  members - 1, &ignored);
        curves[i] = removed;
        fall[i] = good ? gb_fit_decay_fall(&without) : (double)NAN;
        efold[i] = good ? gb_fit_decay_efold(&without) : (double)NAN;
    }
    fit->fall_error = gb_average_jackknife(fall, members);
    fit->efold_error = gb_average_jackknife(efold, members);
    g_free(fall);
}

static struct gb_fit_decay unfitted(void)
{
    const struct gb_fit_value none = {NAN, NAN, NAN, NAN};
    return (struct gb_fit_decay){
        .p0 = none, .amplitude = {none, none}, .tau = {none, none}, .scatter = NAN};
}

/* A mean that no fit describes leaves NaN, and the reason in cause. */
static bool fit_group(struct group_fit *fit, const struct gb_runset *set, size_t group,
                      struct gb_error *cause, struct gb_error *err)
{
    struct gb_mean_curves curves;
    if (!gb_mean_curves_relaxation(&curves, set, group, err)) {
        return false;
    }
    fit->fitted =
        gb_mean_curves_decay(&fit->decay, curves.curve, curves.count, cause);
    if (fit->fitted) {
        jackknife(fit, curves.curve, curves.count);
    } else {
        *fit = (struct group_fit){.decay = unfitted(), NAN, NAN, false};
    }
    gb_mean_curves_finish(&curves);
    return true;
}

/* Columns of one parameter: value and interval. */
static void value_columns(struct gb_series *series, const char *name, const char *unit,
                          const struct group_fit *fits, size_t offset)
{
    double *value = gb_series_column(series, "%s_%s", name, unit);
    double *low = gb_series_column(series, "%s_low_%s", name, unit);
    double *high = gb_series_column(series, "%s_high_%s", name, unit);
    for (size_t g = 0; g < series->rows; g++) {
        const struct gb_fit_value *parameter =
            (const struct gb_fit_value *)(const void *)((const char *)&fits[g].decay +
                                                        offset);
        value[g] = parameter->value;
        low[g] = parameter->low;
        high[g] = parameter->high;
    }
}

static void fall_columns(struct gb_series *series, const struct group_fit *fits)
{
    double *const columns[] = {
        gb_series_column(series, "scatter_MPa"), gb_series_column(series, "fall_MPa"),
        gb_series_column(series, "fall_se_MPa"), gb_series_column(series, "efold_ns"),
        gb_series_column(series, "efold_se_ns")};
    for (size_t g = 0; g < series->rows; g++) {
        const double row[] = {fits[g].decay.scatter, gb_fit_decay_fall(&fits[g].decay),
                              fits[g].fall_error, gb_fit_decay_efold(&fits[g].decay),
                              fits[g].efold_error};
        for (size_t k = 0; k < G_N_ELEMENTS(row); k++) {
            columns[k][g] = row[k];
        }
    }
}

/* What is drawn of both exponentials. */
enum drawn { TIMES, AMPLITUDES };

/* One parameter of both exponentials against the rate; bars: half of the 95 % interval. */
static void draw_parameter(struct gb_series *series, const double *rate,
                           const struct group_fit *fits, enum drawn drawn)
{
    static const char *const names[][GB_FIT_TERMS] = {
        [TIMES] = {"fast, <i>\xcf\x84</i><sub>1</sub>",
                   "slow, <i>\xcf\x84</i><sub>2</sub>"},
        [AMPLITUDES] = {"fast, <i>p</i><sub>1</sub>", "slow, <i>p</i><sub>2</sub>"}};
    const char *unit = drawn == TIMES ? "ns" : "MPa";
    for (int k = 0; k < GB_FIT_TERMS; k++) {
        double *value = gb_series_column(series, "drawn_%d_%s", k + 1, unit);
        double *half = gb_series_column(series, "half_%d_%s", k + 1, unit);
        bool shown = false; /* on the logarithmic axis */
        for (size_t g = 0; g < series->rows; g++) {
            const struct gb_fit_decay *decay = &fits[g].decay;
            const struct gb_fit_value *from =
                drawn == TIMES ? &decay->tau[k] : &decay->amplitude[k];
            value[g] = from->value;
            half[g] = 0.5 * (from->high - from->low);
            shown = shown || from->value > 0.0;
        }
        gb_series_draw(series, rate, value, half, GB_FIGURE_POINTS, k,
                       shown ? names[drawn][k] : NULL);
    }
    gb_series_caption(series,
                      "%s of the two exponentials of P2 (4); bars: 95 %% "
                      "confidence intervals.",
                      drawn == TIMES ? "Times" : "Amplitudes");
}

static void relaxation_columns(struct gb_series *series, const struct gb_runset *set,
                               const struct group_fit *fits,
                               const struct gb_error *causes, enum drawn drawn)
{
    static const char *const reasons[] = {
        "the number of P2 (4)", "no more by the F test",
        "the interval of one more contains zero or is unbounded",
        "the fit of one more did not converge"};
    double *group = gb_series_column(series, "group");
    double *rate = gb_series_column(series, "rate_per_s");
    double *runs = gb_series_column(series, "runs");
    double *terms = gb_series_column(series, "exponentials");
    for (size_t g = 0; g < set->groups; g++) {
        char *label = gb_runset_label(set, g);
        group[g] = (double)(g + 1);
        rate[g] = gb_runset_first(set, g)->params.rate_per_s;
        runs[g] = (double)gb_runset_members(set, g);
        terms[g] = fits[g].decay.terms;
        if (fits[g].fitted) {
            gb_series_note(series, "group %zu: %s%s%d exponentials, %s", g + 1, label,
                           *label ? "; " : "", fits[g].decay.terms,
                           reasons[fits[g].decay.reason]);
        } else {
            gb_series_note(series, "group %zu: %s%s%s", g + 1, label, *label ? "; " : "",
                           causes[g].text);
        }
        g_free(label);
    }
    value_columns(series, "p0", "MPa", fits, offsetof(struct gb_fit_decay, p0));
    value_columns(series, "p1", "MPa", fits, offsetof(struct gb_fit_decay, amplitude[0]));
    value_columns(series, "tau1", "ns", fits, offsetof(struct gb_fit_decay, tau[0]));
    value_columns(series, "p2", "MPa", fits, offsetof(struct gb_fit_decay, amplitude[1]));
    value_columns(series, "tau2", "ns", fits, offsetof(struct gb_fit_decay, tau[1]));
    fall_columns(series, fits);
    draw_parameter(series, rate, fits, drawn);
}

static bool fit_groups(struct group_fit *fits, struct gb_error *causes,
                       const struct gb_runset *set, struct gb_error *err)
{
    size_t fitted = 0;
    for (size_t g = 0; g < set->groups; g++) {
        if (!fit_group(&fits[g], set, g, &causes[g], err)) {
            return false;
        }
        fitted += fits[g].fitted;
    }
    return fitted > 0 || gb_error_set(err, causes[0].code, "%.300s: relaxation: %s",
                                      gb_runset_first(set, 0)->directory, causes[0].text);
}

static bool draw_table(struct gb_series *series, const struct gb_runset *set,
                       enum drawn drawn, struct gb_error *err)
{
    struct group_fit *fits = g_new0(struct group_fit, set->groups);
    struct gb_error *causes = g_new0(struct gb_error, set->groups);
    const bool good = fit_groups(fits, causes, set, err);
    if (good) {
        gb_series_init(series, set->groups);
        gb_series_note(series,
                       "p(t) = p0 + p1 exp(-t/tau1) + p2 exp(-t/tau2), P2 (4), fitted to "
                       "the mean of the runs; t from the end of compression");
        gb_series_note(series,
                       "intervals are at 95 %%, for as many points as the correlation of "
                       "the residuals leaves independent");
        gb_series_note(series,
                       "fall: total decrease of p; efold: time after which 1/e of it "
                       "remains; standard errors by the jackknife over the runs");
        relaxation_columns(series, set, fits, causes, drawn);
    }
    g_free(causes);
    g_free(fits);
    return good;
}

/* P2 (4) and table 1: times. */
bool gb_figures_relaxation(struct gb_series *series, const struct gb_figures_input *input,
                           struct gb_error *err)
{
    return gb_runs_check_dynamic(input->set, "relaxation", err) &&
           draw_table(series, input->set, TIMES, err);
}

/* The same table: amplitudes. */
bool gb_figures_relaxation_amplitude(struct gb_series *series,
                                     const struct gb_figures_input *input,
                                     struct gb_error *err)
{
    return gb_runs_check_dynamic(input->set, "relaxation-amplitude", err) &&
           draw_table(series, input->set, AMPLITUDES, err);
}
