#ifndef GB_IO_LAB_LAB_QUANTITY_H
#define GB_IO_LAB_LAB_QUANTITY_H

#include <stdbool.h>

/* Measured quantities of a compaction, by the columns of a table. */
enum gb_lab_quantity {
    GB_LAB_QUANTITY_DENSITY,       /* relative */
    GB_LAB_QUANTITY_LATERAL_RATIO, /* pressure across over pressure along the axis, px/pz */
    GB_LAB_QUANTITY_COORDINATION, /* mean number of contacts of a particle */
    /* secant of unloading from p to p/2: (p/2) / ln(density at p / density at p/2), GPa;
     * with fixed side walls the constrained modulus */
    GB_LAB_QUANTITY_UNLOADING_MODULUS,
    GB_LAB_QUANTITIES
};

struct gb_lab_quantity_row {
    const char *name, *error; /* columns */
    const char *label;        /* for people */
    double least, most;       /* accepted between them */
};

extern const struct gb_lab_quantity_row gb_lab_quantity_rows[GB_LAB_QUANTITIES];

/* Is this a column of one of them beside the density, of its error, or "weight"? */
bool gb_lab_quantity_is_further(const char *name);

/* Columns of which a file of this program has two, NULL at the end. */
extern const char *const gb_lab_quantity_columns[];

#endif
