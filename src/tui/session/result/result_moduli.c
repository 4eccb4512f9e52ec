#include "tui/session/result/result_fills.h"

#include <math.h>

#include "scene/tolerances.h"
#include "tui/session/session.h"

static double value_of(const struct gb_moduli_state *state, const char *column)
{
    return gb_moduli_states_mean(state, gb_moduli_table_find(column));
}

/* Where a linear law is wrong. */
static void add_range(struct gb_result_card *card, const struct gb_moduli_state *state)
{
    const double range = value_of(state, "elastic_range");
    const double probe = value_of(state, "probe_strain");
    if (range >= GB_PROBE_RANGE_MAX) {
        gb_result_card_add(card, GB_RESULT_NOTE, "probe %.0e, elastic beyond %.1e", probe,
                           range);
    } else if (range < probe) {
        gb_result_card_add(card, GB_RESULT_WARNING,
                           "probe %.0e, elastic to %.1e only: contacts open or slide",
                           probe, range);
    } else {
        gb_result_card_add(card, GB_RESULT_NOTE, "probe %.0e, elastic to %.1e", probe,
                           range);
    }
}

bool gb_result_moduli_fill(struct gb_result_card *card, const struct gb_session *session)
{
    const GArray *states = session->moduli.states;
    if (states == NULL || states->len == 0) {
        return false;
    }
    const struct gb_moduli_state *last =
        &g_array_index(states, struct gb_moduli_state, states->len - 1);
    gb_result_card_add(card, GB_RESULT_NOTE,
                       "%u state%s: density %.4f, %.4g MPa", states->len,
                       states->len == 1 ? "" : "s, the last",
                       value_of(last, "density"), value_of(last, "p_MPa"));
    if (isfinite(value_of(last, "K_GPa"))) {
        gb_result_card_add(card, GB_RESULT_VALUE,
                           "E %.4g GPa, K %.4g GPa, G %.4g GPa, nu %.3f",
                           value_of(last, "E_GPa"), value_of(last, "K_GPa"),
                           value_of(last, "G_GPa"), value_of(last, "nu"));
    }
    gb_result_card_add(card, GB_RESULT_VALUE,
                       "C11 %.4g, C33 %.4g, C44 %.4g, C12 %.4g, C13 %.4g GPa",
                       value_of(last, "axial_C11_GPa"), value_of(last, "axial_C33_GPa"),
                       value_of(last, "axial_C44_GPa"), value_of(last, "axial_C12_GPa"),
                       value_of(last, "axial_C13_GPa"));
    add_range(card, last);
    gb_result_card_add(card, GB_RESULT_NOTE,
                       "one cell, no interval: that needs replicas (R, then greenbody "
                       "moduli)");
    if (card->path == NULL) {
        card->path =
            g_build_filename(session->moduli.directory, GB_MODULI_STATES_FILE, NULL);
    }
    return true;
}
