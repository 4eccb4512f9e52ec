#include <math.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "base/number.h"
#include "base/table.h"
#include "base/units.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "measure/distribution.h"

static const char diameter_prefix[] = "diameter_";

/* A measured histogram; the arrays belong to the table. */
struct histogram {
    struct gb_table *table;
    const char *unit; /* unit of the diameters, in the name of a column */
    const double *middle, *weight;
    bool particles; /* weights are numbers of particles */
};

static const double *find_diameter(struct histogram *histogram, struct gb_error *err)
{
    for (size_t k = 0; gb_table_name(histogram->table, k) != NULL; k++) {
        const char *name = gb_table_name(histogram->table, k);
        double value = 0.0;
        char *text =
            g_strconcat("1 ", name + MIN(strlen(name), strlen(diameter_prefix)), NULL);
        const bool length = g_str_has_prefix(name, diameter_prefix) &&
                            gb_units_parse(text, GB_DIM_LENGTH, &value, NULL);
        g_free(text);
        if (length) {
            histogram->unit = name + strlen(diameter_prefix);
            return gb_table_column(histogram->table, name, err);
        }
    }
    gb_error_set(
        err, GB_ERR_INPUT,
        "%.300s: no column of diameters; expected diameter_nm or another unit of "
        "length",
        gb_table_path(histogram->table));
    return NULL;
}

static bool read_histogram(struct histogram *histogram, const char *path,
                           struct gb_error *err)
{
    *histogram = (struct histogram){0};
    if (!gb_table_read(&histogram->table, path, NULL, err)) {
        return false;
    }
    histogram->middle = find_diameter(histogram, err);
    histogram->weight = gb_table_column(histogram->table, "count", NULL);
    histogram->particles = histogram->weight != NULL;
    if (histogram->middle != NULL && !histogram->particles) {
        histogram->weight = gb_table_column(histogram->table, "share_number", NULL);
    }
    if (histogram->middle != NULL && histogram->weight == NULL) {
        return gb_error_set(
            err, GB_ERR_INPUT,
            "%.300s: expected a column count (particles in each class) or "
            "share_number",
            path);
    }
    return histogram->middle != NULL;
}

/* Prints the law as keys of a preset, rounded to their accuracy. */
static void print_keys(const struct gb_lognormal *law, const char *unit)
{
    gb_visible_print(stdout,
                     "particles.distribution = lognormal\n"
                     "particles.diameter = %.4g %s\n"
                     "particles.sigma = %.4g\n",
                     exp(law->m), unit, law->sigma);
}

static void print_law(const struct gb_lognormal *law, const char *unit)
{
    char m[GB_NUMBER_ERROR_MAX];
    char sigma[GB_NUMBER_ERROR_MAX];
    gb_visible_print(stdout, "# P1 (17), sizes in %s: m = ", unit);
    if (isfinite(law->m_error)) {
        gb_visible_print(stdout, "%s, sigma = %s, correlation %.2f\n",
                         gb_number_error(law->m, law->m_error, 2, " +- ", m),
                         gb_number_error(law->sigma, law->sigma_error, 2, " +- ", sigma),
                         law->correlation);
        if (law->degrees > 0) {
            gb_visible_print(stdout,
                             "# chi-squared %.3g for %zu degrees of freedom: probability "
                             "%.2g if the law is true\n",
                             law->chi_squared, law->degrees, law->probability);
        } else {
            gb_visible_put(stdout, "# too few particles or classes to test the law\n");
        }
    } else {
        gb_visible_print(stdout,
                         "%.4f, sigma = %.4f; no errors and no test from shares\n",
                         law->m, law->sigma);
    }
    gb_visible_print(stdout,
                     "# the shares below a size differ from the law by %.2g %% at most\n"
                     "# most frequent size %.4g %s\n",
                     100.0 * law->distance, exp(law->m - law->sigma * law->sigma), unit);
}

static bool fit(char **words, struct gb_error *err)
{
    struct histogram histogram = {0};
    struct gb_lognormal law;
    if (g_strv_length(words) != 1) {
        return gb_error_set(err, GB_ERR_INPUT, "sizes takes one file: FILE.csv");
    }
    struct gb_error why = {0};
    bool good = read_histogram(&histogram, words[0], err);
    if (good && !gb_distribution_lognormal(&law, histogram.middle, histogram.weight,
                                           gb_table_rows(histogram.table),
                                           histogram.particles, &why)) {
        good = gb_error_set(err, why.code, "%.200s: %s", words[0], why.text);
    }
    if (good) {
        print_law(&law, histogram.unit);
        print_keys(&law, histogram.unit);
        good = !(law.probability < GB_LOGNORMAL_REJECTED) ||
               gb_error_set(err, GB_ERR_GUARD,
                            "%.200s: the log-normal law does not describe these sizes: "
                            "probability %.2g, expected %g or more",
                            words[0], law.probability, GB_LOGNORMAL_REJECTED);
    }
    gb_table_destroy(histogram.table);
    return good;
}

int gb_cmd_sizes(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "FILE.csv",
        "Fits the log-normal law of particle sizes, P1 (17), to a measured histogram\n"
        "and prints it as keys of a preset.",
        "The file has a row per class: its middle in diameter_nm (or another unit of\n"
        "length) and the number of its particles, count, or their share, share_number.\n"
        "Maximum likelihood; the limits of the classes lie halfway between the middles.\n"
        "A chi-squared test asks whether the law describes the counts.  If its probability\n"
        "is below 0.05, a line reports it and the exit status is 1."};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {{0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = fit(words, &err) ? 0 : gb_options_fail(&err);
    }
    g_strfreev(words);
    return status;
}
