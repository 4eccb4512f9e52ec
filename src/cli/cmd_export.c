#include <math.h>
#include <string.h>

#include <glib.h>

#include "base/file.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "figures/states.h"
#include "io/export.h"
#include "io/follow.h"
#include "io/rundir.h"

/* The options of the command line. */
struct request {
    char *format, *at, *output, *contacts;
    gboolean all, force;
};

struct export
{
    const struct gb_export_format *format;
    const char *source;
    double density_kg_m3; /* NaN: the source is a file */
    GString *particles, *contacts;
};

static bool check_request(const struct request *request, char **words, struct export *job,
                          struct gb_error *err)
{
    if (words == NULL || words[0] == NULL || words[1] != NULL) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "export: expected one run directory or state file");
    }
    if (request->output == NULL || request->format == NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "export needs --format NAME and -o FILE");
    }
    if (request->all && request->at != NULL) {
        return gb_error_set(err, GB_ERR_INPUT, "--all and --at: expected one of them");
    }
    job->source = words[0];
    job->format = gb_export_find(request->format, err);
    return job->format != NULL;
}

static bool check_target(const char *path, gboolean force, struct gb_error *err)
{
    if (path == NULL) {
        return true;
    }
    if (!force && g_file_test(path, G_FILE_TEST_EXISTS)) {
        return gb_error_set(err, GB_ERR_INPUT, "%.300s exists; --force replaces it",
                            path);
    }
    return gb_rundir_files_protect(path, err) && gb_file_check_target(path, err);
}

static bool add(struct export *job, struct gb_state *state, int64_t index,
                struct gb_error *err)
{
    const bool good = gb_export_add(job->format, state, job->density_kg_m3, index,
                                    job->particles, job->contacts, err);
    gb_state_destroy(state);
    return good;
}

static bool write_text(const char *path, const GString *text, struct gb_error *err)
{
    return path == NULL || gb_file_replace(path, text->str, text->len, err);
}

/* Writes the texts collected so far. */
static bool write_both(struct export *job, const char *particles, const char *contacts,
                       struct gb_error *err)
{
    return write_text(contacts, job->contacts, err) &&
           write_text(particles, job->particles, err);
}

/* Exports one state, or all states into the same texts. */
static bool write_whole(struct export *job, const struct request *request,
                        const GPtrArray *paths, struct gb_error *err)
{
    struct gb_state *state = NULL;
    bool good = true;
    if (paths == NULL) {
        good = gb_states_read(&state, job->source, request->at, err) &&
               add(job, state, 0, err);
    }
    for (guint i = 0; good && paths != NULL && i < paths->len; i++) {
        good = gb_state_read(&state, g_ptr_array_index(paths, i), err) &&
               add(job, state, i, err);
    }
    return good && write_both(job, request->output, request->contacts, err);
}

/* May the numbered files of a series and their list be written: are they new, or is
 * --force given? */
static bool check_series(const char *path, guint count, gboolean force,
                         struct gb_error *err)
{
    bool good = true;
    for (guint i = 0; good && path != NULL && i <= count; i++) {
        char *name =
            i < count ? gb_export_series_name(path, i) : gb_export_series_list_name(path);
        good = check_target(name, force, err);
        g_free(name);
    }
    return good;
}

static bool write_member(struct export *job, const struct request *request, guint index,
                         struct gb_error *err)
{
    char *particles = gb_export_series_name(request->output, index);
    char *contacts = request->contacts != NULL
                         ? gb_export_series_name(request->contacts, index)
                         : NULL;
    const bool good = write_both(job, particles, contacts, err);
    g_free(particles);
    g_free(contacts);
    return good;
}

/* Writes a file for each state, then the lists, which make the files a series. */
static bool write_series(struct export *job, const struct request *request,
                         const GPtrArray *paths, struct gb_error *err)
{
    int64_t *steps = g_new0(int64_t, paths->len + 1);
    bool good = check_series(request->output, paths->len, request->force, err) &&
                check_series(request->contacts, paths->len, request->force, err);
    for (guint i = 0; good && i < paths->len; i++) {
        struct gb_state *state = NULL;
        g_string_truncate(job->particles, 0);
        if (job->contacts != NULL) {
            g_string_truncate(job->contacts, 0);
        }
        good = gb_state_read(&state, g_ptr_array_index(paths, i), err);
        steps[i] = good ? state->point.step : 0;
        good = good && add(job, state, 0, err) && write_member(job, request, i, err);
    }
    good = good && gb_export_series_put_list(request->output, steps, paths->len, err) &&
           (request->contacts == NULL ||
            gb_export_series_put_list(request->contacts, steps, paths->len, err));
    g_free(steps);
    return good;
}

