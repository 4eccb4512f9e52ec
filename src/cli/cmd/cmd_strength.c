#include <glib.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/text/visible.h"
#include "cli/commands.h"
#include "cli/compact_options.h"
#include "cli/options.h"
#include "cli/signals.h"
#include "study/compact/study_text.h"
#include "study/strength/strength.h"

static void print_summary(const struct gb_strength_study *study)
{
    gb_visible_put(
        stdout,
        "pressed to  test         strength MPa        strain %  Weibull modulus\n");
    for (guint i = 0; i < study->result->len; i++) {
        const struct gb_strength_result *r =
            &g_array_index(study->result, struct gb_strength_result, i);
        const struct gb_fit_value modulus = {.value = r->weibull.modulus,
                                             .low = r->weibull.modulus_low,
                                             .high = r->weibull.modulus_high};
        char strength[GB_NUMBER_ERROR_MAX], strain[GB_NUMBER_MAX];
        GString *weibull = g_string_new(NULL);
        gb_study_text_interval(weibull, "", "%.3g", &modulus, 1.0);
        gb_number_error(1e-6 * r->strength_pa, 1e-6 * r->strength_error_pa, 2, " +- ",
                        strength);
        gb_visible_print(stdout, "%7g %-3s  %-11s  %17s  %8s  %s\n",
                         r->mark.by_density ? r->mark.value : 1e-6 * r->mark.value,
                         r->mark.by_density ? "" : "MPa", gb_strength_tests[r->test].name,
                         strength, gb_number_shown("%.3g", 100.0 * r->strain, strain),
                         weibull->str);
        g_string_free(weibull, TRUE);
    }
}

static bool conclude(struct gb_compact_options *common,
                     const struct gb_strength_study *study, struct gb_error *err)
{
    if (!gb_compact_options_keep_preset(common, err) ||
        !gb_strength_write(study, common->directory,
                           gb_preset_params(common->preset)->title, common->command,
                           err)) {
        return false;
    }
    print_summary(study);
    return study->failed == 0 ||
           gb_error_set(err, study->why.code, "%s", study->why.text);
}

static bool perform(struct gb_compact_options *common, char **words, char **sets,
                    struct gb_error *err)
{
    struct gb_strength_study study = {0};
    struct gb_strength_options options;
    gb_strength_options_init(&options);
    options.replicas = common->replicas;
    const bool good =
        gb_compact_options_begin(common, words, sets, &options.marks, err) &&
        gb_strength_run(&study, gb_preset_params(common->preset), &options,
                        common->directory, common->jobs, &common->callbacks, err) &&
        conclude(common, &study, err);
    gb_strength_finish(&study);
    return good;
}

int gb_cmd_strength(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "PRESET [group.key=value]...",
        "Strength of compacts after unloading.  Cells are pressed as in the preset, all\n"
        "stresses are taken away, and copies are stretched and compressed along z at\n"
        "p_x = p_y = 0, and sheared along xz at p_z = 0, to beyond the largest stress.",
        "DIR receives strength.csv (largest stress, strain, bridges broken, Weibull\n"
        "modulus), strength_curves.csv, strength.md and scene.ini.  cells/ keeps what is\n"
        "measured: repeated, the command continues."};
    struct gb_compact_options common = {.replicas = 8};
    struct gb_error err = {0};
    char **sets = NULL, **words = NULL;
    int status = 0;
    GOptionEntry entries[GB_COMPACT_OPTIONS_ENTRIES + 2] = {0};
    gb_compact_options_entries(&common, entries);
    entries[GB_COMPACT_OPTIONS_ENTRIES] = gb_options_set(&sets);
    common.command = gb_options_command("", argc, argv);
    if (gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        status = perform(&common, words, sets, &err) ? 0 : gb_options_fail(&err);
        status = err.code == GB_ERR_CANCELLED ? gb_signals_exit_status(&err) : status;
    }
    gb_compact_options_finish(&common);
    g_strfreev(words);
    g_strfreev(sets);
    return status;
}
