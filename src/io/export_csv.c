#include <inttypes.h>
#include <math.h>

#include "io/export.h"

void gb_export_csv_contacts(const struct gb_export_frame *frame, GString *text)
{
    if (frame->index == 0) {
        g_string_append(text, "# ");
        gb_export_text_provenance(text, frame);
        g_string_append(
            text,
            "\n# force on particle i, branch vector from j to the nearest "
            "image of i; overlap negative: attraction across a gap\nframe,i,j,fx_nN,fy_nN,fz_nN,normal_nN,bx_nm,by_nm,"
            "bz_nm,overlap_nm,bridged,shear_nN");
        g_string_append(text, frame->state->contact_radius
                                  ? ",radius_nm,area_nm2,bridge_radius_nm\n"
                                  : "\n");
    }
    for (int64_t k = 0; k < gb_export_text_contacts(frame); k++) {
        const struct gb_export_contact contact = gb_export_text_contact(frame, k);
        g_string_append_printf(text, "%" PRId64 ",%" PRId64 ",%" PRId64 ",", frame->index,
                               contact.first + 1, contact.second + 1);
        gb_export_text_numbers(text, 1.0, contact.force, 3, ',', ',');
        gb_export_text_number(text, contact.normal, ',');
        gb_export_text_numbers(text, 1.0, contact.branch, 3, ',', ',');
        gb_export_text_number(text, contact.overlap, ',');
        g_string_append_c(text, contact.bridged ? '1' : '0');
        gb_export_text_contact_end(text, frame, &contact, ',');
    }
}

static void add_head(const struct gb_export_frame *frame,
                     const struct gb_export_vector *vectors, GString *text)
{
    const struct gb_state *state = frame->state;
    g_string_append(text, "# ");
    gb_export_text_provenance(text, frame);
    g_string_append(text, "\n# cell, nm: ");
    for (int k = 0; k < 3; k++) {
        gb_export_text_number(text, frame->nm * state->cell[k], ' ');
    }
    g_string_append(text, "tilt xy xz yz, nm: ");
    for (int k = 0; k < 3; k++) {
        gb_export_text_number(text, frame->nm * state->tilt[k], k < 2 ? ' ' : '\n');
    }
    g_string_append(text, "id,x_nm,y_nm,z_nm,diameter_nm,coordination,sxx_MPa,syy_MPa,"
                          "szz_MPa,sxy_MPa,sxz_MPa,syz_MPa");
    for (int k = 0; k < GB_EXPORT_VECTORS; k++) {
        if (vectors[k].data != NULL) {
            g_string_append_printf(text, ",%s", vectors[k].csv);
        }
    }
    g_string_append_c(text, '\n');
}

void gb_export_csv_write(const struct gb_export_frame *frame, GString *particles,
                         GString *contacts)
{
    const struct gb_state *state = frame->state;
    struct gb_export_vector vectors[GB_EXPORT_VECTORS];
    gb_export_vectors(frame, vectors);
    add_head(frame, vectors, particles);
    for (int64_t i = 0; i < state->count; i++) {
        g_string_append_printf(particles, "%" PRId64 ",", i + 1);
        gb_export_text_numbers(particles, frame->nm, &state->position[3 * i], 3, ',',
                               ',');
        gb_export_text_number(particles, 2.0 * frame->nm * state->radius[i], ',');
        gb_export_text_stress(particles, frame, i, ',');
        gb_export_append_vectors(particles, vectors, false, i, ',');
        g_string_append_c(particles, '\n');
    }
    if (contacts != NULL) {
        gb_export_csv_contacts(frame, contacts);
    }
}
