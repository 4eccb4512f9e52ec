#include "io/export.h"

#include <glib.h>
#include <inttypes.h>
#include <json-glib/json-glib.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/number.h"
#include "base/vec.h"
#include "base/visible.h"
#include "greenbody/status.h"
#include "io/state_forces.h"
#include "io/status_json.h"
#include "pack/cell/cell.h"

/* For formats with one state per file: numbered files, and a list that ParaView opens
 * as one series. "run.vtkhdf" becomes run-0000.vtkhdf, run-0001.vtkhdf, ... and
 * run.vtkhdf.series. */

char *gb_export_series_name(const char *path, int64_t index)
{
    const char *slash = strrchr(path, G_DIR_SEPARATOR);
    const char *base = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(base, '.');
    const char *end = dot != NULL && dot != base ? dot : path + strlen(path);
    return g_strdup_printf("%.*s-%04" PRId64 "%s", (int)(end - path), path, index, end);
}

char *gb_export_series_list_name(const char *path)
{
    return g_strconcat(path, ".series", NULL);
}

static void add_file(JsonBuilder *builder, const char *path, int64_t index, int64_t step)
{
    char *name = gb_export_series_name(path, index);
    char *base = g_path_get_basename(name);
    json_builder_begin_object(builder);
    json_builder_set_member_name(builder, "name");
    json_builder_add_string_value(builder, base);
    json_builder_set_member_name(builder, "time");
    json_builder_add_double_value(builder, (double)step);
    json_builder_end_object(builder);
    g_free(base);
    g_free(name);
}

bool gb_export_series_put_list(const char *path, const int64_t *steps, int64_t count,
                               struct gb_error *err)
{
    JsonBuilder *builder = json_builder_new();
    json_builder_begin_object(builder);
    json_builder_set_member_name(builder, "file-series-version");
    json_builder_add_string_value(builder, "1.0");
    json_builder_set_member_name(builder, "files");
    json_builder_begin_array(builder);
    for (int64_t k = 0; k < count; k++) {
        add_file(builder, path, k, steps[k]);
    }
    json_builder_end_array(builder);
    json_builder_end_object(builder);
    JsonNode *root = json_builder_get_root(builder);
    char *text = gb_status_json_print(root);
    char *name = gb_export_series_list_name(path);
    const bool done = gb_file_replace(name, text, strlen(text), err);
    g_free(name);
    g_free(text);
    json_node_unref(root);
    g_object_unref(builder);
    return done;
}

/* Parts that the formats share: numbers, and the data of a contact. */

void gb_export_vectors(const struct gb_export_frame *frame,
                       struct gb_export_vector vectors[GB_EXPORT_VECTORS])
{
    const struct gb_state *state = frame->state;
    const bool timed = isfinite(frame->ns);
    const double moment = frame->nn * frame->nm;
    const struct gb_export_vector all[GB_EXPORT_VECTORS] = {
        [GB_EXPORT_VECTOR_VELOCITY] = {"vx_m_per_s,vy_m_per_s,vz_m_per_s", "vx vy vz",
                                       "velo:R:3", "velocity_m_per_s", "m/s",
                                       timed ? state->velocity : NULL,
                                       frame->nm / frame->ns, frame->nm / frame->ns},
        [GB_EXPORT_VECTOR_SPIN] = {"omegax_per_ns,omegay_per_ns,omegaz_per_ns",
                                   "omegax omegay omegaz", "omega:R:3", "omega_per_ns",
                                   "1/ns", timed ? state->spin : NULL, 1.0 / frame->ns,
                                   1.0 / frame->ns},
        [GB_EXPORT_VECTOR_FORCE] = {"fx_nN,fy_nN,fz_nN", "fx fy fz", "forces:R:3",
                                    "force_nN", "nN", state->force, frame->nn,
                                    1e3 * frame->nn},
        [GB_EXPORT_VECTOR_TORQUE] = {"tqx_nN_nm,tqy_nN_nm,tqz_nN_nm", "tqx tqy tqz",
                                     "torques:R:3", "torque_nN_nm", "nN nm",
                                     state->torque, moment, 1e3 * moment},
    };
    for (int k = 0; k < GB_EXPORT_VECTORS; k++) {
        vectors[k] = all[k];
    }
}

