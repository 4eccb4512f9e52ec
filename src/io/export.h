#ifndef GB_IO_EXPORT_H
#define GB_IO_EXPORT_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "io/state_forces.h"

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
                      * io/export.h */
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

/* Appends a state to the texts of a format.  Errors: of gb_state_forces_gaps_init. */
bool gb_export_add(const struct gb_export_format *format, const struct gb_state *state,
                   double density_kg_m3, int64_t index, GString *particles,
                   GString *contacts, struct gb_error *err);

/* The writers of the table of formats; see gb_export_format. */
void gb_export_extxyz_write(const struct gb_export_frame *frame, GString *particles,
                            GString *contacts);

void gb_export_lammps_dump(const struct gb_export_frame *frame, GString *particles,
                           GString *contacts);

void gb_export_lammps_data(const struct gb_export_frame *frame, GString *particles,
                           GString *contacts);

/* The table of contacts, for formats without one of their own. */
void gb_export_csv_contacts(const struct gb_export_frame *frame, GString *text);

void gb_export_csv_write(const struct gb_export_frame *frame, GString *particles,
                         GString *contacts);

bool gb_export_vtkhdf_write(const struct gb_export_frame *frame, GString *particles,
                            GString *contacts, struct gb_error *err);

/* The name of a file, from 0; g_free. */
char *gb_export_series_name(const char *path, int64_t index);

/* The name of the list; g_free. */
char *gb_export_series_list_name(const char *path);

/* The list of files with the step of each in place of a time.  Errors: those of
 * gb_file_replace. */
bool gb_export_series_put_list(const char *path, const int64_t *steps, int64_t count,
                               struct gb_error *err);

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
void gb_export_vectors(const struct gb_export_frame *frame,
                       struct gb_export_vector vectors[GB_EXPORT_VECTORS]);

/* The columns of a particle behind the others of its line: `between` before each. */
void gb_export_append_vectors(GString *text,
                              const struct gb_export_vector vectors[GB_EXPORT_VECTORS],
                              bool nano, int64_t particle, char between);

/* A number with the fewest digits that read back the same, '.' in every locale, and a
 * character behind it; '\0': none. */
void gb_export_text_number(GString *text, double value, char end);

/* Numbers times a factor, a character behind each and another behind the last. */
void gb_export_text_numbers(GString *text, double factor, const double *values, int count,
                            char between, char end);

/* "coordination sxx ... syz" of a particle, MPa. */
void gb_export_text_stress(GString *text, const struct gb_export_frame *frame, int64_t i,
                           char between);

/* "greenbody 0.2.0; preset ...; seed ...; density ...; p ... MPa; units ...". */
void gb_export_text_provenance(GString *text, const struct gb_export_frame *frame);

struct gb_export_contact {
    int64_t first, second; /* particles, from 0 */
    double force[3];       /* on the first, nN */
    double normal, shear;  /* normal force, positive when pressed; force across, nN */
    double branch[3];      /* from the second to the first, the nearest image, nm */
    double overlap;        /* nm; negative: a gap */
    bool bridged;
    /* NaN where the state does not have it: a and pi a^2 of the contact, which of a bridge
     * are those of the bridge; nm, nm^2 */
    double radius, area;
    double bridge_radius; /* nm; 0: no bridge */
};

/* The columns of contacts behind "bridged", as far as the state has them: `between` before
 * each, in the order shear, radius, area, bridge_radius. */
void gb_export_text_contact_end(GString *text, const struct gb_export_frame *frame,
                                const struct gb_export_contact *contact, char between);

/* Rows of contacts: those of the state, then the pairs across gaps, whose overlap is
 * negative and whose radius is 0. */
int64_t gb_export_text_contacts(const struct gb_export_frame *frame);

/* Row k of them. */
struct gb_export_contact gb_export_text_contact(const struct gb_export_frame *frame,
                                                int64_t k);

#endif
