#include "io/lab/lab_text.h"

#include <string.h>

#include <glib.h>

#include "base/alloc.h"
#include "base/file.h"

/* What a file begins with. */
struct mark {
    const char *bytes;
    size_t length;
    const char *encoding; /* NULL: not a text */
    const char *what;
};

static const struct mark marks[] = {
    {"\xef\xbb\xbf", 3, "UTF-8", NULL},
    {"\xff\xfe", 2, "UTF-16LE", NULL},
    {"\xfe\xff", 2, "UTF-16BE", NULL},
    {"PK\x03\x04", 4, NULL, "a workbook (.xlsx, .ods)"},
    {"\xd0\xcf\x11\xe0", 4, NULL, "a workbook (.xls)"},
    {"\x89HDF", 4, NULL, "an HDF5 file"},
    {"%PDF", 4, NULL, "a PDF"},
};

static const struct mark *find_mark(const char *bytes, size_t length)
{
    for (size_t i = 0; i < G_N_ELEMENTS(marks); i++) {
        if (length >= marks[i].length &&
            memcmp(bytes, marks[i].bytes, marks[i].length) == 0) {
            return &marks[i];
        }
    }
    return NULL;
}

/* UTF-16 without a mark: digits and separators have a zero beside them.  The share of
 * zeros among the even and the odd bytes of the beginning tells the order. */
static const char *recognise_utf16(const char *bytes, size_t length)
{
    const size_t seen = MIN(length, 4096) / 2;
    size_t zeros[2] = {0, 0};
    for (size_t i = 0; i < 2 * seen; i++) {
        zeros[i % 2] += bytes[i] == '\0';
    }
    const bool little = zeros[1] > seen / 2 && zeros[0] == 0;
    const bool big = zeros[0] > seen / 2 && zeros[1] == 0;
    return seen == 0 ? NULL : little ? "UTF-16LE" : big ? "UTF-16BE" : NULL;
}

static bool convert(struct gb_lab_text *out, const char *bytes, size_t length,
                    const char *encoding)
{
    gsize written = 0;
    out->text = g_convert(bytes, (gssize)length, "UTF-8", encoding, NULL, &written, NULL);
    out->length = written;
    out->encoding = encoding;
    return out->text != NULL;
}

/* The text behind the mark. */
static bool decode(struct gb_lab_text *out, const char *path, const char *bytes,
                   size_t length, const struct mark *mark, struct gb_error *err)
{
    const size_t skipped = mark != NULL ? mark->length : 0;
    const char *from = bytes + skipped;
    const size_t left = length - skipped;
    const char *encoding = mark != NULL ? mark->encoding : recognise_utf16(from, left);
    out->guessed = mark == NULL && encoding != NULL;
    bool good = false;
    if (encoding != NULL && strcmp(encoding, "UTF-8") != 0) {
        good = convert(out, from, left, encoding);
    } else if (g_utf8_validate(from, (gssize)left, NULL)) {
        out->text = g_strndup(from, left);
        out->length = left;
        out->encoding = "UTF-8";
        good = true;
    } else if (mark == NULL) {
        out->guessed = true;
        good = convert(out, from, left, "WINDOWS-1252") ||
               convert(out, from, left, "ISO-8859-1");
    }
    if (!good) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%.200s: is not valid %s: expected text as UTF-8, UTF-16 "
                            "or Windows-1252",
                            path, encoding != NULL ? encoding : "text");
    }
    return memchr(out->text, '\0', out->length) == NULL ||
           gb_error_set(err, GB_ERR_INPUT, "%.200s: contains NUL bytes: must be text",
                        path);
}

bool gb_lab_text_read(struct gb_lab_text *out, const char *path, struct gb_error *err)
{
    char *bytes = NULL;
    size_t length = 0;
    *out = (struct gb_lab_text){0};
    if (!gb_file_read(path, GB_LAB_TEXT_BYTES_MAX, &bytes, &length, err)) {
        return false;
    }
    const struct mark *mark = find_mark(bytes, length);
    const bool good =
        mark != NULL && mark->encoding == NULL
            ? gb_error_set(err, GB_ERR_INPUT, "%.200s: is %s; expected its table as CSV",
                           path, mark->what)
            : decode(out, path, bytes, length, mark, err);
    gb_alloc_free(bytes);
    if (!good) {
        gb_lab_text_finish(out);
    }
    return good;
}

void gb_lab_text_finish(struct gb_lab_text *text)
{
    g_free(text->text);
    *text = (struct gb_lab_text){0};
}

const char *gb_lab_text_show(const char *text, char buffer[GB_LAB_TEXT_SHOWN])
{
    enum { CHARACTERS = 40 };
    size_t used = 0;
    int shown = 0;
    for (const char *at = text; *at != '\0'; at = g_utf8_next_char(at)) {
        const gunichar character = g_utf8_get_char(at);
        char utf8[8] = " ";
        const int size =
            g_unichar_isprint(character) ? g_unichar_to_utf8(character, utf8) : 1;
        if (shown++ == CHARACTERS || used + (size_t)size + 4 > GB_LAB_TEXT_SHOWN) {
            memcpy(buffer + used, "...", 3);
            used += 3;
            break;
        }
        memcpy(buffer + used, utf8, (size_t)size);
        used += (size_t)size;
    }
    buffer[used] = '\0';
    return buffer;
}
