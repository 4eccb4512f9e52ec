#include "pack/cell/record_checks.h"

#include <math.h>

bool gb_record_checks_out_of_range(const char *name, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s: is out of range", name);
}

bool gb_record_checks_history(const struct gb_contact_history *history, int64_t count,
                              const char *name, struct gb_error *err)
{
    for (int64_t k = 0; k < history->count; k++) {
        const int32_t i = history->pair[k][0], j = history->pair[k][1];
        const bool ascends =
            k == 0 || history->pair[k - 1][0] < i ||
            (history->pair[k - 1][0] == i && history->pair[k - 1][1] < j);
        if (i < 0 || j <= i || j >= count || !ascends) {
            return gb_record_checks_out_of_range(name, err);
        }
    }
    return true;
}

bool gb_record_checks_edges(const struct gb_cell *cell, const char *name,
                            struct gb_error *err)
{
    for (int k = 0; k < 3; k++) {
        if (!(cell->edge[k] > 0.0 && cell->edge[k] < 1e9)) {
            return gb_record_checks_out_of_range(name, err);
        }
    }
    /* folded at every list build, so that it exceeds half an edge by little */
    const double most[3] = {cell->edge[0], cell->edge[0], cell->edge[1]};
    for (int k = 0; k < 3; k++) {
        if (!(fabs(cell->tilt[k]) <= most[k])) {
            return gb_record_checks_out_of_range(name, err);
        }
    }
    return true;
}

bool gb_record_checks_inside(const struct gb_cell *cell, const double *position,
                             int64_t count, double margin, const char *name,
                             struct gb_error *err)
{
    const double rounding = gb_cell_tilted(cell) ? 1e-9 : 0.0;
    for (int64_t i = 0; i < count; i++) {
        double fraction[3];
        gb_cell_fraction(cell, position + 3 * i, fraction);
        for (int k = 0; k < 3; k++) {
            const double allowed = cell->periodic[k] ? margin + rounding : 1e6;
            if (!(fraction[k] >= -allowed && fraction[k] <= 1.0 + allowed)) {
                return gb_record_checks_out_of_range(name, err);
            }
        }
    }
    return true;
}
