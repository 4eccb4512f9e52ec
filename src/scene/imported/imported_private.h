#ifndef GB_SCENE_IMPORTED_PRIVATE_H
#define GB_SCENE_IMPORTED_PRIVATE_H

#include <glib.h>

#include "scene/imported/imported.h"

/* What a file holds, as it stands there. */
struct gb_imported_raw {
    GArray *position; /* double, 3 a particle */
    GArray *diameter; /* double, in the unit of the positions */
    bool cell;        /* low and edges are known */
    double low[3], edges[3];
    double tilts[3]; /* xy, xz, yz */
    double unit_m;   /* unit of length; NaN: not said */
    bool reduced;    /* lengths are in d already, and unit_m is d */
};

/* Lines of a text, one after the other; each is cut off and trimmed in place. */
struct gb_imported_lines {
    const char *path;
    char *next; /* NULL at the end */
    int number; /* of the line that was read last, from 1 */
};

/* The next line; NULL at the end. */
char *gb_imported_lines_next(struct gb_imported_lines *lines);

/* "path:line: " and the text. */
bool gb_imported_lines_refuse(const struct gb_imported_lines *lines, struct gb_error *err,
                              const char *format, ...) G_GNUC_PRINTF(3, 4);

/* A finite number with a decimal point in any locale; what: its name for the message. */
bool gb_imported_lines_number(const struct gb_imported_lines *lines, const char *text,
                              const char *what, double *number, struct gb_error *err);

/* Takes the edge vectors of a cell, nine numbers with a vector a row: the first has to lie
 * along x and the second in the plane xy.  False: they do not, and *why says it. */
bool gb_imported_lines_vectors(struct gb_imported_raw *raw, const double rows[9],
                               const char **why);

/* Metres of a unit of length as its name ("nm", "um") or a style of units of LAMMPS
 * ("nano", "si") says; NaN: neither. */
double gb_imported_lines_unit(const char *name);

/* What the columns of a table are. */
struct gb_imported_columns {
    int position[3], size; /* indices */
    bool radius;           /* the size is a radius */
    double unit_m;
    bool reduced; /* lengths in d */
};

/* Finds the columns by name.  False: one is missing, and *missing is its name. */
bool gb_imported_columns_find(struct gb_imported_columns *columns, char *const *names,
                              const char **missing);

/* Adds the particle of a row of `count` words. */
bool gb_imported_columns_add_row(struct gb_imported_raw *raw,
                                 const struct gb_imported_lines *lines,
                                 const struct gb_imported_columns *columns,
                                 char *const *words, int count, struct gb_error *err);

/* A number of particles, with or without words behind it. */
bool gb_imported_columns_count(const struct gb_imported_lines *lines, const char *text,
                               int64_t *count, struct gb_error *err);

/* The next `count` lines, words separated by blanks, in place of what raw holds. */
bool gb_imported_columns_read_rows(struct gb_imported_lines *lines,
                                   struct gb_imported_raw *raw,
                                   const struct gb_imported_columns *columns,
                                   int64_t count, struct gb_error *err);

/* The formats.  recognise: is the text of this kind?  read: the whole of it. */
struct gb_imported_format {
    const char *name;
    bool (*recognise)(const char *text);
    bool (*read)(struct gb_imported_lines *lines, struct gb_imported_raw *raw,
                 struct gb_error *err);
};
extern const struct gb_imported_format gb_imported_extxyz, gb_imported_lammps_dump,
    gb_imported_lammps_data, gb_imported_table;

/* The one format that is no text. */
bool gb_imported_vtkhdf_read(const char *path, struct gb_imported_raw *raw,
                             struct gb_error *err);

/* Reduces what a file holds to lengths in d. */
bool gb_imported_reduce(struct gb_imported *packing, const struct gb_imported_raw *raw,
                        const char *path, struct gb_error *err);

#endif
