#ifndef GB_STUDY_CARD_CARD_OPTIONS_H
#define GB_STUDY_CARD_CARD_OPTIONS_H

#include <stdbool.h>

#include "greenbody/status.h"

/* What is measured for a card. */
enum { GB_CARD_LEVELS_MAX = 16, GB_CARD_DIRECTIONS_MAX = 72 };

/* How compacts are pressed, and the paths a card is compared with. */
enum gb_card_path { GB_CARD_UNIAXIAL, GB_CARD_ISOTROPIC, GB_CARD_PATHS };

struct gb_card_path_row {
    const char *name, *leg;
    double direction_from,
        direction_to; /* of the probes of its compacts, rad in (p, q) */
};
extern const struct gb_card_path_row gb_card_options_paths[GB_CARD_PATHS];

/* Errors: GB_ERR_INPUT. */
bool gb_card_options_path(enum gb_card_path *path, const char *name,
                          struct gb_error *err);

struct gb_card_options {
    double density[GB_CARD_LEVELS_MAX]; /* of the compacts, ascending */
    int levels;
    enum gb_card_path path;
    double
        pressure_pa; /* mean pressure to which the scouting run of the first cell goes */
    int replicas;    /* cells, from structure.seed on */
    int directions;  /* of probes, evenly spaced */
    double inside;   /* pressure at which probes begin, over that of the compact */
    double offset;   /* plastic strain at yield */
    double step;     /* strain step of a probe */
    double strain_most;     /* at which a probe is given up */
    double press_tolerance; /* numerics.tolerance of pressing ... */
    double tolerance;       /* ... and of unloading and probes */
    double transition;      /* a of the surface */
    double flow;            /* weight of the directions of flow (measure/cap/cap_fit.h) */
};

void gb_card_options_init(struct gb_card_options *options);
/* Errors: GB_ERR_INPUT naming the option and what is accepted. */
bool gb_card_options_check(const struct gb_card_options *options, struct gb_error *err);

/* Direction of probe `index`, rad. */
double gb_card_options_direction(const struct gb_card_options *options, int index);

#endif
