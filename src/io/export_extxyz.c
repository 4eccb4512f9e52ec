#include <inttypes.h>

#include "io/export.h"

/* Cell vectors as rows: a = (x, 0, 0), b = (xy, y, 0), c = (xz, yz, z). */
static void add_lattice(const struct gb_export_frame *frame, GString *text)
{
    const double *cell = frame->state->cell, *tilt = frame->state->tilt;
    const double rows[9] = {cell[0], 0.0,     0.0,     tilt[0], cell[1],
                            0.0,     tilt[1], tilt[2], cell[2]};
    g_string_append(text, "Lattice=\"");
    for (int k = 0; k < 9; k++) {
        gb_export_text_number(text, frame->nm * rows[k], k < 8 ? ' ' : '"');
    }
}

static void add_comment(const struct gb_export_frame *frame,
                        const struct gb_export_vector *vectors, GString *text)
{
    const struct gb_state *state = frame->state;
    const bool in_die = state->die_radius > 0.0;
    add_lattice(frame, text);
    g_string_append(text, " Properties=species:S:1:pos:R:3:id:I:1:radius:R:1:"
                          "coordination:I:1:stress_MPa:R:6");
    for (int k = 0; k < GB_EXPORT_VECTORS; k++) {
        if (vectors[k].data != NULL) {
            g_string_append_printf(text, ":%s", vectors[k].extxyz);
        }
    }
    g_string_append_printf(text, " pbc=\"%s\" branch=%d step=%" PRId64 " density=",
                           in_die                  ? "F F F"
                           : state->dimension == 2 ? "T F T"
                                                   : "T T T",
                           state->point.branch, (int64_t)state->point.step);
    gb_export_text_number(text, state->point.density, ' ');
    g_string_append(text, "pressure_MPa=");
    gb_export_text_number(text, state->point.p_pa / 1e6, ' ');
    g_string_append_printf(text, "seed=%" PRIu64 " provenance=\"", state->seed);
    gb_export_text_provenance(text, frame);
    g_string_append(text, "\"\n");
}

void gb_export_extxyz_write(const struct gb_export_frame *frame, GString *particles,
                            GString *contacts)
{
    const struct gb_state *state = frame->state;
    g_string_append_printf(particles, "%" PRId64 "\n", state->count);
    struct gb_export_vector vectors[GB_EXPORT_VECTORS];
    gb_export_vectors(frame, vectors);
    add_comment(frame, vectors, particles);
    for (int64_t i = 0; i < state->count; i++) {
        g_string_append(particles, "X ");
        gb_export_text_numbers(particles, frame->nm, &state->position[3 * i], 3, ' ',
                               ' ');
        g_string_append_printf(particles, "%" PRId64 " ", i + 1);
        gb_export_text_number(particles, frame->nm * state->radius[i], ' ');
        gb_export_text_stress(particles, frame, i, ' ');
        gb_export_append_vectors(particles, vectors, false, i, ' ');
        g_string_append_c(particles, '\n');
    }
    if (contacts != NULL) {
        gb_export_csv_contacts(frame, contacts);
    }
}
