#include "io/text_file.h"

#include <errno.h>

#include <glib.h>

#include "base/file.h"

static bool is_wrong_path(const GError *failure)
{
    return failure->code == G_FILE_ERROR_NOENT || failure->code == G_FILE_ERROR_NOTDIR ||
           failure->code == G_FILE_ERROR_ISDIR;
}

bool gb_text_file_replace(const char *path, const char *text, size_t length,
                          enum gb_text_file_path kind, struct gb_error *err)
{
    const bool typed = kind == GB_TEXT_FILE_TYPED;
    const GFileSetContentsFlags flags =
        G_FILE_SET_CONTENTS_CONSISTENT |
        (typed ? G_FILE_SET_CONTENTS_DURABLE : G_FILE_SET_CONTENTS_ONLY_EXISTING);
    GError *failure = NULL;
    if (!gb_file_may_write()) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                            g_strerror(errno));
    }
    if (g_file_set_contents_full(path, text, (gssize)length, flags, 0666, &failure)) {
        return true;
    }
    gb_error_set(err, typed && is_wrong_path(failure) ? GB_ERR_INPUT : GB_ERR_MACHINE,
                 "%s: cannot be written: %s", path, gb_file_reason(failure));
    g_error_free(failure);
    return false;
}

void gb_text_file_add_line(GString *lines, const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        g_string_append_c(lines, g_ascii_iscntrl(*c) ? '?' : *c);
    }
    g_string_append_c(lines, '\n');
}
