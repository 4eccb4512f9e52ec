#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>

#include "base/number.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "figures/card_page.h"
#include "study/card.h"

/* The options of the command line. */
struct request {
    char **sets;
    char *out, *densities, *compacts;
    double pressure_mpa, offset_percent, transition, flow;
    gint replicas, directions, jobs;
    gboolean quiet;
};

static void print_progress(void *data, int done, int replicas)
{
    const struct request *request = data;
    if (!request->quiet) {
        gb_visible_line(stderr, "%d of %d cells", done, replicas);
    }
}

static bool read_densities(struct gb_card_options *options, const char *text,
                           struct gb_error *err)
{
    char **words = g_strsplit(text, ",", 0);
    const guint count = g_strv_length(words);
    bool good = (count >= 2 && count <= GB_CARD_LEVELS_MAX) ||
                gb_error_set(err, GB_ERR_INPUT, "--densities: must be 2 to %d numbers",
                             GB_CARD_LEVELS_MAX);
    for (guint i = 0; i < count && good; i++) {
        char *end = NULL;
        options->density[i] = g_ascii_strtod(words[i], &end);
        good = (end != words[i] && *end == '\0') ||
               gb_error_set(err, GB_ERR_INPUT,
                            "--densities: '%.40s': expected numbers, as in 0.4,0.5,0.6",
                            words[i]);
    }
    options->levels = good ? (int)count : 0;
    g_strfreev(words);
    return good;
}

static bool take_options(struct gb_card_options *options, const struct request *request,
                         const struct gb_params *preset, struct gb_error *err)
{
    options->replicas = request->replicas;
    options->directions = request->directions;
    options->offset = request->offset_percent / 100.0;
    options->transition = request->transition;
    options->flow = request->flow;
    options->pressure_pa = request->pressure_mpa * 1e6;
    if (request->pressure_mpa == 0.0) {
        options->pressure_pa =
            0.5 * (preset->until_pressure_pa > 0.0 ? preset->until_pressure_pa : 1e9);
    }
    if (request->out == NULL || request->out[0] == '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "card needs a preset and --out DIR");
    }
    return (options->pressure_pa > 0.0 ||
            gb_error_set(err, GB_ERR_INPUT, "--pressure %g: expected above 0",
                         request->pressure_mpa)) &&
           (request->densities == NULL ||
            read_densities(options, request->densities, err)) &&
           (request->compacts == NULL ||
            gb_card_path_of(&options->path, request->compacts, err)) &&
           gb_card_options_check(options, err) && gb_card_page_check(request->out, err);
}

static void print_result(const struct gb_card_study *study, const char *out)
{
    gb_visible_print(stdout, "%d densities from %.3f to %.3f, %d cells, %.0f s\n",
                     study->levels, study->card.density[0],
                     study->card.density[study->levels - 1], study->options.replicas,
                     study->seconds);
    for (int k = 0; k < GB_CARD_PATHS; k++) {
        const struct gb_card_misfit *misfit = &study->misfit[k];
        char number[3][GB_NUMBER_MAX];
        gb_visible_print(
            stdout,
            "%s path: misfit of p_x/p_z %s, of p_z %s %%, of density at the same p_z %s\n",
            gb_card_paths[k].name, gb_number_shown("%.3f", misfit->ratio, number[0]),
            gb_number_shown("%.1f", 100.0 * misfit->pressure, number[1]),
            gb_number_shown("%.4f", misfit->density, number[2]));
    }
    GString *misses = gb_card_files_misses(study);
    gb_visible_put(stdout, misses->str);
    g_string_free(misses, TRUE);
    gb_visible_print(stdout, "%s: card.csv, card.inp, card.html\n", out);
}

