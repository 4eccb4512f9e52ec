#include "io/export/export_text.h"

#include <inttypes.h>
#include <math.h>

#include "base/number.h"
#include "base/text/visible.h"
#include "base/vec.h"
#include "pack/cell/cell.h"

enum { STRESSES = 6 };

void gb_export_text_number(GString *text, double value, char end)
{
    char digits[GB_NUMBER_MAX];
    g_string_append(text, gb_number_write(value, digits));
    if (end != '\0') {
        g_string_append_c(text, end);
    }
}

void gb_export_text_numbers(GString *text, double factor, const double *values, int count,
                            char between, char end)
{
    for (int c = 0; c < count; c++) {
        gb_export_text_number(text, factor * values[c], c < count - 1 ? between : end);
    }
}

void gb_export_text_stress(GString *text, const struct gb_export_frame *frame, int64_t i,
                           char between)
{
    g_string_append_printf(text, "%" PRId32 "%c", frame->state->contacts[i], between);
    gb_export_text_numbers(text, 1e-6, &frame->stress[STRESSES * i], STRESSES, between,
                           '\0');
}

void gb_export_text_title(GString *text, const struct gb_state *state)
{
    for (const char *c = state->preset; *c != '\0'; c++) {
        g_string_append_c(text,
                          *c == '"' || *c == '\\' || g_ascii_iscntrl(*c) ? '?' : *c);
    }
}

void gb_export_text_provenance(GString *text, const struct gb_export_frame *frame)
{
    const struct gb_state *state = frame->state;
    g_string_append(text, "greenbody " GB_VERSION "; preset ");
    GString *title = g_string_new(NULL);
    gb_export_text_title(title, state);
    gb_visible_add_cell(text, title->str, false);
    g_string_free(title, TRUE);
    g_string_append_printf(text, "; seed %" PRIu64 "; density ", state->seed);
    gb_export_text_number(text, state->point.density, ';');
    g_string_append(text, " p ");
    gb_export_text_number(text, state->point.p_pa / 1e6, ' ');
    g_string_append(text, "MPa; units nm, ns, nN, MPa; stress positive in compression");
}

int64_t gb_export_text_contacts(const struct gb_export_frame *frame)
{
    return frame->state->pair_count + frame->gaps.count;
}

struct gb_export_contact gb_export_text_contact(const struct gb_export_frame *frame,
                                                int64_t k)
{
    const struct gb_state *state = frame->state;
    const struct gb_cell cell = gb_state_cell(state);
    const int64_t gap = k - state->pair_count;
    const int32_t *pair = gap < 0 ? &state->pair[2 * k] : &frame->gaps.pair[2 * gap];
    const double *force =
        gap < 0 ? &state->pair_force[3 * k] : &frame->gaps.force[3 * gap];
    struct gb_export_contact contact = {.first = pair[0],
                                        .second = pair[1],
                                        .bridged =
                                            gap < 0 && state->pair_bridged[k] != 0};
    const double *a = &state->position[3 * contact.first];
    const double *b = &state->position[3 * contact.second];
    double r[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    gb_cell_nearest(&cell, r);
    const double distance = gb_vec_length(r);
    const double normal =
        gap < 0 ? state->pair_normal[k] : gb_vec_dot(force, r) / distance;
    contact.normal = frame->nn * normal;
    contact.overlap = frame->nm * (state->radius[contact.first] +
                                   state->radius[contact.second] - distance);
    double across = 0.0;
    for (int c = 0; c < 3; c++) {
        const double part = force[c] - normal / distance * r[c];
        across += part * part;
        contact.force[c] = frame->nn * force[c];
        contact.branch[c] = frame->nm * r[c];
    }
    contact.shear = gap < 0 ? frame->nn * sqrt(across) : 0.0;
    if (gap < 0) {
        contact.radius =
            state->contact_radius ? frame->nm * state->contact_radius[k] : (double)NAN;
    }
    contact.area = M_PI * contact.radius * contact.radius;
    contact.bridge_radius = contact.bridged ? contact.radius : 0.0;
    return contact;
}

void gb_export_text_contact_end(GString *text, const struct gb_export_frame *frame,
                                const struct gb_export_contact *contact, char between)
{
    const double values[] = {contact->shear, contact->radius, contact->area,
                             contact->bridge_radius};
    const int count = frame->state->contact_radius ? (int)G_N_ELEMENTS(values) : 1;
    g_string_append_c(text, between);
    gb_export_text_numbers(text, 1.0, values, count, between, '\n');
}
