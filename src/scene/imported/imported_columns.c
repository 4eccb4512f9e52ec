#include <math.h>
#include <string.h>

#include "scene/imported/imported_private.h"

static const char *const x_names[] = {
    "x", "px", "pos_x", "position_x", "center_x", "centroid_x", "xu", "points:0", NULL};
static const char *const y_names[] = {
    "y", "py", "pos_y", "position_y", "center_y", "centroid_y", "yu", "points:1", NULL};
static const char *const z_names[] = {
    "z", "pz", "pos_z", "position_z", "center_z", "centroid_z", "zu", "points:2", NULL};
static const char *const diameters[] = {"diameter", "d", "diam", "eqdiameter", NULL};
static const char *const radii[] = {"radius", "r", "rad", "eqradius", NULL};

/* A name without the unit that follows it: "x_nm", "x (nm)", "x[nm]"; g_free. */
static char *bare_name(const char *name, char **unit)
{
    char *bare = g_ascii_strdown(name, -1);
    *unit = NULL;
    g_strdelimit(bare, "\"'", ' ');
    g_strstrip(bare);
    char *open = strpbrk(bare, "([");
    if (open != NULL) {
        *unit = g_strndup(open + 1, strcspn(open + 1, ")]"));
        *open = '\0';
        g_strstrip(bare);
        return bare;
    }
    char *last = strrchr(bare, '_');
    if (last != NULL &&
        (isfinite(gb_imported_lines_unit(last + 1)) || strcmp(last + 1, "d") == 0)) {
        *unit = g_strdup(last + 1);
        *last = '\0';
    }
    return bare;
}

static void take_unit(struct gb_imported_columns *columns, const char *unit)
{
    if (unit != NULL && strcmp(unit, "d") == 0) {
        columns->reduced = true;
    } else if (unit != NULL) {
        columns->unit_m = gb_imported_lines_unit(unit);
    }
}

bool gb_imported_columns_find(struct gb_imported_columns *columns, char *const *names,
                              const char **missing)
{
    static const char *const *const wanted[] = {x_names, y_names, z_names, diameters,
                                                radii};
    static const char *const title[] = {"x", "y", "z", "diameter or radius"};
    int found[G_N_ELEMENTS(wanted)] = {-1, -1, -1, -1, -1};
    columns->unit_m = (double)NAN;
    columns->reduced = false;
    for (int c = 0; names[c] != NULL; c++) {
        char *unit;
        char *bare = bare_name(names[c], &unit);
        for (size_t k = 0; k < G_N_ELEMENTS(wanted); k++) {
            if (found[k] < 0 && g_strv_contains(wanted[k], bare)) {
                found[k] = c;
                take_unit(columns, unit);
            }
        }
        g_free(bare);
        g_free(unit);
    }
    columns->radius = found[3] < 0;
    columns->size = columns->radius ? found[4] : found[3];
    found[3] = columns->size;
    for (int k = 0; k < 4; k++) {
        if (found[k] < 0) {
            *missing = title[k];
            return false;
        }
    }
    memcpy(columns->position, found, sizeof columns->position);
    return true;
}

bool gb_imported_columns_add_row(struct gb_imported_raw *raw,
                                 const struct gb_imported_lines *lines,
                                 const struct gb_imported_columns *columns,
                                 char *const *words, int count, struct gb_error *err)
{
    static const char *const names[] = {"x", "y", "z"};
    double x[3], size;
    for (int c = 0; c < 3; c++) {
        if (columns->position[c] >= count || columns->size >= count) {
            return gb_imported_lines_refuse(lines, err, "%d columns: must be at least %d",
                                            count,
                                            1 + MAX(columns->position[c], columns->size));
        }
        if (!gb_imported_lines_number(lines, words[columns->position[c]], names[c], &x[c],
                                      err)) {
            return false;
        }
    }
    const char *what = columns->radius ? "radius" : "diameter";
    if (!gb_imported_lines_number(lines, words[columns->size], what, &size, err)) {
        return false;
    }
    if (!(size > 0.0)) {
        return gb_imported_lines_refuse(lines, err, "%s is %g: must be above 0", what,
                                        size);
    }
    size *= columns->radius ? 2.0 : 1.0;
    g_array_append_vals(raw->position, x, 3);
    g_array_append_val(raw->diameter, size);
    return true;
}

/* One word after the other of a line of the file, cut in place; at most `most`. */
static int cut_words(char *line, char **words, int most)
{
    int count = 0;
    for (char *at = line + strspn(line, " \t"); *at != '\0' && count < most;) {
        words[count++] = at;
        at += strcspn(at, " \t");
        if (*at != '\0') {
            *at++ = '\0';
        }
        at += strspn(at, " \t");
    }
    return count;
}

enum { WORDS_MAX = 256 };

bool gb_imported_columns_read_rows(struct gb_imported_lines *lines,
                                   struct gb_imported_raw *raw,
                                   const struct gb_imported_columns *columns,
                                   int64_t count, struct gb_error *err)
{
    char *words[WORDS_MAX];
    g_array_set_size(raw->position, 0);
    g_array_set_size(raw->diameter, 0);
    for (int64_t i = 0; i < count;) {
        char *line = gb_imported_lines_next(lines);
        if (line != NULL && *line == '\0') {
            continue;
        }
        if (line == NULL) {
            return gb_imported_lines_refuse(lines, err,
                                            "the file ends: must have %" G_GINT64_FORMAT
                                            " particles, has %" G_GINT64_FORMAT,
                                            count, i);
        }
        if (!gb_imported_columns_add_row(raw, lines, columns, words,
                                         cut_words(line, words, WORDS_MAX), err)) {
            return false;
        }
        i++;
    }
    return true;
}

bool gb_imported_columns_count(const struct gb_imported_lines *lines, const char *text,
                               int64_t *count, struct gb_error *err)
{
    char *end = NULL;
    *count = g_ascii_strtoll(text, &end, 10);
    return (end != text && (*end == '\0' || g_ascii_isspace(*end)) && *count > 0 &&
            *count <= INT32_MAX) ||
           gb_imported_lines_refuse(lines, err, "%.40s: must be a number of particles",
                                    text);
}