static bool perform(const struct request *request, char **words, const char *command,
                    struct gb_error *err)
{
    struct gb_preset *preset = NULL;
    struct gb_card_study *study = g_new0(struct gb_card_study, 1);
    const struct gb_card_callbacks callbacks = {.cancelled = gb_progress_cancelled,
                                                .progress = print_progress,
                                                .data = (void *)(size_t)request};
    gb_card_options_init(&study->options);
    bool good =
        gb_options_scene(&preset, words, request->sets, GB_OPTIONS_PRESET_NEEDED, err) &&
        take_options(&study->options, request, gb_preset_params(preset), err);
    if (good) {
        gb_progress_catch_signals(GB_SIGNALS_HANGUP_ENDS);
        good = gb_card_run(study, gb_preset_params(preset), request->jobs, &callbacks,
                           err) &&
               gb_card_page_write(study, gb_preset_params(preset), command, request->out,
                                  err);
    }
    if (good) {
        print_result(study, request->out);
    }
    gb_preset_destroy(preset);
    g_free(study);
    return good;
}

static const struct gb_options_page page = {
    "PRESET --out DIR [group.key=value]...",
    "A Drucker-Prager cap card of the powder for finite elements.  Cells that differ by\n"
    "their seed are pressed.  At several densities, copies are probed in directions of\n"
    "the (p, q) plane, and a yield surface is fitted.  The card is compared with uniaxial\n"
    "and isotropic pressing.",
    "DIR receives card.csv (d, beta, R, p_a, p_b, plastic volumetric strain, E, nu "
    "against\n"
    "density with 95 % intervals), card.inp (*ELASTIC, *CAP PLASTICITY and *CAP "
    "HARDENING\n"
    "for Abaqus), card.html and card.md with the figures.\n\n"
    "  greenbody card p1-set2-9.7nm particles.count=1000 structure.base=\"9 d\" --out "
    "card"};

int gb_cmd_card(int argc, char **argv)
{
    struct gb_card_options defaults;
    gb_card_options_init(&defaults);
    struct request request = {.replicas = defaults.replicas,
                              .directions = defaults.directions,
                              .offset_percent = 100.0 * defaults.offset,
                              .transition = defaults.transition,
                              .flow = defaults.flow};
    struct gb_error err = {0};
    char **words = NULL;
    int status = 0;
    const GOptionEntry entries[] = {
        gb_options_set(&request.sets),
        {"out", 'o', 0, G_OPTION_ARG_FILENAME, &request.out, "directory of the card",
         "DIR"},
        {"densities", 0, 0, G_OPTION_ARG_STRING, &request.densities,
         "relative densities of the compacts (default: 6, evenly up to that at --pressure)",
         "A,B,..."},
        {"pressure", 0, 0, G_OPTION_ARG_DOUBLE, &request.pressure_mpa,
         "mean pressure of the densest compact, MPa (default: half of loading.until)",
         "MPA"},
        {"compacts", 0, 0, G_OPTION_ARG_STRING, &request.compacts,
         "how compacts are pressed: uniaxial (default), as in a die, or isotropic",
         "PATH"},
        {"replicas", 0, 0, G_OPTION_ARG_INT, &request.replicas,
         "cells, 3 or more (default: 8)", "N"},
        {"directions", 0, 0, G_OPTION_ARG_INT, &request.directions,
         "probes of each compact (default: 19)", "N"},
        {"offset", 0, 0, G_OPTION_ARG_DOUBLE, &request.offset_percent,
         "plastic strain at yield, % (default: 1)", "PERCENT"},
        {"transition", 0, 0, G_OPTION_ARG_DOUBLE, &request.transition,
         "parameter a of the transition surface, 0.01 to 0.05 (default: 0.03)", "A"},
        {"flow", 0, 0, G_OPTION_ARG_DOUBLE, &request.flow,
         "weight of the flow directions relative to the positions (default: 1)",
         "WEIGHT"},
        {"jobs", 'j', 0, G_OPTION_ARG_INT, &request.jobs,
         "cells at once (one per processor)", "N"},
        gb_options_quiet(&request.quiet),
        {0}};
    char *command = g_strjoinv(" ", argv);
    char *line = g_strdup_printf("greenbody %s", command);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status) &&
        !perform(&request, words, line, &err)) {
        gb_options_fail(&err);
        status = gb_progress_exit_status(&err);
    }
    g_free(command);
    g_free(line);
    g_strfreev(words);
    g_strfreev(request.sets);
    g_free(request.out);
    g_free(request.densities);
    g_free(request.compacts);
    return status;
}
