#include "io/lab/lab_private.h"

#include <stdarg.h>
#include <string.h>

/* Copies valid UTF-8, cut between characters. */
static void copy(char *to, size_t size, const char *text)
{
    size_t used = 0;
    for (const char *at = text; *at != '\0';) {
        const size_t bytes = (size_t)(g_utf8_next_char(at) - at);
        if (used + bytes >= size) {
            break;
        }
        memcpy(to + used, at, bytes);
        used += bytes;
        at += bytes;
    }
    to[used] = '\0';
}

enum gb_lab_outcome gb_lab_question_ask(struct gb_lab_reading *reading,
                                        const char *format, ...)
{
    va_list list;
    va_start(list, format);
    char *text = g_strdup_vprintf(format, list);
    va_end(list);
    copy(reading->report->question, sizeof reading->report->question, text);
    g_free(text);
    return GB_LAB_QUESTION;
}

/* A column that was recognised, as if it had been given. */
static void pin(struct gb_lab_options_column *to, const struct gb_lab_column *column)
{
    if (!to->given && column->index != GB_LAB_NONE) {
        *to = (struct gb_lab_options_column){
            .given = true, .index = column->index + 1, .unit = column->unit};
    }
}

void gb_lab_question_choice(struct gb_lab_reading *reading, const char *more)
{
    struct gb_lab_report *report = reading->report;
    struct gb_lab_options options = *reading->options;
    if (report->choices == GB_LAB_READER_CHOICES) {
        return;
    }
    for (int role = 0; role < GB_LAB_ROLES; role++) {
        pin(&options.column[role], &reading->column[role]);
    }
    GString *text = g_string_new(NULL);
    if (!gb_lab_options_parse(&options, more, NULL)) {
        g_string_append(text, more); /* with a '?' in it */
    }
    char *known = gb_lab_options_text(&options);
    if (*known != '\0') {
        g_string_prepend(text, text->len > 0 ? "," : "");
        g_string_prepend(text, known);
    }
    copy(report->choice[report->choices++], GB_LAB_READER_CHOICE, text->str);
    g_free(known);
    g_string_free(text, TRUE);
}

enum gb_lab_outcome gb_lab_question_fail(struct gb_lab_reading *reading,
                                         const char *format, ...)
{
    va_list list;
    va_start(list, format);
    char *text = g_strdup_vprintf(format, list);
    va_end(list);
    gb_error_set(reading->err, GB_ERR_INPUT, "%s", text);
    g_free(text);
    return GB_LAB_FAILED;
}
