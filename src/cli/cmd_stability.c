#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <glib.h>

#include "base/file.h"
#include "base/listing.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "io/preset.h"
#include "scene/loading_kind.h"
#include "scene/tolerances.h"
#include "study/stability.h"

static void add_row(struct gb_listing *listing, const struct gb_stability_row *row)
{
    const double number[] = {
        row->damping, row->exact, row->theory, row->measured, row->measured / row->theory,
        row->used};
    gb_listing_text(listing, row->method);
    gb_listing_text(listing, row->scene);
    gb_listing_text(listing, row->law);
    gb_listing_numbers(listing, number, G_N_ELEMENTS(number));
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

static bool measure(struct gb_listing *listing, struct gb_error *err)
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
        add_row(listing, &row);
        fflush(stdout);
    }
    return true;
}

static bool write_listing(const struct gb_listing *listing, const char *directory,
                          struct gb_error *err)
{
    if (directory == NULL) {
        return true;
    }
    GString *csv = gb_listing_print(listing, GB_LISTING_CSV);
    char *path = g_build_filename(directory, "stability.csv", NULL);
    const bool good =
        (g_mkdir_with_parents(directory, 0777) == 0 ||
         gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be made", directory)) &&
        gb_file_replace(path, csv->str, csv->len, err);
    g_string_free(csv, TRUE);
    g_free(path);
    return good;
}

/* Studies each method at each packing of the study. */
static bool perform_study(const char *directory, struct gb_error *err)
{
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, "greenbody " GB_VERSION "\n"
                                "steps in sqrt(m/(E d)), of steepest in 1/(E d); ratio: "
                                "measured / theory");
    gb_listing_columns(listing, "%s", "method,scene,law");
    gb_listing_columns(listing, "%.8g", "damping,closed_form,theory,measured,ratio,used");
    const bool good = measure(listing, err) && write_listing(listing, directory, err);
    gb_listing_free(listing);
    return good;
}

/* --- a scene ------------------------------------------------------------------------ */

struct scene {
    char *directory, *at, *command;
    gboolean quiet;
    struct gb_listing *listing;
    int rows, rows_most, missed;
    char method[16];    /* method with the least margin so far ... */
    double least, step; /* ... measured / used, and the step that was measured */
};

static bool add_scene_row(void *data, const struct gb_stability_row *row,
                          struct gb_error *err)
{
    struct scene *scene = data;
    const double margin = row->measured / row->used;
    if (scene->rows++ == 0) {
        gb_visible_put(stdout, "method     p, MPa  density  damping    theory  measured  "
                               "    used  margin\n");
    }
    gb_visible_print(
        stdout, "%-8s  %7.4g  %7.4f  %7.2g  %8.4g  %8.4g  %8.4g  %6.2f  %s%s\n",
        row->method, 1e-6 * row->p_pa, row->density, row->damping, row->theory,
        row->measured, row->used, margin,
        gb_stability_stable(row) ? "stable" : "unstable", row->in_use ? ", in use" : "");
    fflush(stdout);
    if (row->in_use && !(margin >= scene->least)) {
        scene->least = margin;
        scene->step = row->measured;
        g_strlcpy(scene->method, row->method, sizeof scene->method);
    }
    if (!scene->quiet && !isatty(STDOUT_FILENO)) { /* the workbench reads these lines */
        gb_visible_line(stderr, "%d of %d states: %s, p %.4g MPa", scene->rows,
                        scene->rows_most, row->method, 1e-6 * row->p_pa);
    }
    gb_stability_add(scene->listing, row);
    return write_listing(scene->listing, scene->directory, err);
}

static void say_skipped(void *data, double p_pa, const char *why)
{
    (void)data;
    gb_visible_line(stderr, "stability: p %.4g MPa: left out: %s", 1e-6 * p_pa, why);
}

static void conclude(const struct scene *scene, const struct gb_params *params)
{
    if (scene->method[0] == '\0') {
        return;
    }
    const bool in_time = gb_loading_kind_of(params)->follows_time;
    gb_visible_print(stdout,
                     "%s, the method in use: the longest stable step is at least %.2f "
                     "times %s%s\n",
                     scene->method, scene->least,
                     in_time ? "the one taken" : "its longest step",
                     scene->least >= 1.0 ? ""
                     : in_time           ? ": unstable"
                                         : ", which it shortens where it is unstable");
    if (in_time) {
        gb_visible_print(stdout,
                         "stable with a margin of 2 in these states: "
                         "numerics.time_step=%.3g T\n",
                         GB_STEP_CRITICAL_FRACTION * scene->step);
    }
}

