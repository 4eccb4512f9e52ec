#ifndef GB_IO_LAB_LAB_UNIT_H
#define GB_IO_LAB_LAB_UNIT_H

#include "greenbody/dimension.h"

/* A unit as laboratories write it in the head of a column. */
struct gb_lab_unit {
    const char *name;            /* as typed in --columns */
    enum gb_dimension dimension; /* GB_DIM_NONE: known, but of no quantity read here */
    double si;                   /* 1 of it in SI */
};

/* "g/cm3", "g/cm^3", "g cm-3" with superscripts are one; MPa may be written mpa, but mPa is
 * no unit of a pressure here.  NULL: unknown. */
const struct gb_lab_unit *gb_lab_unit_find(const char *text);

/* The names of a dimension, for messages. */
const char *gb_lab_unit_accepted(enum gb_dimension dimension);

#endif
