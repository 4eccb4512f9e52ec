#ifndef GB_IO_EXPORT_EXPORT_TEXT_H
#define GB_IO_EXPORT_EXPORT_TEXT_H

#include "io/export/export.h"

/* Shared by the formats: numbers, and what a contact is. */

/* A number with the fewest digits that read back the same, '.' in every locale, and a
 * character behind it; '\0': none. */
void gb_export_text_number(GString *text, double value, char end);

/* Numbers times a factor, a character behind each and another behind the last. */
void gb_export_text_numbers(GString *text, double factor, const double *values, int count,
                            char between, char end);

/* "coordination sxx ... syz" of a particle, MPa. */
void gb_export_text_stress(GString *text, const struct gb_export_frame *frame, int64_t i,
                           char between);

/* The title of the preset without quotes, control characters and line ends. */
void gb_export_text_title(GString *text, const struct gb_state *state);

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
