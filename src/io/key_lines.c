#include "io/key_lines.h"

#include <string.h>

#include <glib.h>

/* One line of the text with blanks and carriage return cut off. */
struct piece {
    const char *start, *stop; /* trimmed */
    int line;
    size_t end;
};

struct scanner {
    struct gb_key_lines *lines;
    const char *path;
    const char *text;
    const char *group; /* current one, owned by its line */
    GHashTable *seen;  /* "group\nkey" -> line number */
};

static void add(struct gb_key_lines *lines, struct gb_key_line item)
{
    if (lines->count == lines->room) {
        lines->room = lines->room ? 2 * lines->room : 64;
        lines->item = g_renew(struct gb_key_line, lines->item, lines->room);
    }
    lines->item[lines->count++] = item;
}

static bool refuse(const struct scanner *scanner, const struct piece *piece,
                   const char *why, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_INPUT, "%s:%d: %.*s: %s", scanner->path, piece->line,
                        (int)MIN(piece->stop - piece->start, 80), piece->start, why);
}

static bool take_group(struct scanner *scanner, const struct piece *piece,
                       struct gb_error *err)
{
    const ptrdiff_t length = piece->stop - piece->start;
    if (length < 3 || piece->stop[-1] != ']') {
        return refuse(scanner, piece, "expected [group]", err);
    }
    struct gb_key_line item = {.line = piece->line, .end = piece->end};
    item.group = g_strndup(piece->start + 1, (size_t)length - 2);
    add(scanner->lines, item);
    scanner->group = item.group;
    return true;
}

/* GKeyFile would take the last of two equal keys silently. */
static bool take_once(struct scanner *scanner, const struct piece *piece, const char *key,
                      struct gb_error *err)
{
    char *name = g_strconcat(scanner->group, "\n", key, NULL);
    const int first = GPOINTER_TO_INT(g_hash_table_lookup(scanner->seen, name));
    if (first == 0) {
        g_hash_table_insert(scanner->seen, name, GINT_TO_POINTER(piece->line));
        return true;
    }
    gb_error_set(err, GB_ERR_INPUT, "%s:%d: %.40s.%.40s is given twice, first in line %d",
                 scanner->path, piece->line, scanner->group, key, first);
    g_free(name);
    return false;
}

static bool take_key(struct scanner *scanner, const struct piece *piece,
                     struct gb_error *err)
{
    const char *equals = memchr(piece->start, '=', (size_t)(piece->stop - piece->start));
    if (!equals || equals == piece->start) {
        return refuse(scanner, piece, "expected [group], key = value or # comment", err);
    }
    if (!scanner->group) {
        return refuse(scanner, piece, "a [group] must come before the first key", err);
    }
    const char *value = equals + 1;
    while (value < piece->stop && g_ascii_isspace(*value)) {
        value++;
    }
    struct gb_key_line item = {.line = piece->line, .end = piece->end};
    item.value = (size_t)(value - scanner->text);
    item.value_end = (size_t)(piece->stop - scanner->text);
    item.group = g_strdup(scanner->group);
    item.key = g_strchomp(g_strndup(piece->start, (size_t)(equals - piece->start)));
    add(scanner->lines, item);
    return take_once(scanner, piece, item.key, err);
}

static bool take_line(struct scanner *scanner, const struct piece *piece,
                      struct gb_error *err)
{
    if (memchr(piece->start, '\0', (size_t)(piece->stop - piece->start))) {
        return refuse(scanner, piece, "NUL bytes are not text", err);
    }
    if (!g_utf8_validate(piece->start, piece->stop - piece->start, NULL)) {
        return refuse(scanner, piece, "not valid UTF-8", err);
    }
    if (piece->start == piece->stop || *piece->start == '#') {
        return true;
    }
    return *piece->start == '[' ? take_group(scanner, piece, err)
                                : take_key(scanner, piece, err);
}

static bool take_all(struct scanner *scanner, size_t length, struct gb_error *err)
{
    const char *at = scanner->text;
    const char *last = at + length;
    for (int line = 1; at < last; line++) {
        const char *newline = memchr(at, '\n', (size_t)(last - at));
        struct piece piece = {
            .start = at, .stop = newline ? newline : last, .line = line};
        at = newline ? newline + 1 : last;
        piece.end = (size_t)(at - scanner->text);
        while (piece.start < piece.stop && g_ascii_isspace(*piece.start)) {
            piece.start++;
        }
        while (piece.stop > piece.start && g_ascii_isspace(piece.stop[-1])) {
            piece.stop--;
        }
        if (!take_line(scanner, &piece, err)) {
            return false;
        }
    }
    return true;
}

bool gb_key_lines_init(struct gb_key_lines *lines, const char *path, const char *text,
                       size_t length, struct gb_error *err)
{
    *lines = (struct gb_key_lines){0};
    struct scanner scanner = {.lines = lines, .path = path, .text = text};
    scanner.seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    const bool good = take_all(&scanner, length, err);
    g_hash_table_destroy(scanner.seen);
    if (!good) {
        gb_key_lines_finish(lines);
    }
    return good;
}

void gb_key_lines_finish(struct gb_key_lines *lines)
{
    for (size_t i = 0; i < lines->count; i++) {
        g_free(lines->item[i].group);
        g_free(lines->item[i].key);
    }
    g_free(lines->item);
    *lines = (struct gb_key_lines){0};
}

const struct gb_key_line *gb_key_lines_find(const struct gb_key_lines *lines,
                                            const char *group, const char *key)
{
    for (size_t i = 0; i < lines->count; i++) {
        const struct gb_key_line *item = &lines->item[i];
        if (strcmp(item->group, group) == 0 && g_strcmp0(item->key, key) == 0) {
            return item;
        }
    }
    return NULL;
}

size_t gb_key_lines_group_end(const struct gb_key_lines *lines, const char *group,
                              size_t length)
{
    for (size_t i = lines->count; i > 0; i--) {
        if (strcmp(lines->item[i - 1].group, group) == 0) {
            return lines->item[i - 1].end;
        }
    }
    return length;
}
