#ifndef GB_IO_LAB_LAB_ROLE_H
#define GB_IO_LAB_LAB_ROLE_H

#include <stdbool.h>

#include "greenbody/dimension.h"
#include "io/lab/lab_unit.h"

/* What a column of a laboratory file is read as. */
enum gb_lab_role {
    GB_LAB_ROLE_PRESSURE,
    GB_LAB_ROLE_PRESSURE_ERROR,
    GB_LAB_ROLE_DENSITY,
    GB_LAB_ROLE_DENSITY_ERROR,
    GB_LAB_ROLE_POROSITY,
    GB_LAB_ROLE_FORCE,
    GB_LAB_ROLE_TRAVEL, /* of the punch, or of the machine */
    GB_LAB_ROLE_HEIGHT, /* of the compact in the die */
    GB_LAB_ROLE_BRANCH, /* words: load, unload */
    GB_LAB_ROLE_SERIES, /* words: names of samples */
    GB_LAB_ROLES
};

/* "pressure", "density_error", ... as in --columns. */
const char *gb_lab_role_name(enum gb_lab_role role);
bool gb_lab_role_is_words(enum gb_lab_role role);
/* A density takes a fraction or a mass density; its dimension here is GB_DIM_FRACTION. */
enum gb_dimension gb_lab_role_dimension(enum gb_lab_role role);
bool gb_lab_role_takes(enum gb_lab_role role, const struct gb_lab_unit *unit);

enum { GB_LAB_ROLE_NAME = 96 };

/* The head of a column: its name in lower case, single blanks between words, and its unit:
 * "Druck [MPa]", "p / MPa", "Kraft in kN", "density_percent", "rel. density (%)". */
struct gb_lab_heading {
    char name[GB_LAB_ROLE_NAME];
    const struct gb_lab_unit *unit; /* NULL: none, or unknown */
};

void gb_lab_role_heading(const char *text, struct gb_lab_heading *out);

/* How well a head says that its column has a role: 0 not at all; more for the word alone
 * than for one among others, and more with a unit. */
int gb_lab_role_rank(enum gb_lab_role role, const struct gb_lab_heading *heading);

#endif
