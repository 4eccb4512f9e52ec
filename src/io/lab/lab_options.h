#ifndef GB_IO_LAB_LAB_OPTIONS_H
#define GB_IO_LAB_LAB_OPTIONS_H

#include <glib.h>
#include <stdbool.h>

#include "greenbody/status.h"
#include "io/lab/lab_role.h"

/* What is said about a laboratory file, by options of a command or in one line of the
 * workbench:
 *
 *   pressure=2:MPa,density="rel. Dichte":%,decimal=comma
 *
 * An item is a quantity with its column (a number from 1, or its head, quoted where it has
 * a comma, a colon or only digits) and unit, or one of the keys below. */
enum { GB_LAB_OPTIONS_NAME = 96, GB_LAB_OPTIONS_KEYS = 8 };

struct gb_lab_options_column {
    bool given;
    int index;                      /* from 1; 0: by name */
    char name[GB_LAB_OPTIONS_NAME]; /* its head */
    const struct gb_lab_unit *unit; /* NULL: that of the head */
};

/* A further column, of a key of a preset or of another quantity: particles.diameter_nm=5,
 * lateral_ratio=6. */
struct gb_lab_options_key {
    char key[GB_LAB_OPTIONS_NAME];
    struct gb_lab_options_column column;
};

struct gb_lab_options {
    struct gb_lab_options_column column[GB_LAB_ROLES];
    struct gb_lab_options_key key[GB_LAB_OPTIONS_KEYS];
    int keys;
    char decimal;              /* '.' or ','; 0: not given */
    char separator;            /* of cells; ' ': blanks and tabs; 0: not given */
    double die_area_m2;        /* the numbers: NaN: not given */
    double powder_mass_kg;     /* in the die */
    double true_density_kg_m3; /* of the solid */
    double compliance_m_n;     /* of machine and punches */
    double initial_height_m;   /* of the powder at travel 0 */
    double zero_travel_m; /* travel at which the punches touch without powder or force */
};

void gb_lab_options_init(struct gb_lab_options *options);
bool gb_lab_options_given(const struct gb_lab_options *options);

/* One key: decimal (comma, point), separator (comma, semicolon, tab, blank, bar, or the
 * character), die-area, powder-mass, true-density, compliance, initial-height,
 * zero-travel.  Errors: GB_ERR_INPUT. */
bool gb_lab_options_set(struct gb_lab_options *options, const char *key,
                        const char *value, struct gb_error *err);

/* A list of items as above; a later one replaces an earlier one. */
bool gb_lab_options_parse(struct gb_lab_options *options, const char *list,
                          struct gb_error *err);

/* The list that says the same; g_free. */
char *gb_lab_options_text(const struct gb_lab_options *options);

#endif
