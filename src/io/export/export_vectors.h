#ifndef GB_IO_EXPORT_EXPORT_VECTORS_H
#define GB_IO_EXPORT_EXPORT_VECTORS_H

#include "io/export/export.h"

/* Velocities, angular velocities, resultant forces and torques of the particles, as far as
 * a state has them. */
enum gb_export_vector_kind {
    GB_EXPORT_VECTOR_VELOCITY,
    GB_EXPORT_VECTOR_SPIN,
    GB_EXPORT_VECTOR_FORCE,
    GB_EXPORT_VECTOR_TORQUE,
    GB_EXPORT_VECTORS
};

struct gb_export_vector {
    const char *csv, *lammps, *extxyz, *vtk; /* names of the columns */
    const char *unit;
    const double *data; /* count x 3; NULL: the state has none */
    double factor;      /* to m/s, 1/ns, nN and nN nm */
    double nano;        /* to the units nano of LAMMPS: nm/ns, 1/ns, pN, pN nm */
};

/* All four, in the order of the kinds. */
void gb_export_vectors_list(const struct gb_export_frame *frame,
                            struct gb_export_vector vectors[GB_EXPORT_VECTORS]);

/* The columns of a particle behind the others of its line: `between` before each. */
void gb_export_vectors_append(GString *text,
                              const struct gb_export_vector vectors[GB_EXPORT_VECTORS],
                              bool nano, int64_t particle, char between);

#endif
