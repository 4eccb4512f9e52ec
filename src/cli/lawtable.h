#ifndef GB_CLI_LAWTABLE_H
#define GB_CLI_LAWTABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "greenbody/model.h"

/* Nearest neighbours and volume per particle (in r^3) of a lattice. */
struct gb_lawtable_lattice {
    const char *name;
    double neighbours;
    double volume;
};

/* What a row is computed from. */
struct gb_lawtable_input {
    const struct gb_model *model;
    const struct gb_lawtable_lattice *lattice;
    double x;     /* h or r */
    double h_min; /* of a bridge; NaN: the deepest allowed */
};

struct gb_lawtable_law {
    const char *name;
    const char *header;
    const char *variable; /* "h", "r", or NULL: one row without a variable */
    bool path;            /* has a history to follow */
    bool h_min;           /* takes h_min beside h */
    bool bridged;         /* makes sense in scenes with bridges only */
    double low, high;     /* of the variable; high is exclusive */
    void (*print)(const struct gb_lawtable_input *input);
};

/* The laws and the lattices, with their numbers. */
const struct gb_lawtable_law *gb_lawtable_laws(size_t *count);
const struct gb_lawtable_lattice *gb_lawtable_lattices(size_t *count);

/* One row of f_n = f_e - f_a: overlap, force, df_n/dh of the active branch, force in nN.
 * h_min is the deepest overlap of the bridge, 0: no bridge. */
void gb_lawtable_print_contact(const struct gb_model *model, double h, double h_min);

#endif
