#include <math.h>
#include <signal.h>
#include <stdio.h>

#include <glib.h>

#include "base/file.h"
#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "study/stability/stability.h"

static void add_number(GString *text, double value)
{
    g_string_append_c(text, ',');
    if (isfinite(value)) {
        g_string_append_printf(text, "%.8g", value);
    }
}

static void add_row(GString *text, const struct gb_stability_row *row)
{
    g_string_append_printf(text, "%s,%s,%s", row->method, row->scene, row->law);
    const double number[] = {
        row->damping, row->exact, row->theory, row->measured, row->measured / row->theory,
        row->used};
    for (size_t i = 0; i < G_N_ELEMENTS(number); i++) {
        add_number(text, number[i]);
    }
    g_string_append_c(text, '\n');
}

static void print_row(const struct gb_stability_row *row)
{
    char exact[24] = "";
    if (isfinite(row->exact)) {
        g_snprintf(exact, sizeof exact, "%.4g", row->exact);
    }
    gb_visible_print(stdout,
                     "%-8s  %-7s  %-8s  %7.2g  %11s  %8.4g  %8.4g  %6.3f  %8.4g\n",
                     row->method, row->scene, row->law, row->damping, exact, row->theory,
                     row->measured, row->measured / row->theory, row->used);
}

static bool measure(GString *csv, struct gb_error *err)
{
    gb_visible_put(
        stdout,
        "method    scene    law       damping  closed form    theory  measured   ratio "
        "     used\n");
    for (int i = 0; i < gb_stability_rows(); i++) {
        struct gb_stability_row row;
        if (!gb_stability_measure(i, &row, err)) {
            return false;
        }
        print_row(&row);
        add_row(csv, &row);
        fflush(stdout);
    }
    return true;
}

static bool write_csv(const GString *csv, const char *directory, struct gb_error *err)
{
    char *path = g_build_filename(directory, "stability.csv", NULL);
    const bool good =
        (g_mkdir_with_parents(directory, 0777) == 0 ||
         gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be made", directory)) &&
        gb_file_replace(path, csv->str, csv->len, err);
    g_free(path);
    return good;
}

int gb_cmd_stability(int argc, char **argv)
{
    static const struct gb_options_page page = {
        NULL,
        "Measures the longest stable step of each method and compares it with theory:\n"
        "the time step of velocity Verlet, fire and predict in sqrt(m/(E d)), and the\n"
        "largest displacement per force k of P1 (15) (steepest) in 1/(E d), at which a\n"
        "small disturbance of a packing at rest does not grow.",
        "theory: 2/omega of the fastest mode, with damping times sqrt(1+xi^2)-xi;\n"
        "2/omega^2 for steepest, sqrt(2)/omega for fire and predict, which with a fixed\n"
        "step and a stop at every move are (15) with k = step^2.  damping: xi.  closed\n"
        "form: the same without numerics.\n"
        "used: the step at which the guard of dynamic scenes intervenes, or the longest\n"
        "step of the relaxer.  Alumina of 9.7 nm, every pair at its equilibrium "
        "distance."};
    char *directory = NULL;
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {{"out", 'o', 0, G_OPTION_ARG_FILENAME, &directory,
                                     "directory that receives stability.csv", "DIR"},
                                    {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        GString *csv = g_string_new(
            "# greenbody " GB_VERSION "\n"
            "# steps in sqrt(m/(E d)), of steepest in 1/(E d); ratio: measured / theory\n"
            "method,scene,law,damping,closed_form,theory,measured,ratio,used\n");
        signal(SIGXFSZ, SIG_IGN);
        bool good = words[0] == NULL ||
                    gb_error_set(&err, GB_ERR_INPUT,
                                 "stability takes no words, got %.80s", words[0]);
        good =
            good && measure(csv, &err) && (!directory || write_csv(csv, directory, &err));
        status = good ? 0 : gb_options_fail(&err);
        g_string_free(csv, TRUE);
    }
    g_free(directory);
    g_strfreev(words);
    return status;
}