void gb_export_append_vectors(GString *text,
                              const struct gb_export_vector vectors[GB_EXPORT_VECTORS],
                              bool nano, int64_t particle, char between)
{
    for (int k = 0; k < GB_EXPORT_VECTORS; k++) {
        const struct gb_export_vector *vector = &vectors[k];
        for (int c = 0; vector->data != NULL && c < 3; c++) {
            g_string_append_c(text, between);
            gb_export_text_number(text,
                                  (nano ? vector->nano : vector->factor) *
                                      vector->data[3 * particle + c],
                                  '\0');
        }
    }
}

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

/* The title of the preset without quotes, control characters and line ends. */
static void export_text_title(GString *text, const struct gb_state *state)
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
    export_text_title(title, state);
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

static const struct gb_export_format formats[] = {
    {"extxyz", "extended XYZ (OVITO, ASE)", "csv", true, gb_export_extxyz_write, NULL},
    {"lammps-dump", "dump of LAMMPS, contacts as a local dump (OVITO)", "lammps-dump",
     true, gb_export_lammps_dump, NULL},
    {"lammps-data", "data file of LAMMPS, atom_style sphere, units nano", "lammps-dump",
     false, gb_export_lammps_data, NULL},
    {"csv", "tables of particles and contacts (ParaView, spreadsheets)", "csv", false,
     gb_export_csv_write, NULL},
    {"vtkhdf", "VTKHDF, contacts as lines (ParaView 5.10 on, h5py)", "vtkhdf", false,
     NULL, gb_export_vtkhdf_write},
};

const struct gb_export_format *gb_export_at(size_t index)
{
    return index < G_N_ELEMENTS(formats) ? &formats[index] : NULL;
}

const struct gb_export_format *gb_export_find(const char *name, struct gb_error *err)
{
    GString *names = g_string_new(NULL);
    const struct gb_export_format *found = NULL;
    for (size_t i = 0; i < G_N_ELEMENTS(formats); i++) {
        g_string_append_printf(names, "%s%s", i > 0 ? ", " : "", formats[i].name);
        found = strcmp(formats[i].name, name) == 0 ? &formats[i] : found;
    }
    if (found == NULL) {
        gb_error_set(err, GB_ERR_INPUT, "--format %.60s: expected %s", name, names->str);
    }
    g_string_free(names, TRUE);
    return found;
}

/* T = sqrt(m/(E d)) in ns, computed if the file does not have it. */
static double unit_time(const struct gb_state *state, double density_kg_m3)
{
    return 1e9 * (isfinite(state->second_per_time)
                      ? state->second_per_time
                      : state->metre_per_length * sqrt(M_PI * density_kg_m3 /
                                                       (6.0 * state->pascal_per_stress)));
}

bool gb_export_add(const struct gb_export_format *format, const struct gb_state *state,
                   double density_kg_m3, int64_t index, GString *particles,
                   GString *contacts, struct gb_error *err)
{
    const double metre = state->metre_per_length;
    struct gb_export_frame frame = {
        .state = state,
        .density_kg_m3 = density_kg_m3,
        .index = index,
        .nm = metre * 1e9,
        .ns = unit_time(state, density_kg_m3),
        .nn = state->pascal_per_stress * metre * metre * 1e9,
        .stress = gb_alloc_array((size_t)state->count * 6, sizeof(double), err),
    };
    bool good =
        frame.stress != NULL && gb_state_forces_gaps_init(&frame.gaps, state, err);
    if (!good) {
        goto end;
    }
    gb_state_forces_stress_tensor(state, &frame.gaps, frame.stress);
    if (format->write != NULL) {
        format->write(&frame, particles, contacts);
    } else {
        good = format->write_binary(&frame, particles, contacts, err);
    }
end:
    gb_state_forces_gaps_finish(&frame.gaps);
    gb_alloc_free(frame.stress);
    return good;
}
