#include "run/record/run_journal.h"

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#include "scene/field/first_defaults.h"

#define AT(member) offsetof(struct gb_run_journal, member)
static const struct gb_record_member members[] = {
    {"journal/points", GB_RECORD_INT64, 1, AT(extent.points), "1"},
    {"journal/curve_bytes", GB_RECORD_INT64, 1, AT(extent.curve_bytes), "1"},
    {"journal/events_bytes", GB_RECORD_INT64, 1, AT(extent.events_bytes), "1"},
    {"journal/events", GB_RECORD_INT64, 1, AT(events), "1"},
    {"journal/seconds", GB_RECORD_DOUBLE, 1, AT(seconds), "s"},
    {"journal/preset", GB_RECORD_INT64, 1, AT(preset), "1"},
};
#undef AT

enum { MEMBERS = sizeof members / sizeof members[0] };

/* Keys of version 0.1, in the order of its digest; without those that change no result.
 * The list stays as it is, so that its run directories resume. */
static const char *const first_keys[] = {"scene.kind",
                                         "scene.dimension",
                                         "material.name",
                                         "material.young",
                                         "material.poisson",
                                         "material.density",
                                         "material.d0",
                                         "material.n_d0_cubed",
                                         "material.epsilon",
                                         "material.yield",
                                         "material.hardening",
                                         "material.hollomon",
                                         "material.young_j",
                                         "material.poisson_j",
                                         "material.density_j",
                                         "material.yield_j",
                                         "particles.count",
                                         "particles.diameter",
                                         "particles.distribution",
                                         "particles.median",
                                         "particles.sigma",
                                         "particles.least",
                                         "particles.largest",
                                         "particles.table",
                                         "contact.normal",
                                         "contact.alpha",
                                         "contact.mu",
                                         "contact.mu_wall",
                                         "contact.mu_pivot",
                                         "contact.bridge_length",
                                         "contact.shear_strength",
                                         "contact.bridge_radius",
                                         "contact.relative_motion",
                                         "contact.viscosity",
                                         "contact.damping",
                                         "contact.shear_ratio",
                                         "contact.storakers",
                                         "contact.radius_i",
                                         "contact.radius_j",
                                         "structure.density",
                                         "structure.base",
                                         "structure.r_meso",
                                         "structure.seed",
                                         "die.diameter",
                                         "die.height",
                                         "die.outlet",
                                         "die.angle",
                                         "die.fill_gravity",
                                         "die.gravity",
                                         "die.ease",
                                         "die.flatten",
                                         "die.punch_mass",
                                         "die.central",
                                         "loading.geometry",
                                         "loading.step",
                                         "loading.until",
                                         "loading.unload_from",
                                         "loading.changes",
                                         "loading.rate",
                                         "loading.relax",
                                         "loading.hold",
                                         "loading.record",
                                         "loading.record_time",
                                         "loading.ramp",
                                         "loading.time",
                                         "loading.record_pressure",
                                         "numerics.fidelity",
                                         "numerics.relaxer",
                                         "numerics.tolerance",
                                         "numerics.strain_part",
                                         "numerics.cutoff",
                                         "numerics.precision",
                                         "numerics.max_evaluations",
                                         "numerics.time_step",
                                         "numerics.step_error",
                                         "numerics.safety",
                                         "numerics.inertia_scale"};

/* Parameters that may change from stop to resume: they change no result. */
static bool is_free(const struct gb_field *field)
{
    return strcmp(field->group, "output") == 0 || strcmp(field->key, "threads") == 0 ||
           strcmp(field->key, "title") == 0;
}

static bool is_first(const char *name)
{
    for (size_t i = 0; i < G_N_ELEMENTS(first_keys); i++) {
        if (strcmp(first_keys[i], name) == 0) {
            return true;
        }
    }
    return false;
}

static void update(GChecksum *sum, const char *name, const char *value)
{
    g_checksum_update(sum, (const guchar *)name, -1);
    g_checksum_update(sum, (const guchar *)value, -1);
}

static void add_first(GChecksum *sum, const struct gb_params *params)
{
    for (size_t i = 0; i < G_N_ELEMENTS(first_keys); i++) {
        char **part = g_strsplit(first_keys[i], ".", 2);
        const struct gb_field *field = gb_params_find(part[0], part[1]);
        char value[2048];
        gb_params_format(params, field, value, sizeof value);
        update(sum, field->key, value);
        g_strfreev(part);
    }
}

/* Keys added since: where they have the default of version 0.1, the run is one of it. */
static void add_later(GChecksum *sum, const struct gb_params *params)
{
    struct gb_params defaults;
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    gb_first_defaults_init(&defaults);
    for (size_t i = 0; i < count; i++) {
        const struct gb_field *field = &fields[i];
        char *name = g_strdup_printf("%s.%s", field->group, field->key);
        char value[2048], usual[2048];
        gb_params_format(params, field, value, sizeof value);
        gb_params_format(&defaults, field, usual, sizeof usual);
        if (field->type == GB_FIELD_PACKING && *value != '\0') { /* wherever it lies */
            snprintf(value, sizeof value, "%016" PRIx64, params->from.sum);
        }
        if (!is_free(field) && !is_first(name) && strcmp(value, usual) != 0) {
            update(sum, name, value);
        }
        g_free(name);
    }
}

int64_t gb_run_journal_digest(const struct gb_params *params)
{
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    guint8 bytes[32];
    gsize size = sizeof bytes;
    int64_t number = 0;
    add_first(sum, params);
    add_later(sum, params);
    g_checksum_get_digest(sum, bytes, &size);
    memcpy(&number, bytes, sizeof number);
    g_checksum_free(sum);
    return number;
}

/* An item that checkpoints of earlier versions lack stays as it is. */
static bool record_later(struct gb_record *record, const char *name,
                         enum gb_record_type type, int columns, const char *unit,
                         void *data, struct gb_error *err)
{
    return (record->loading && !gb_record_find(record, name)) ||
           gb_record_array(record, name, type, 1, columns, unit, data, err);
}

static bool record_members(struct gb_run_journal *journal, struct gb_record *record,
                           struct gb_error *err)
{
    return gb_record_members(record, members, MEMBERS, journal, err) &&
           record_later(record, "journal/curve_sum", GB_RECORD_INT64, 1, "1",
                        &journal->extent.curve_sum, err) &&
           record_later(record, "journal/trajectory", GB_RECORD_INT64, 4, "1",
                        &journal->live, err) &&
           record_later(record, "journal/highest", GB_RECORD_DOUBLE, 2, "Pa or 1",
                        journal->highest, err);
}

bool gb_run_journal_record(struct gb_run_journal *journal, struct gb_record *record,
                           struct gb_error *err)
{
    return record_members(journal, record, err);
}

bool gb_run_journal_load(struct gb_run_journal *journal, struct gb_record *record,
                         const char *directory, struct gb_error *err)
{
    const int64_t preset = journal->preset;
    struct gb_error why = {0};
    record->loading = true;
    if (!record_members(journal, record, &why)) {
        return gb_error_set(err, why.code, "%s/state.h5: %s", directory, why.text);
    }
    if (journal->preset != preset) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s/preset.ini: was changed since the checkpoint: it would "
                            "be another run; only [output], title and threads may change",
                            directory);
    }
    return true;
}
