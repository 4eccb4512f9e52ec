#include <math.h>
#include <string.h>

#include "scene/imported/imported_private.h"

/* Dumps (the last frame) and data files (atom_style sphere) of LAMMPS. */

/* "xlo xhi" as a line of a file; a third number in dumps of tilted cells is xy, xz, yz. */
static bool take_bounds(struct gb_imported_raw *raw,
                        const struct gb_imported_lines *lines, int axis, const char *line,
                        struct gb_error *err)
{
    double high = 0.0;
    char **words = g_strsplit_set(line, " \t", -1);
    bool good = g_strv_length(words) >= 2 ||
                gb_imported_lines_refuse(lines, err, "%.40s: must be two bounds", line);
    good = good &&
           gb_imported_lines_number(lines, words[0], "a bound of the cell",
                                    &raw->low[axis], err) &&
           gb_imported_lines_number(lines, words[1], "a bound of the cell", &high, err);
    raw->edges[axis] = high - raw->low[axis];
    if (good && g_strv_length(words) >= 3) {
        good = gb_imported_lines_number(lines, words[2], "a tilt of the cell",
                                        &raw->tilts[axis], err);
    }
    g_strfreev(words);
    return good;
}

/* Dumps have the bounds of the box around a tilted cell. */
static void take_tilts_out(struct gb_imported_raw *raw)
{
    const double xy = raw->tilts[0], xz = raw->tilts[1], yz = raw->tilts[2];
    if (xy == 0.0 && xz == 0.0 && yz == 0.0) {
        return;
    }
    const double low[3] = {fmin(fmin(0.0, xy), fmin(xz, xy + xz)), fmin(0.0, yz), 0.0};
    const double high[3] = {fmax(fmax(0.0, xy), fmax(xz, xy + xz)), fmax(0.0, yz), 0.0};
    for (int axis = 0; axis < 3; axis++) {
        const double edge = raw->edges[axis] + raw->low[axis]; /* the upper bound */
        raw->low[axis] -= low[axis];
        raw->edges[axis] = edge - high[axis] - raw->low[axis];
    }
}

static bool is_dump(const char *text)
{
    return g_str_has_prefix(text, "ITEM:");
}

struct dump {
    int64_t count;
    bool atoms; /* a frame has been read */
};

static bool next_line(struct gb_imported_lines *lines, char **line, struct gb_error *err)
{
    *line = gb_imported_lines_next(lines);
    return *line != NULL || gb_imported_lines_refuse(lines, err, "the file ends here");
}

static bool take_atoms(struct dump *dump, struct gb_imported_lines *lines,
                       struct gb_imported_raw *raw, const char *names,
                       struct gb_error *err)
{
    struct gb_imported_columns columns;
    const char *missing = "";
    char **name = g_strsplit_set(names, " \t", -1);
    const bool found = gb_imported_columns_find(&columns, name, &missing);
    g_strfreev(name);
    if (!found) {
        return gb_imported_lines_refuse(
            lines, err,
            "no column %s: must be x y z (or xu yu zu) and diameter "
            "or radius",
            missing);
    }
    dump->atoms = true;
    return gb_imported_columns_read_rows(lines, raw, &columns, dump->count, err);
}

static bool take_item(struct dump *dump, struct gb_imported_lines *lines,
                      struct gb_imported_raw *raw, const char *item, struct gb_error *err)
{
    static const char atoms[] = "ATOMS", bounds[] = "BOX BOUNDS";
    char *line;
    if (g_str_has_prefix(item, atoms)) {
        return take_atoms(dump, lines, raw, g_strchug((char *)item + strlen(atoms)), err);
    }
    if (strcmp(item, "UNITS") == 0) {
        if (!next_line(lines, &line, err)) {
            return false;
        }
        raw->unit_m = gb_imported_lines_unit(line);
    } else if (strcmp(item, "NUMBER OF ATOMS") == 0) {
        return next_line(lines, &line, err) &&
               gb_imported_columns_count(lines, line, &dump->count, err);
    } else if (g_str_has_prefix(item, bounds)) {
        memset(raw->tilts, 0, sizeof raw->tilts); /* of an earlier frame */
        if (strstr(item, "abc origin")) {
            return gb_imported_lines_refuse(
                lines, err, "a cell by vectors and origin: must be bounds with xy xz yz");
        }
        for (int axis = 0; axis < 3; axis++) {
            if (!next_line(lines, &line, err) ||
                !take_bounds(raw, lines, axis, line, err)) {
                return false;
            }
        }
        raw->cell = true;
        take_tilts_out(raw);
    }
    return true;
}

