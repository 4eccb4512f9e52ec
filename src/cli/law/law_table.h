#ifndef GB_CLI_LAW_LAW_TABLE_H
#define GB_CLI_LAW_LAW_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "scene/model.h"
#include "scene/contact_pair.h"

/* Nearest neighbours and volume per particle (in r^3) of a lattice. */
struct gb_law_table_lattice {
    const char *name;
    double neighbours;
    double volume;
};

/* What a row is computed from. */
struct gb_law_table_input {
    const struct gb_model *model;       /* of laws in reduced units */
    const struct gb_contact_pair *pair; /* of laws of a pair, in SI */
    const struct gb_law_table_lattice *lattice;
    double x;     /* h or r, in diameters; h of a pair in m */
    double h_min; /* of a bridge; NaN: the deepest allowed */
};

struct gb_law_table_law {
    const char *name;
    const char *header;
    const char *variable; /* "h", "r", "h_m", or NULL: one row without a variable */
    bool pair;            /* two bodies of any size and material, SI; else reduced */
    bool h_min;           /* takes h_min beside h */
    bool bridged;         /* makes sense in scenes with bridges only */
    double low, high;     /* of the variable, in diameters; high is exclusive */
    void (*print)(const struct gb_law_table_input *input);
    /* The same at the next overlap of a contact with a history, whose deepest overlap is
     * carried along; NULL: no history. */
    void (*follow)(const struct gb_law_table_input *input, double *deepest);
};

/* The laws and the lattices, with their numbers. */
const struct gb_law_table_law *gb_law_table_laws(size_t *count);
const struct gb_law_table_lattice *gb_law_table_lattices(size_t *count);

#endif
