#include "figures/figures_compute.h"

#include <math.h>

#include "base/number.h"
#include "figures/figures_label.h"
#include "figures/packings/state_set.h"

/* 0, 1, ... contacts; the last one holds those with more, too. */
enum { CONTACTS = 16 };

/* Numbers of contacts whose share P1 gives, section V: 0.5 and 0.3 %, and none. */
static const int published[] = {10, 12};

/* Share of particles with each number of contacts, %. */
static void share_contacts(const struct gb_state *state, double *share)
{
    int64_t count[CONTACTS] = {0};
    for (int64_t i = 0; i < state->count; i++) {
        count[MIN(state->contacts[i], CONTACTS - 1)]++;
    }
    for (int k = 0; k < CONTACTS; k++) {
        share[k] = 100.0 * (double)count[k] / (double)state->count;
    }
}

/* Groups whose share the caption gives. */
enum { CAPTION_GROUPS = 4 };

static void caption_share(struct gb_series *series, const struct gb_runset *set,
                          size_t group, GString *share)
{
    char *label = set->groups > 1 ? gb_figures_label(set, group, NULL) : NULL;
    g_string_replace(share, "+-", "\xc2\xb1", 0);
    gb_series_caption(series, "%d contacts%s%s: %s %%.", published[0],
                      label != NULL ? ", " : "", label != NULL ? label : "", share->str);
    g_free(label);
}

/* Columns of the means follow that of the number of contacts, two to a group. */
static void note_published(struct gb_series *series, const struct gb_runset *set)
{
    for (size_t g = 0; g < set->groups; g++) {
        const double *mean = g_ptr_array_index(series->columns, 1 + 2 * g);
        const double *error = g_ptr_array_index(series->columns, 2 + 2 * g);
        for (size_t k = 0; k < G_N_ELEMENTS(published); k++) {
            const int contacts = published[k];
            char number[GB_NUMBER_ERROR_MAX];
            GString *text = g_string_new(
                gb_number_error(mean[contacts], error[contacts], 1, " +- ", number));
            gb_series_note(series, "group %zu: %d contacts: %s %%", g + 1, contacts,
                           text->str);
            if (k == 0 && set->groups <= CAPTION_GROUPS) {
                caption_share(series, set, g, text);
            }
            g_string_free(text, TRUE);
        }
    }
}

static void join_points(struct gb_series *series)
{
    for (guint k = 0; k < series->curves->len; k++) {
        g_array_index(series->curves, struct gb_series_curve, k).kind = GB_FIGURE_BOTH;
    }
}

/* P1 section V, after Fig. 8. */
bool gb_figures_contacts(struct gb_series *series, const struct gb_figures_input *input,
                         struct gb_error *err)
{
    const struct gb_runset *set = input->set;
    struct gb_state_set states;
    if (!gb_state_set_read(&states, input, err)) {
        return false;
    }
    gb_series_init(series, CONTACTS);
    double *rows = g_new(double, set->count * series->rows);
    double *contacts = gb_series_column(series, "contacts");
    for (int k = 0; k < CONTACTS; k++) {
        contacts[k] = k;
    }
    for (size_t i = 0; i < set->count; i++) {
        share_contacts(states.state[i], rows + i * series->rows);
    }
    gb_figures_label_note(series, set);
    gb_state_set_means(series, set, rows, contacts, "share_percent");
    note_published(series, set);
    join_points(series);
    gb_state_set_caption(series, &states);
    series->x.low = series->y.low = 0.0;
    series->x.high = CONTACTS - 1;
    g_free(rows);
    gb_state_set_finish(&states);
    return true;
}
