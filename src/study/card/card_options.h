#ifndef GB_STUDY_CARD_CARD_OPTIONS_H
#define GB_STUDY_CARD_CARD_OPTIONS_H

#include <stdbool.h>

#include "greenbody/status.h"

/* What is measured for a card. */
enum { GB_CARD_LEVELS_MAX = 16, GB_CARD_DIRECTIONS_MAX = 72 };

struct gb_card_options {
    double density[GB_CARD_LEVELS_MAX]; /* of the compacts, ascending */
    int levels;
    double pressure_pa; /* to which the isotropic scouting run of the first cell goes */
    int replicas;       /* cells, from structure.seed on */
    int directions; /* of probes, evenly spaced from -135 to 135 degrees in (p, q): beyond
                     * it is tension */
    double inside;  /* pressure at which probes begin, over that of the compact */
    double offset;  /* plastic strain at yield */
    double step;    /* strain step of a probe */
    double strain_most; /* at which a probe is given up */
    double tolerance;   /* numerics.tolerance of the cells */
    double transition;  /* a of the surface */
};

void gb_card_options_init(struct gb_card_options *options);
/* Errors: GB_ERR_INPUT naming the option and what is accepted. */
bool gb_card_options_check(const struct gb_card_options *options, struct gb_error *err);

/* Direction of probe `index`, rad. */
double gb_card_options_direction(const struct gb_card_options *options, int index);

#endif