static bool write_files(struct export *job, const struct request *request,
                        struct gb_error *err)
{
    if (!request->all) {
        return write_whole(job, request, NULL, err);
    }
    GPtrArray *paths = gb_states_along(job->source, err);
    if (paths == NULL) {
        return false;
    }
    const bool good = job->format->trajectory ? write_whole(job, request, paths, err)
                                              : write_series(job, request, paths, err);
    g_ptr_array_unref(paths);
    return good;
}

/* Density of the solid, from the preset next to the source; a state file does not have
 * it. */
static double solid_density(const char *source)
{
    struct gb_params params;
    return g_file_test(source, G_FILE_TEST_IS_DIR) &&
                   gb_follow_params(source, &params, NULL)
               ? params.density_kg_m3
               : (double)NAN;
}

static bool perform(const struct request *request, char **words, struct gb_error *err)
{
    struct export job = {0};
    if (!check_request(request, words, &job, err)) {
        return false;
    }
    const bool numbered = request->all && !job.format->trajectory;
    if (!numbered && (!check_target(request->output, request->force, err) ||
                      !check_target(request->contacts, request->force, err))) {
        return false;
    }
    if (request->contacts != NULL &&
        gb_file_is_same(request->contacts, request->output)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "--contacts %.300s: expected a name that differs from -o",
                            request->contacts);
    }
    job.density_kg_m3 = solid_density(job.source);
    job.particles = g_string_new(NULL);
    job.contacts = request->contacts != NULL ? g_string_new(NULL) : NULL;
    const bool good = write_files(&job, request, err);
    g_string_free(job.particles, TRUE);
    if (job.contacts != NULL) {
        g_string_free(job.contacts, TRUE);
    }
    return good;
}

/* The formats, for the help; g_free. */
static char *describe(void)
{
    GString *text = g_string_new("Formats:\n");
    const struct gb_export_format *format;
    for (size_t i = 0; (format = gb_export_at(i)) != NULL; i++) {
        g_string_append_printf(text, "  %-13s %s\n", format->name, format->doc);
    }
    g_string_append(
        text, "\nParticles with velocities, angular velocities, forces and "
              "torques where the run has\nthem; contacts with forces, areas and "
              "bridges.  Lengths in nm, velocities in m/s,\nforces in nN (pN in "
              "dumps), stresses in MPa, positive in compression.  Contacts\nare a "
              "dump with formats of LAMMPS, else a table.  Pairs that attract across a\n"
              "gap follow them, with a negative overlap.\n\n"
              "  greenbody export run --format extxyz --all -o run.xyz\n"
              "  greenbody export run --format lammps-dump --at 'p=100 MPa' \\\n"
              "    --contacts contacts.dump -o run.dump");
    return g_string_free(text, FALSE);
}

int gb_cmd_export(int argc, char **argv)
{
    struct request request = {0};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    char *description = describe();
    const struct gb_options_page page = {
        "DIR or STATE.h5", "Packings and contacts of a run as files of other programs.",
        description};
    const GOptionEntry entries[] = {
        {"format", 0, 0, G_OPTION_ARG_STRING, &request.format, "one of those below",
         "NAME"},
        {"at", 0, 0, G_OPTION_ARG_STRING, &request.at,
         "a kept state, as \"p=100 MPa\" or \"density=0.5\" (the last)", "POINT"},
        {"all", 0, 0, G_OPTION_ARG_NONE, &request.all,
         "all kept states in the order of the run (output.snapshots_at); in "
         "formats of one state FILE-0000, FILE-0001, ... and FILE.series",
         NULL},
        {"output", 'o', 0, G_OPTION_ARG_FILENAME, &request.output, "the particles",
         "FILE"},
        {"contacts", 0, 0, G_OPTION_ARG_FILENAME, &request.contacts,
         "the contacts, with forces and bridges", "FILE"},
        {"force", 0, 0, G_OPTION_ARG_NONE, &request.force, "replace existing files",
         NULL},
        {0}};
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = perform(&request, words, &err) ? 0 : gb_options_fail(&err);
    }
    g_free(request.format);
    g_free(request.at);
    g_free(request.output);
    g_free(request.contacts);
    g_strfreev(words);
    g_free(description);
    return status;
}
