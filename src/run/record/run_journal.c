#include "run/record/run_journal.h"

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <glib.h>

#define AT(member) offsetof(struct gb_run_journal, member)
static const struct gb_record_member members[] = {
    {"journal/points", GB_RECORD_INT64, 1, AT(extent.points), "1"},
    {"journal/curve_bytes", GB_RECORD_INT64, 1, AT(extent.curve_bytes), "1"},
    {"journal/events_bytes", GB_RECORD_INT64, 1, AT(extent.events_bytes), "1"},
    {"journal/events", GB_RECORD_INT64, 1, AT(events), "1"},
    {"journal/seconds", GB_RECORD_DOUBLE, 1, AT(seconds), "s"},
    {"journal/preset", GB_RECORD_INT64, 1, AT(preset), "1"},
    {"journal/curve_sum", GB_RECORD_INT64, 1, AT(extent.curve_sum), "1"},
    {"journal/trajectory", GB_RECORD_INT64, 4, AT(live), "1"},
    {"journal/highest", GB_RECORD_DOUBLE, 2, AT(highest), "Pa or 1"},
};
#undef AT

enum { MEMBERS = sizeof members / sizeof members[0] };

/* Adds "group.key" and value of a key that differs from its default. */
static void add_key(GChecksum *sum, const struct gb_params *params,
                    const struct gb_params *defaults, const struct gb_field *field)
{
    char value[GB_PARAMS_VALUE_MAX], usual[GB_PARAMS_VALUE_MAX];
    gb_params_format(params, field, value, sizeof value);
    gb_params_format(defaults, field, usual, sizeof usual);
    if (field->no_result || strcmp(value, usual) == 0) {
        return;
    }
    if (field->type == GB_FIELD_PACKING) { /* wherever the file is */
        snprintf(value, sizeof value, "%016" PRIx64, params->from.sum);
    }
    char *line = g_strdup_printf("%s.%s = %s\n", field->group, field->key, value);
    g_checksum_update(sum, (const guchar *)line, -1);
    g_free(line);
}

int64_t gb_run_journal_digest(const struct gb_params *params)
{
    struct gb_params defaults;
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    guint8 bytes[32];
    gsize size = sizeof bytes;
    int64_t number = 0;
    gb_params_init(&defaults);
    for (size_t i = 0; i < count; i++) {
        add_key(sum, params, &defaults, &fields[i]);
    }
    g_checksum_get_digest(sum, bytes, &size);
    memcpy(&number, bytes, sizeof number);
    g_checksum_free(sum);
    return number;
}

bool gb_run_journal_record(struct gb_run_journal *journal, struct gb_record *record,
                           struct gb_error *err)
{
    return gb_record_members(record, members, MEMBERS, journal, err);
}

bool gb_run_journal_load(struct gb_run_journal *journal, struct gb_record *record,
                         const char *directory, struct gb_error *err)
{
    const int64_t preset = journal->preset;
    struct gb_error why = {0};
    record->loading = true;
    if (!gb_record_members(record, members, MEMBERS, journal, &why)) {
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