static bool perform_scene(struct scene *scene, char **words, char **sets,
                          struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    struct gb_keep_points points;
    const struct gb_stability_sink sink = {add_scene_row, say_skipped, scene,
                                           gb_progress_cancelled};
    gb_progress_catch_signals(GB_SIGNALS_HANGUP_ENDS);
    scene->least = INFINITY;
    bool good = gb_options_points(&points, scene->at, err) &&
                gb_options_scene(&preset, words, sets, GB_OPTIONS_PRESET_NEEDED, err);
    if (good) {
        const struct gb_params *params = gb_preset_params(preset);
        char *comment = g_strdup_printf("greenbody " GB_VERSION "\npreset: %s\n%s",
                                        params->title, scene->command);
        scene->listing = gb_stability_table(comment);
        g_free(comment);
        int first = 0;
        scene->rows_most = gb_stability_methods(params, &first) *
                           (1 + (scene->at ? points.count : GB_STABILITY_RUN_POINTS));
        good = gb_stability_run(params, scene->at ? &points : NULL, &sink, &scene->missed,
                                err);
        if (scene->rows > 0) {
            conclude(scene, params);
        }
        if (good && scene->at && scene->missed > 0) {
            good = gb_error_set(err, GB_ERR_GUARD,
                                "the run has ended before %d of the %d points asked for",
                                scene->missed, points.count);
        }
        gb_listing_free(scene->listing);
    }
    gb_preset_destroy(preset);
    return good;
}

static bool perform(struct scene *scene, char **words, char **sets, struct gb_error *err)
{
    if (words[0] != NULL || sets != NULL) {
        return perform_scene(scene, words, sets, err);
    }
    return (scene->at == NULL ||
            gb_error_set(err, GB_ERR_INPUT, "--at: expected with a PRESET")) &&
           perform_study(scene->directory, err);
}

int gb_cmd_stability(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "[PRESET [group.key=value]...]",
        "Measures the longest stable step of each method and compares it with theory:\n"
        "the time step of velocity Verlet, fire and predict in sqrt(m/(E d)), and the\n"
        "largest displacement per force k of P1 (15) (steepest) in 1/(E d), at which a\n"
        "small disturbance of a packing at rest does not grow.  With a PRESET the\n"
        "methods of this scene (verlet, or the relaxers) in states of its run, on copies\n"
        "brought to rest, and whether the step that each takes is stable; without one\n"
        "alumina of 9.7 nm, every pair at its equilibrium distance.",
        "theory: 2/omega of the fastest mode, with damping times sqrt(1+xi^2)-xi;\n"
        "2/omega^2 for steepest, sqrt(2)/omega for fire and predict, which with a fixed\n"
        "step and a stop at every move are (15) with k = step^2.  damping: xi.  closed\n"
        "form: the same without numerics.\n"
        "used: the step at which the guard of dynamic scenes intervenes, or the longest\n"
        "step of the relaxer, which it shortens where the work turns negative; of a\n"
        "dynamic scene the step that its run takes there.  margin: measured / used."};
    struct scene scene = {0};
    char **words = NULL, **sets = NULL;
    int status = 0;
    const GOptionEntry entries[] = {
        gb_options_set(&sets),
        {"at", 0, 0, G_OPTION_ARG_STRING, &scene.at,
         "states, as \"p=100 MPa; density=0.5\" (1, 10 and 100 MPa), and the last",
         "POINTS"},
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &scene.directory,
         "directory that receives stability.csv", "DIR"},
        gb_options_quiet(&scene.quiet),
        {0}};
    scene.command = gb_options_command("command: ", argc, argv);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        struct gb_error err = {0};
        if (!perform(&scene, words, sets, &err)) {
            status = gb_options_fail(&err);
            status =
                err.code == GB_ERR_CANCELLED ? gb_progress_exit_status(&err) : status;
        }
    }
    g_free(scene.command);
    g_free(scene.directory);
    g_free(scene.at);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
