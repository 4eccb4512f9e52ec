#include "run/moduli/moduli_states.h"

#include <math.h>

#include "base/table.h"

enum { COLUMNS = GB_MODULI_TABLE_COLUMNS };

void gb_moduli_states_add(struct gb_moduli_state *state,
                          const struct gb_moduli_table_row *row)
{
    state->count++;
    state->range_open = state->range_open || row->range_open;
    for (int k = 0; k < COLUMNS; k++) {
        state->sum[k] += row->value[k];
        state->squares[k] += row->value[k] * row->value[k];
    }
    for (int k = 0; k < 36; k++) {
        state->c_gpa[k / 6][k % 6] += row->c_gpa[k / 6][k % 6];
    }
}

double gb_moduli_states_mean(const struct gb_moduli_state *state, int column)
{
    return state->sum[column] / state->count;
}

double gb_moduli_states_error(const struct gb_moduli_state *state, int column)
{
    const double n = state->count, mean = gb_moduli_states_mean(state, column);
    const double variance = (state->squares[column] - n * mean * mean) / (n - 1.0);
    return n > 1.0 ? sqrt(fmax(variance, 0.0) / n) : (double)NAN;
}

static const struct gb_moduli_state *state_at(const GArray *states, guint k)
{
    return &g_array_index(states, struct gb_moduli_state, k);
}

struct gb_listing *gb_moduli_states_listing(const GArray *states, const char *comment)
{
    bool errors = false;
    for (guint s = 0; s < states->len; s++) {
        errors = errors || state_at(states, s)->count + state_at(states, s)->missing > 1;
    }
    struct gb_listing *listing = gb_listing_new();
    gb_listing_comment(listing, comment);
    for (int k = 0; k < COLUMNS; k++) {
        gb_listing_columns(listing, "%.10g", gb_moduli_table_name(k));
    }
    gb_listing_columns(listing, "%.10g", errors ? "replicas,missing" : "replicas");
    for (int k = 0; k < COLUMNS && errors; k++) {
        gb_listing_column(listing, "%.10g", "error_%s", gb_moduli_table_name(k));
    }
    for (guint s = 0; s < states->len; s++) {
        const struct gb_moduli_state *state = state_at(states, s);
        for (int k = 0; k < COLUMNS; k++) {
            gb_listing_number(listing, gb_moduli_states_mean(state, k));
        }
        gb_listing_number(listing, state->count);
        if (errors) {
            gb_listing_number(listing, state->missing);
        }
        for (int k = 0; k < COLUMNS && errors; k++) {
            gb_listing_number(listing, gb_moduli_states_error(state, k));
        }
    }
    return listing;
}

static bool read_columns(const struct gb_table *table, const double *column[COLUMNS],
                         struct gb_error *err)
{
    const double *replicas = gb_table_column(table, "replicas", err);
    for (int k = 0; k < COLUMNS && replicas != NULL; k++) {
        column[k] = gb_table_column(table, gb_moduli_table_name(k), err);
        if (column[k] == NULL) {
            return false;
        }
    }
    for (size_t row = 0; replicas != NULL && row < gb_table_rows(table); row++) {
        if (replicas[row] != 1.0) {
            return gb_error_set(err, GB_ERR_INPUT,
                                "%s:%d: replicas %g: a table of one run has 1; choose "
                                "another directory",
                                gb_table_path(table), gb_table_line(table, row),
                                replicas[row]);
        }
    }
    return replicas != NULL;
}

bool gb_moduli_states_read(GArray *states, const char *path, struct gb_error *err)
{
    struct gb_table *table = NULL;
    const double *column[COLUMNS];
    const bool good =
        gb_table_read(&table, path, NULL, err) && read_columns(table, column, err);
    for (size_t row = 0; good && row < gb_table_rows(table); row++) {
        struct gb_moduli_state state = {.count = 1};
        for (int k = 0; k < COLUMNS; k++) {
            state.sum[k] = column[k][row];
            state.squares[k] = column[k][row] * column[k][row];
        }
        g_array_append_val(states, state);
    }
    gb_table_destroy(table);
    return good;
}

static double step_of(const struct gb_moduli_state *state)
{
    return gb_moduli_states_mean(state, gb_moduli_table_find("step"));
}

bool gb_moduli_states_has(const GArray *states, int64_t step)
{
    for (guint k = 0; k < states->len; k++) {
        if (step_of(state_at(states, k)) == (double)step) {
            return true;
        }
    }
    return false;
}

static int by_step(const void *a, const void *b)
{
    const double x = step_of(a), y = step_of(b);
    return (x > y) - (x < y);
}

void gb_moduli_states_sort(GArray *states)
{
    g_array_sort(states, by_step);
}
