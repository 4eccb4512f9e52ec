#include "io/export/export.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "io/export/export_formats.h"
#include "io/state/state_stress.h"

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

/* T = sqrt(m/(E d)) in ns; files of earlier versions do not name it. */
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
    bool good = frame.stress != NULL && gb_state_gaps_init(&frame.gaps, state, err);
    if (!good) {
        goto end;
    }
    gb_state_stress_tensor(state, &frame.gaps, frame.stress);
    if (format->write != NULL) {
        format->write(&frame, particles, contacts);
    } else {
        good = format->write_binary(&frame, particles, contacts, err);
    }
end:
    gb_state_gaps_finish(&frame.gaps);
    gb_alloc_free(frame.stress);
    return good;
}
