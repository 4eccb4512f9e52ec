#ifndef GB_FIGURES_REPORT_PACKING_H
#define GB_FIGURES_REPORT_PACKING_H

#include <stdbool.h>

#include "greenbody/params.h"
#include "io/state.h"
#include "measure/structure.h"

/* An initial structure and the quantities measured on it. */
struct gb_packing {
    struct gb_params params;
    struct gb_state *state;
    struct gb_connectivity connectivity;
    double r_eq;  /* of touching particles, d */
    double reach; /* of a contact, d */
    double r_max; /* of g, d */
    int bins;
    double *g;
    double g_end; /* over the last diameter before r_max */
};

/* Writes preset.ini, packing.csv, g.csv, structure.json and state.h5 into a directory
 * that is there; each file atomically.  A bed in a die, whose packing.csv has radii, is
 * without the third and fourth.  Errors: GB_ERR_MACHINE. */
bool gb_packing_write(const struct gb_packing *packing, const char *directory,
                      struct gb_error *err);

#endif
