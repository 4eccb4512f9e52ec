#ifndef GB_IO_EXPORT_EXPORT_H
#define GB_IO_EXPORT_EXPORT_H

#include <stdbool.h>
#include <stddef.h>

#include <glib.h>

#include "io/state/state_gaps.h"

/* States as files of other programs.  Lengths in nm, forces in nN, stresses in MPa, positive
 * in compression unless a format says otherwise; the file names its units and the run. */
/* A state in the units of a file. */
struct gb_export_frame {
    const struct gb_state *state;
    struct gb_state_gaps gaps; /* pairs that follow the contacts */
    double density_kg_m3;      /* of the solid; NaN: unknown */
    int64_t index;             /* of the frame, from 0 */
    double *stress;            /* count x 6, Pa: xx, yy, zz, xy, xz, yz */
    double nm;                 /* of a reduced length */
    double nn;                 /* of a reduced force */
    double ns;                 /* of a reduced time; NaN: not known */
};

struct gb_export_format {
    const char *name, *doc;
    const char *contacts; /* the format of its contacts: a name, or the end of one */
    bool trajectory;      /* several states in one file; else in numbered ones, see
                      * io/export/export_series.h */
    /* Appends a frame; contacts NULL: none are wanted. */
    void (*write)(const struct gb_export_frame *frame, GString *particles,
                  GString *contacts);
    /* Instead of write: whole binary files.  Errors: GB_ERR_MEMORY. */
    bool (*write_binary)(const struct gb_export_frame *frame, GString *particles,
                         GString *contacts, struct gb_error *err);
};

/* By name; NULL and err, which lists the names. */
const struct gb_export_format *gb_export_find(const char *name, struct gb_error *err);
/* Row by row; NULL behind the last. */
const struct gb_export_format *gb_export_at(size_t index);

/* Appends a state to the texts of a format.  Errors: of gb_state_gaps_init. */
bool gb_export_add(const struct gb_export_format *format, const struct gb_state *state,
                   double density_kg_m3, int64_t index, GString *particles,
                   GString *contacts, struct gb_error *err);

#endif