static bool read_dump(struct gb_imported_lines *lines, struct gb_imported_raw *raw,
                      struct gb_error *err)
{
    static const char mark[] = "ITEM: ";
    struct dump dump = {0};
    for (char *line; (line = gb_imported_lines_next(lines)) != NULL;) {
        if (g_str_has_prefix(line, mark) &&
            !take_item(&dump, lines, raw, line + strlen(mark), err)) {
            return false;
        }
    }
    return dump.atoms ||
           gb_imported_lines_refuse(lines, err, "no ITEM: ATOMS: must have one");
}

const struct gb_imported_format gb_imported_lammps_dump = {"lammps-dump", is_dump,
                                                           read_dump};

/* The first line is a title; "N atoms" follows within the head. */
static bool is_data(const char *text)
{
    const char *title = strchr(text, '\n');
    const char *atoms = title != NULL ? strstr(title, " atoms") : NULL;
    const char *bounds = title != NULL ? strstr(title, "xlo xhi") : NULL;
    return atoms != NULL && bounds != NULL;
}

static bool take_tilts(struct gb_imported_raw *raw, const struct gb_imported_lines *lines,
                       char *line, struct gb_error *err)
{
    bool good = true;
    line[strlen(line) - strlen("xy xz yz")] = '\0';
    char **words = g_strsplit_set(g_strstrip(line), " \t", -1);
    for (int k = 0; good && k < 3; k++) {
        good =
            (words[k] != NULL ||
             gb_imported_lines_refuse(lines, err, "%d tilts: must be 3, xy xz yz", k)) &&
            gb_imported_lines_number(lines, words[k], "a tilt of the cell",
                                     &raw->tilts[k], err);
    }
    g_strfreev(words);
    return good;
}

static bool take_head(struct gb_imported_raw *raw, const struct gb_imported_lines *lines,
                      char *line, int64_t *count, struct gb_error *err)
{
    static const char *const bounds[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
    if (g_str_has_suffix(line, " atoms")) {
        return gb_imported_columns_count(lines, line, count, err);
    }
    if (g_str_has_suffix(line, "xy xz yz")) {
        return take_tilts(raw, lines, line, err);
    }
    for (int axis = 0; axis < 3; axis++) {
        if (g_str_has_suffix(line, bounds[axis])) {
            line[strlen(line) - strlen(bounds[axis])] = '\0';
            raw->cell = true;
            return take_bounds(raw, lines, axis, g_strstrip(line), err);
        }
    }
    return true;
}

static bool take_section(struct gb_imported_raw *raw, struct gb_imported_lines *lines,
                         const char *style, int64_t count, struct gb_error *err)
{
    /* atom-ID atom-type diameter density x y z */
    static const struct gb_imported_columns sphere = {.position = {4, 5, 6}, .size = 2};
    if (style != NULL && strstr(style, "sphere") == NULL) {
        return gb_imported_lines_refuse(lines, err,
                                        "atoms of style %.40s: must be sphere",
                                        style + 1 + strspn(style + 1, " \t"));
    }
    return gb_imported_columns_read_rows(lines, raw, &sphere, count, err);
}

/* LAMMPS says its units in the title, this program in the provenance. */
static double unit_of_title(const char *title)
{
    static const char key[] = "units = ";
    const char *found = strstr(title, key);
    if (found == NULL) {
        return strstr(title, "units nm") != NULL ? gb_imported_lines_unit("nm")
                                                 : (double)NAN;
    }
    found += strlen(key);
    char *name = g_strndup(found, strcspn(found, " ,"));
    const double unit = gb_imported_lines_unit(name);
    g_free(name);
    return unit;
}

static bool read_data(struct gb_imported_lines *lines, struct gb_imported_raw *raw,
                      struct gb_error *err)
{
    int64_t count = 0;
    for (char *line; (line = gb_imported_lines_next(lines)) != NULL;) {
        if (lines->number == 1) {
            raw->unit_m = unit_of_title(line);
        } else if (g_str_has_prefix(line, "Atoms")) {
            return take_section(raw, lines, strchr(line, '#'), count, err);
        } else if (!take_head(raw, lines, line, &count, err)) {
            return false;
        }
    }
    return gb_imported_lines_refuse(lines, err, "no section Atoms: must have one");
}

const struct gb_imported_format gb_imported_lammps_data = {"lammps-data", is_data,
                                                           read_data};
