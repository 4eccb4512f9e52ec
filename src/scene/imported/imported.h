#ifndef GB_SCENE_IMPORTED_H
#define GB_SCENE_IMPORTED_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/params.h"

/* A packing read from a file (structure.from), in a periodic cell of edge vectors
 * (Lx, 0, 0), (xy, Ly, 0), (xz, yz, Lz).  Lengths are in d, the mean diameter of its particles by number. */
struct gb_imported {
    int64_t count;
    double edges[3];       /* Lx, Ly, Lz */
    double tilts[3];       /* xy, xz, yz, at most half an edge */
    double *position;      /* count x 3, inside the cell; y = 0 if planar */
    double *diameter;      /* count */
    bool one_size;         /* all diameters are 1 */
    bool planar;           /* all y are equal: discs; edges[1] is 1 then */
    double least, largest; /* diameter */
    double moment[4];      /* means of diameter^k; moment[1] is 1 */
    double unit_m;         /* d; NaN: the file does not say */
    uint64_t sum;          /* checksum of all the above */
};

/* Reads a file: extended XYZ, a dump or a data file of LAMMPS, VTKHDF, or a table with
 * named columns, recognised by content (docs/import.md).  The packing lives as long as the
 * process, one for each checksum; thread-safe.
 *
 * Errors: GB_ERR_INPUT "path:line: what was read, what is expected"; GB_ERR_MACHINE;
 * GB_ERR_MEMORY. */
const struct gb_imported *gb_imported_load(const char *path, struct gb_error *err);

/* The packing of structure.from; NULL without one, and with err if its file has been
 * removed or changed. */
const struct gb_imported *gb_imported_of(const struct gb_params *params,
                                         struct gb_error *err);

/* Are the particles those of a file? */
bool gb_imported_given(const struct gb_params *params);

/* Makes the parameters those of a packing: its count, its diameter if the file says it,
 * and no distribution. */
void gb_imported_take(struct gb_params *params, const char *path,
                      const struct gb_imported *packing);

/* Relations of a packing to the other parameters.  Errors: GB_ERR_INPUT. */
bool gb_imported_check_params(const struct gb_params *params, struct gb_error *err);

/* Is a tilt of the cell not 0? */
bool gb_imported_tilted(const struct gb_imported *packing);

/* Distance of the two faces that edge vector k leads across. */
double gb_imported_spacing(const struct gb_imported *packing, int k);

/* Volume of the particles (their area in 2D) over that of the cell. */
double gb_imported_density(const struct gb_imported *packing);

/* The packing as a table that gb_imported_load reads to the same bits.  g_free. */
char *gb_imported_text(const struct gb_imported *packing);

#endif
