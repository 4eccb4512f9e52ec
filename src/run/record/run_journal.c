#include "run/record/run_journal.h"

#include <stddef.h>
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
};
#undef AT

enum { MEMBERS = sizeof members / sizeof members[0] };

/* Parameters that may change from stop to resume: they change no result. */
static bool is_free(const struct gb_field *field)
{
    return strcmp(field->group, "output") == 0 || strcmp(field->key, "threads") == 0 ||
           strcmp(field->key, "title") == 0;
}

int64_t gb_run_journal_digest(const struct gb_params *params)
{
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
    for (size_t i = 0; i < count; i++) {
        char value[2048];
        if (!is_free(&fields[i])) {
            gb_params_format(params, &fields[i], value, sizeof value);
            g_checksum_update(sum, (const guchar *)fields[i].key, -1);
            g_checksum_update(sum, (const guchar *)value, -1);
        }
    }
    guint8 bytes[32];
    gsize size = sizeof bytes;
    int64_t number = 0;
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
