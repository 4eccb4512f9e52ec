#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/imported/imported_private.h"

/* Extended XYZ: frames of a count, a line key=value ..., and the particles.  The last frame
 * is read.  Lengths are Angstroms only by a convention that powders do not follow: the
 * unit is known where the provenance says it. */

static bool recognise(const char *text)
{
    const char *second = strchr(text, '\n');
    if (second == NULL || strspn(text, "0123456789 \t\r") < (size_t)(second - text)) {
        return false;
    }
    const char *end = strchr(second + 1, '\n');
    const char *found = strstr(second, "Lattice=");
    const char *other = strstr(second, "Properties=");
    found = found != NULL ? found : other;
    return found != NULL && (end == NULL || found < end);
}

/* The value of a key of the second line, without its quotes; NULL: absent.  g_free. */
static char *value_of(const char *line, const char *key)
{
    const size_t length = strlen(key);
    bool quoted = false;
    for (const char *at = line; *at != '\0'; at++) {
        quoted ^= *at == '"';
        const bool begins = at == line || at[-1] == ' ';
        if (quoted || !begins || strncmp(at, key, length) != 0 || at[length] != '=') {
            continue;
        }
        const char *value = at + length + 1;
        return *value == '"' ? g_strndup(value + 1, strcspn(value + 1, "\""))
                             : g_strndup(value, strcspn(value, " "));
    }
    return NULL;
}

static bool take_lattice(struct gb_imported_raw *raw,
                         const struct gb_imported_lines *lines, const char *lattice,
                         struct gb_error *err)
{
    double rows[9];
    const char *why = "";
    char **words = g_strsplit(lattice, " ", -1);
    bool good = g_strv_length(words) == 9 ||
                gb_imported_lines_refuse(lines, err, "Lattice of %u numbers: must be 9",
                                         g_strv_length(words));
    for (int k = 0; good && k < 9; k++) {
        good = gb_imported_lines_number(lines, words[k], "Lattice", &rows[k], err);
    }
    if (good && !gb_imported_lines_vectors(raw, rows, &why)) {
        good = gb_imported_lines_refuse(lines, err, "Lattice: %s", why);
    }
    g_strfreev(words);
    return good;
}

/* "species:S:1:pos:R:3:radius:R:1" as names of columns; g_strfreev. */
static char **names_of(const char *properties)
{
    GPtrArray *names = g_ptr_array_new();
    char **part = g_strsplit(properties, ":", -1);
    const guint parts = g_strv_length(part);
    for (guint p = 0; p + 2 < parts; p += 3) {
        static const char *const axes[] = {"x", "y", "z"};
        const bool position = strcmp(part[p], "pos") == 0;
        const long width = strtol(part[p + 2], NULL, 10);
        for (long k = 0; k < MIN(width, 64); k++) {
            g_ptr_array_add(names, position && k < 3 ? g_strdup(axes[k])
                                   : width == 1      ? g_strdup(part[p])
                                                : g_strdup_printf("%s[%ld]", part[p], k));
        }
    }
    g_ptr_array_add(names, NULL);
    g_strfreev(part);
    return (char **)g_ptr_array_free(names, FALSE);
}

static bool take_comment(struct gb_imported_raw *raw,
                         const struct gb_imported_lines *lines, const char *line,
                         struct gb_imported_columns *columns, struct gb_error *err)
{
    const char *missing = "";
    char *lattice = value_of(line, "Lattice");
    char *properties = value_of(line, "Properties");
    char **names = names_of(properties != NULL ? properties : "");
    char *provenance = value_of(line, "provenance");
    bool good = true;
    if (!gb_imported_columns_find(columns, names, &missing)) {
        good =
            gb_imported_lines_refuse(lines, err,
                                     "no %s in Properties: must have pos and radius or "
                                     "diameter",
                                     missing);
    }
    if (good && lattice != NULL) {
        good = take_lattice(raw, lines, lattice, err);
    }
    if (provenance != NULL && strstr(provenance, "units nm") != NULL) {
        raw->unit_m = gb_imported_lines_unit("nm");
    }
    g_free(provenance);
    g_strfreev(names);
    g_free(properties);
    g_free(lattice);
    return good;
}

static bool read_extxyz(struct gb_imported_lines *lines, struct gb_imported_raw *raw,
                        struct gb_error *err)
{
    for (char *line; (line = gb_imported_lines_next(lines)) != NULL;) {
        struct gb_imported_columns columns;
        int64_t count;
        if (*line == '\0') {
            continue;
        }
        if (!gb_imported_columns_count(lines, line, &count, err)) {
            return false;
        }
        line = gb_imported_lines_next(lines);
        if (!take_comment(raw, lines, line != NULL ? line : "", &columns, err) ||
            !gb_imported_columns_read_rows(lines, raw, &columns, count, err)) {
            return false;
        }
    }
    return true;
}

const struct gb_imported_format gb_imported_extxyz = {"extxyz", recognise, read_extxyz};
