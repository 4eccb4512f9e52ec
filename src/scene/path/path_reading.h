#ifndef GB_SCENE_PATH_PATH_READING_H
#define GB_SCENE_PATH_PATH_READING_H

#include "scene/path/path.h"
#include "scene/path/path_words.h"

/* A leg that is being read.  The functions take words and fill the leg; on error they fill
 * err with the word and what is accepted there. */
struct gb_path_reading {
    struct gb_path_words words;
    struct gb_leg *leg;
    const struct gb_path *before; /* the legs in front of it */
    int dimension;
    unsigned given; /* bits of the components that the leg has named */
    struct gb_error *err;
};

/* Marks a component as named.  Errors: named before. */
bool gb_path_reading_give(struct gb_path_reading *in, int component);

/* Always false. */
bool gb_path_reading_expected(struct gb_path_reading *in, const char *what);
/* A component that exists in this scene. */
bool gb_path_reading_component(struct gb_path_reading *in, int *component);
/* "0.5" or "= 0.5" */
bool gb_path_reading_number(struct gb_path_reading *in, double *value);
/* "to 50 MPa", "to q/p = 0.8 or 20 %" */
bool gb_path_reading_ends(struct gb_path_reading *in);
/* "between -1 % and 1 %" of a cycle */
bool gb_path_reading_reversals(struct gb_path_reading *in);
/* "z = 50 MPa, x = y = 0.5 z"; own: bits of the components that are meant where none is
 * named. */
bool gb_path_reading_controls(struct gb_path_reading *in, unsigned own);
/* "at z = 50 MPa", or nothing */
bool gb_path_reading_at(struct gb_path_reading *in, unsigned own);

#endif
