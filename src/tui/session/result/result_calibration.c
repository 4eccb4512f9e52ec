#include "tui/session/result/result_fills.h"

#include "base/alloc.h"
#include "base/read_file.h"
#include "base/table.h"
#include "io/preset.h"
#include "study/calibrate/calibration.h"

enum { BYTES_MAX = 1 << 20 };

/* The lines that the command prints. */
static bool read_lines(struct gb_result_card *card)
{
    char *text = NULL;
    size_t length = 0;
    char *path = g_build_filename(card->path, GB_CALIBRATION_TABLE_TEXT, NULL);
    const bool good = gb_read_file(path, BYTES_MAX, &text, &length, NULL);
    char **lines = g_strsplit(good ? text : "", "\n", -1);
    for (int i = 0; lines[i] != NULL; i++) {
        if (lines[i][0] != '\0') {
            gb_result_card_add(card,
                               gb_calibration_warns(lines[i]) ? GB_RESULT_WARNING
                                                                    : GB_RESULT_VALUE,
                               "%s", g_strstrip(lines[i]));
        }
    }
    g_strfreev(lines);
    gb_alloc_free(text);
    g_free(path);
    return good;
}

/* The keys of calibration.csv, with their values in calibrated.ini. */
static void offer_values(struct gb_result_card *card)
{
    struct gb_table *table = NULL;
    struct gb_preset *preset = NULL;
    char *csv = g_build_filename(card->path, "calibration.csv", NULL);
    char *ini = g_build_filename(card->path, "calibrated.ini", NULL);
    if (gb_table_read(&table, csv, "key", NULL) && gb_preset_load(&preset, ini, NULL)) {
        for (size_t row = 0; row < gb_table_rows(table); row++) {
            const struct gb_field *field =
                gb_params_find_name(gb_table_word(table, row), NULL);
            if (field != NULL) {
                gb_result_card_offer(card, field, gb_preset_params(preset));
            }
        }
    }
    gb_preset_destroy(preset);
    gb_table_destroy(table);
    g_free(ini);
    g_free(csv);
}

bool gb_result_calibration_fill(struct gb_result_card *card,
                                const struct gb_session *session)
{
    (void)session;
    offer_values(card);
    return read_lines(card);
}
