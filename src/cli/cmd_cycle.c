#include <stdio.h>

#include <glib.h>

#include "base/listing.h"
#include "base/number.h"
#include "base/visible.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "many/die_summary.h"

/* One column per group, one row per figure with its meaning. */
static void print_table(const struct gb_runset *set)
{
    gb_visible_print(stdout, "%-22s", "beds");
    for (size_t g = 0; g < set->groups; g++) {
        gb_visible_print(stdout, "  %-20zu", gb_runset_members(set, g));
    }
    gb_visible_print(stdout, "\n");
    for (const struct gb_die_summary_row *row = gb_die_summary_table(); row->name;
         row++) {
        gb_visible_print(stdout, "%-22s", row->name);
        for (size_t g = 0; g < set->groups; g++) {
            double mean = 0.0, error = 0.0;
            char number[GB_NUMBER_ERROR_MAX];
            gb_die_summary_mean(row, set, g, &mean, &error);
            gb_visible_print(stdout, "  %-20s",
                             gb_number_error(mean, error, 2, " +- ", number));
        }
        gb_visible_print(stdout, "  %s\n", row->doc);
    }
}

static void print_groups(const struct gb_runset *set)
{
    for (size_t g = 0; g < set->groups; g++) {
        char *label = gb_runset_label(set, g);
        gb_visible_print(stdout, "# %zu: %s\n", g + 1,
                         label[0] != '\0' ? label
                                          : gb_runset_first(set, g)->params.title);
        g_free(label);
    }
}

/* One row per group; each figure is followed by its standard error. */
static struct gb_listing *listing_of(const struct gb_runset *set)
{
    const struct gb_die_summary_row *rows = gb_die_summary_table();
    struct gb_listing *listing = gb_listing_new();
    gb_listing_columns(listing, "%.0f", "group,beds");
    for (const struct gb_die_summary_row *row = rows; row->name; row++) {
        gb_listing_columns(listing, "%.6g", row->name);
        gb_listing_column(listing, "%.3g", "%s_se", row->name);
    }
    for (size_t g = 0; g < set->groups; g++) {
        gb_listing_whole(listing, g + 1);
        gb_listing_whole(listing, gb_runset_members(set, g));
        for (const struct gb_die_summary_row *row = rows; row->name; row++) {
            double mean = 0.0, error = 0.0;
            gb_die_summary_mean(row, set, g, &mean, &error);
            gb_listing_number(listing, mean);
            gb_listing_number(listing, error);
        }
    }
    return listing;
}

static bool show(char **words, gboolean csv, struct gb_error *err)
{
    struct gb_runset set = {0};
    GPtrArray *list = g_ptr_array_new_with_free_func(g_free);
    for (size_t i = 0; words[i] != NULL; i++) {
        gb_runset_expand(list, words[i]);
    }
    bool good = list->len > 0 ||
                gb_error_set(err, GB_ERR_INPUT, "cycle takes run directories: DIR...");
    good = good && gb_runset_read(&set, (char *const *)list->pdata, list->len, err) &&
           gb_die_summary_check(&set, err);
    if (good) {
        print_groups(&set);
        if (csv) {
            good =
                gb_options_print(gb_listing_end(listing_of(&set), GB_LISTING_CSV), err);
        } else {
            print_table(&set);
            good =
                (fflush(stdout) == 0 && !ferror(stdout)) || gb_options_output_failed(err);
        }
    }
    gb_runset_finish(&set);
    g_ptr_array_unref(list);
    return good;
}

int gb_cmd_cycle(int argc, char **argv)
{
    static const struct gb_options_page page = {
        "DIR...",
        "Springback, residual radial stress and force of ejection of full die cycles, "
        "with\n"
        "standard errors over beds: runs that differ by their seed only.",
        "Three frictions, three beds each:\n"
        "  greenbody sweep p3-cycle --vary 'contact.mu=0;0.02;0.05' --replicas 3 \\\n"
        "    --out cycles\n"
        "  greenbody cycle cycles",
    };
    gboolean csv = FALSE;
    const GOptionEntry entries[] = {
        {"csv", 0, 0, G_OPTION_ARG_NONE, &csv, "one row per group of beds, as CSV", NULL},
        {0},
    };
    char **words = NULL;
    int status = 0;
    struct gb_error err = {0};
    if (!gb_options_parse(&page, entries, argc, argv, &words, &status)) {
        return status;
    }
    if (!show(words, csv, &err)) {
        status = gb_options_fail(&err);
    }
    g_strfreev(words);
    return status;
}
