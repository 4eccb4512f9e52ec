#include <inttypes.h>
#include <math.h>

#include "io/export.h"

static bool is_tilted(const struct gb_state *state)
{
    return state->tilt[0] != 0.0 || state->tilt[1] != 0.0 || state->tilt[2] != 0.0;
}

/* Bounds of the box as in a LAMMPS dump: a tilted cell has the bounds of the box around
 * it. */
static void add_bounds(const struct gb_export_frame *frame, GString *text)
{
    const struct gb_state *state = frame->state;
    const double xy = state->tilt[0], xz = state->tilt[1], yz = state->tilt[2];
    const double low[3] = {fmin(fmin(0.0, xy), fmin(xz, xy + xz)), fmin(0.0, yz), 0.0};
    const double high[3] = {fmax(fmax(0.0, xy), fmax(xz, xy + xz)), fmax(0.0, yz), 0.0};
    const double tilt[3] = {xy, xz, yz};
    const char *ends = state->die_radius > 0.0 ? "ff ff ff" : "pp pp pp";
    g_string_append_printf(text, "ITEM: BOX BOUNDS %s%s\n",
                           is_tilted(state) ? "xy xz yz " : "", ends);
    for (int k = 0; k < 3; k++) {
        gb_export_text_number(text, frame->nm * low[k], ' ');
        gb_export_text_number(text, frame->nm * (state->cell[k] + high[k]),
                              is_tilted(state) ? ' ' : '\n');
        if (is_tilted(state)) {
            gb_export_text_number(text, frame->nm * tilt[k], '\n');
        }
    }
}

static void add_head(const struct gb_export_frame *frame, const char *what, int64_t count,
                     GString *text)
{
    if (frame->index == 0) {
        g_string_append(text, "ITEM: UNITS\nnano\n");
    }
    g_string_append_printf(
        text, "ITEM: TIMESTEP\n%" PRId64 "\nITEM: NUMBER OF %s\n%" PRId64 "\n",
        (int64_t)frame->state->point.step, what, count);
    add_bounds(frame, text);
}

static void add_contacts(const struct gb_export_frame *frame, GString *text)
{
    const int64_t count = gb_export_text_contacts(frame);
    add_head(frame, "ENTRIES", count, text);
    g_string_append(text, "ITEM: ENTRIES index i j fx_nN fy_nN fz_nN normal_nN bx by bz "
                          "overlap bridged shear_nN");
    g_string_append(text,
                    frame->state->contact_radius ? " radius area bridge_radius\n" : "\n");
    for (int64_t k = 0; k < count; k++) {
        const struct gb_export_contact contact = gb_export_text_contact(frame, k);
        g_string_append_printf(text, "%" PRId64 " %" PRId64 " %" PRId64 " ", k + 1,
                               contact.first + 1, contact.second + 1);
        gb_export_text_numbers(text, 1.0, contact.force, 3, ' ', ' ');
        gb_export_text_number(text, contact.normal, ' ');
        gb_export_text_numbers(text, 1.0, contact.branch, 3, ' ', ' ');
        gb_export_text_number(text, contact.overlap, ' ');
        g_string_append_c(text, contact.bridged ? '1' : '0');
        gb_export_text_contact_end(text, frame, &contact, ' ');
    }
}

void gb_export_lammps_dump(const struct gb_export_frame *frame, GString *particles,
                           GString *contacts)
{
    const struct gb_state *state = frame->state;
    struct gb_export_vector vectors[GB_EXPORT_VECTORS];
    gb_export_vectors(frame, vectors);
    add_head(frame, "ATOMS", state->count, particles);
    g_string_append(particles,
                    "ITEM: ATOMS id type x y z radius coordination sxx syy szz "
                    "sxy sxz syz");
    for (int k = 0; k < GB_EXPORT_VECTORS; k++) {
        if (vectors[k].data != NULL) {
            g_string_append_printf(particles, " %s", vectors[k].lammps);
        }
    }
    g_string_append_c(particles, '\n');
    for (int64_t i = 0; i < state->count; i++) {
        g_string_append_printf(particles, "%" PRId64 " 1 ", i + 1);
        gb_export_text_numbers(particles, frame->nm, &state->position[3 * i], 3, ' ',
                               ' ');
        gb_export_text_number(particles, frame->nm * state->radius[i], ' ');
        gb_export_text_stress(particles, frame, i, ' ');
        gb_export_append_vectors(particles, vectors, true, i, ' ');
        g_string_append_c(particles, '\n');
    }
    if (contacts != NULL) {
        add_contacts(frame, contacts);
    }
}

static void add_data_head(const struct gb_export_frame *frame, GString *text)
{
    const struct gb_state *state = frame->state;
    static const char *const axes[] = {"x", "y", "z"};
    gb_export_text_provenance(text, frame);
    g_string_append_printf(text, "\n\n%" PRId64 " atoms\n1 atom types\n\n", state->count);
    for (int k = 0; k < 3; k++) {
        g_string_append(text, "0 ");
        gb_export_text_number(text, frame->nm * state->cell[k], ' ');
        g_string_append_printf(text, "%slo %shi\n", axes[k], axes[k]);
    }
    if (is_tilted(state)) {
        for (int k = 0; k < 3; k++) {
            gb_export_text_number(text, frame->nm * state->tilt[k], ' ');
        }
        g_string_append(text, "xy xz yz\n");
    }
    g_string_append(text, "\nAtoms # sphere\n\n");
}

/* Section "Velocities" of atom_style sphere, for scenes with time. */
static void add_velocities(const struct gb_export_frame *frame, GString *text)
{
    struct gb_export_vector all[GB_EXPORT_VECTORS];
    gb_export_vectors(frame, all);
    struct gb_export_vector moving[GB_EXPORT_VECTORS] = {
        [GB_EXPORT_VECTOR_VELOCITY] = all[GB_EXPORT_VECTOR_VELOCITY],
        [GB_EXPORT_VECTOR_SPIN] = all[GB_EXPORT_VECTOR_SPIN],
    };
    if (moving[GB_EXPORT_VECTOR_VELOCITY].data == NULL ||
        moving[GB_EXPORT_VECTOR_SPIN].data == NULL) {
        return;
    }
    g_string_append(text, "\nVelocities # sphere\n\n");
    for (int64_t i = 0; i < frame->state->count; i++) {
        g_string_append_printf(text, "%" PRId64, i + 1);
        gb_export_append_vectors(text, moving, true, i, ' ');
        g_string_append_c(text, '\n');
    }
}

/* Densities are in attograms per nm^3; this is 1e-3 times g/cm3. */
void gb_export_lammps_data(const struct gb_export_frame *frame, GString *particles,
                           GString *contacts)
{
    const struct gb_state *state = frame->state;
    const double density = isnan(frame->density_kg_m3) ? 1.0 : frame->density_kg_m3 / 1e6;
    add_data_head(frame, particles);
    for (int64_t i = 0; i < state->count; i++) {
        g_string_append_printf(particles, "%" PRId64 " 1 ", i + 1);
        gb_export_text_number(particles, 2.0 * frame->nm * state->radius[i], ' ');
        gb_export_text_number(particles, density, ' ');
        gb_export_text_numbers(particles, frame->nm, &state->position[3 * i], 3, ' ',
                               '\n');
    }
    add_velocities(frame, particles);
    if (contacts != NULL) {
        add_contacts(frame, contacts);
    }
}
