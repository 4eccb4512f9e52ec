#ifndef GB_STUDY_LAW_TABLE_H
#define GB_STUDY_LAW_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "scene/contact_pair.h"
#include "scene/model.h"

/* Nearest neighbours and volume per particle (in r^3) of a lattice. */
struct gb_law_table_lattice {
    const char *name;
    double neighbours;
    double volume;
};

/* Arguments of a law. */
struct gb_law_table_input {
    const struct gb_model *model;       /* of laws in reduced units */
    const struct gb_contact_pair *pair; /* of laws of a pair, in SI */
    const struct gb_law_table_lattice *lattice;
    double x;     /* h or r, in diameters; h of a pair in m */
    double h_min; /* of a bridge; NaN: the deepest allowed */
};

enum { GB_LAW_TABLE_COLUMNS = 4 };

struct gb_law_table_law {
    const char *name;
    const char *doc;      /* in the help; lines end with '\n' */
    const char *header;   /* of its columns, with commas between */
    const char *variable; /* "h", "r", "h_m", or NULL: one row without a variable */
    bool pair;            /* two bodies of any size and material, SI; else reduced */
    bool h_min;           /* takes h_min beside h */
    bool bridged;         /* for scenes with bridges only */
    int normal;           /* enum gb_normal of its scenes; any for pairs */
    double low, high;     /* of the variable, in diameters; high is exclusive */
    /* The columns of a row; out has room for GB_LAW_TABLE_COLUMNS. */
    void (*values)(const struct gb_law_table_input *input, double *out);
    /* The same at the next overlap of a contact with a history, which is its deepest
     * overlap so far; NULL: no history. */
    void (*follow)(const struct gb_law_table_input *input, double *deepest, double *out);
};

/* The laws and the lattices, and their numbers. */
const struct gb_law_table_law *gb_law_table_laws(size_t *count);

const struct gb_law_table_lattice *gb_law_table_lattices(size_t *count);

/* By name; NULL for an unknown one. */
const struct gb_law_table_law *gb_law_table_find(const char *name);

const struct gb_law_table_lattice *gb_law_table_find_lattice(const char *name);

/* Number of columns in the header. */
int gb_law_table_columns(const struct gb_law_table_law *law);

/* A request for rows of a law: single points, a range or a path, as texts. */
struct gb_law_table_request {
    const struct gb_law_table_law *law;
    const struct gb_law_table_lattice *lattice; /* of law lattice */
    char **at;                                  /* NULL-terminated "h=0.01" */
    char *range;                                /* "h=0:0.1:101" */
    char *path;                                 /* "0,0.02,-0.01" */
};

/* Takes a row; false with an error ends the request. */
typedef bool gb_law_table_take(const double *value, int columns, void *data,
                               struct gb_error *err);

/* Rows of a path of so many corners. */
size_t gb_law_table_of_path(size_t corners);

/* Checks a request without computing its rows.  Errors: GB_ERR_INPUT with option or key.
 */
bool gb_law_table_check(const struct gb_law_table_request *request,
                        const struct gb_params *params, struct gb_error *err);

/* Computes the rows for one scene.  Errors: those of gb_law_table_check and of take. */
bool gb_law_table_compute(const struct gb_law_table_request *request,
                          const struct gb_params *params, gb_law_table_take *take,
                          void *data, struct gb_error *err);

#endif
