#ifndef GB_IO_EXPORT_H
#define GB_IO_EXPORT_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "io/state_forces.h"

/* Export of states to files of other programs.  Lengths are in nm, forces in nN,
 * stresses in MPa and positive in compression, unless a format says otherwise.  Each
 * file names its units and the run. */
/* A state in the units of a file. */
struct gb_export_frame {
    const struct gb_state *state;
    struct gb_state_gaps gaps; /* pairs across gaps, listed after the contacts */
    double density_kg_m3;      /* of the solid; NaN: unknown */
    int64_t index;             /* of the frame, from 0 */
    double *stress;            /* count x 6, Pa: xx, yy, zz, xy, xz, yz */
    double nm;                 /* one reduced length */
    double nn;                 /* one reduced force */
    double ns;                 /* one reduced time; NaN: unknown */
};

struct gb_export_format {
    const char *name, *doc;
    const char *contacts; /* format of its contacts: a name or a file ending */
    bool trajectory;      /* several states in one file; else in numbered ones, see
                      * io/export.h */
    /* Appends a frame. contacts may be NULL. */
    void (*write)(const struct gb_export_frame *frame, GString *particles,
                  GString *contacts);
    /* Used instead of write, for binary files.  Errors: GB_ERR_MEMORY. */
    bool (*write_binary)(const struct gb_export_frame *frame, GString *particles,
                         GString *contacts, struct gb_error *err);
};

/* Finds a format by name.  NULL and err, which lists the names, if there is none. */
const struct gb_export_format *gb_export_find(const char *name, struct gb_error *err);
/* Format `index`; NULL after the last. */
const struct gb_export_format *gb_export_at(size_t index);

/* Appends a state to the texts of a format.  Errors: see gb_state_forces_gaps_init. */
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

/* The table of contacts, for formats that have none of their own. */
void gb_export_csv_contacts(const struct gb_export_frame *frame, GString *text);

void gb_export_csv_write(const struct gb_export_frame *frame, GString *particles,
                         GString *contacts);

bool gb_export_vtkhdf_write(const struct gb_export_frame *frame, GString *particles,
                            GString *contacts, struct gb_error *err);

/* Name of file `index`, from 0; g_free. */
char *gb_export_series_name(const char *path, int64_t index);

/* Name of the list of files; g_free. */
char *gb_export_series_list_name(const char *path);

/* Writes the list of files, with the step of each state as its time.  Errors: see
 * gb_file_replace. */
bool gb_export_series_put_list(const char *path, const int64_t *steps, int64_t count,
                               struct gb_error *err);

/* Velocities, angular velocities, resultant forces and torques of the particles, if the
 * state has them. */
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
    const double *data; /* count x 3; NULL: the state lacks it */
    double factor;      /* to m/s, 1/ns, nN and nN nm */
    double nano;        /* to LAMMPS units nano: nm/ns, 1/ns, pN, pN nm */
};

/* All four, in the order of the kinds. */
void gb_export_vectors(const struct gb_export_frame *frame,
                       struct gb_export_vector vectors[GB_EXPORT_VECTORS]);

/* Appends the vector columns of a particle to its line, with `between` before each
 * number. */
void gb_export_append_vectors(GString *text,
                              const struct gb_export_vector vectors[GB_EXPORT_VECTORS],
                              bool nano, int64_t particle, char between);

/* Appends a number with the fewest digits that read back the same, '.' in every locale,
 * then `end`; '\0': nothing after it. */
void gb_export_text_number(GString *text, double value, char end);

/* Appends numbers times a factor, with a character after each and another after the
 * last. */
void gb_export_text_numbers(GString *text, double factor, const double *values, int count,
                            char between, char end);

/* Appends "coordination sxx ... syz" of a particle, MPa. */
void gb_export_text_stress(GString *text, const struct gb_export_frame *frame, int64_t i,
                           char between);

/* Appends "greenbody 0.2.0; preset ...; seed ...; density ...; p ...  MPa; units ...". */
void gb_export_text_provenance(GString *text, const struct gb_export_frame *frame);

struct gb_export_contact {
    int64_t first, second; /* particles, from 0 */
    double force[3];       /* on the first, nN */
    double normal, shear;  /* normal force, positive when pressed; force across, nN */
    double branch[3];      /* from the second to the first, the nearest image, nm */
    double overlap;        /* nm; negative: a gap */
    bool bridged;
    /* Radius a and area pi a^2 of the contact, or of its bridge, in nm and nm^2; NaN:
     * unknown. */
    double radius, area;
    double bridge_radius; /* nm; 0: no bridge */
};

/* Appends the columns after "bridged" that the state has, with `between` before each,
 * in the order shear, radius, area, bridge_radius. */
void gb_export_text_contact_end(GString *text, const struct gb_export_frame *frame,
                                const struct gb_export_contact *contact, char between);

/* Number of rows of contacts: the contacts of the state, then the pairs across gaps,
 * which have a negative overlap and the radius 0. */
int64_t gb_export_text_contacts(const struct gb_export_frame *frame);

/* Row k of these contacts. */
struct gb_export_contact gb_export_text_contact(const struct gb_export_frame *frame,
                                                int64_t k);

#endif
