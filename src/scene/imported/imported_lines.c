#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "scene/imported/imported_private.h"

char *gb_imported_lines_next(struct gb_imported_lines *lines)
{
    char *line = lines->next;
    if (line == NULL) {
        return NULL;
    }
    char *end = strchr(line, '\n');
    if (end != NULL) {
        *end = '\0';
    }
    lines->next = end != NULL && end[1] != '\0' ? end + 1 : NULL;
    lines->number++;
    return g_strstrip(line);
}

bool gb_imported_lines_refuse(const struct gb_imported_lines *lines, struct gb_error *err,
                              const char *format, ...)
{
    va_list values;
    va_start(values, format);
    char *text = g_strdup_vprintf(format, values);
    va_end(values);
    gb_error_set(err, GB_ERR_INPUT, "%s:%d: %s", lines->path, lines->number, text);
    g_free(text);
    return false;
}

bool gb_imported_lines_number(const struct gb_imported_lines *lines, const char *text,
                              const char *what, double *number, struct gb_error *err)
{
    char *end = NULL;
    *number = g_ascii_strtod(text, &end);
    return (end != text && *end == '\0' && isfinite(*number)) ||
           gb_imported_lines_refuse(
               lines, err, "%s is %.40s: must be a finite number with a decimal point",
               what, text);
}

double gb_imported_lines_unit(const char *name)
{
    static const struct {
        const char *name;
        double metre;
    } units[] = {{"m", 1.0},      {"cm", 1e-2},    {"mm", 1e-3},    {"um", 1e-6},
                 {"µm", 1e-6},    {"μm", 1e-6},    {"nm", 1e-9},    {"A", 1e-10},
                 {"si", 1.0},     {"cgs", 1e-2},   {"micro", 1e-6}, {"nano", 1e-9},
                 {"real", 1e-10}, {"metal", 1e-10}};
    for (size_t k = 0; k < G_N_ELEMENTS(units); k++) {
        if (g_ascii_strcasecmp(units[k].name, name) == 0) {
            return units[k].metre;
        }
    }
    return (double)NAN;
}

bool gb_imported_lines_vectors(struct gb_imported_raw *raw, const double rows[9],
                               const char **why)
{
    *why = "cell vectors must be (Lx 0 0), (xy Ly 0), (xz yz Lz)";
    if (rows[1] != 0.0 || rows[2] != 0.0 || rows[5] != 0.0) {
        return false;
    }
    for (int c = 0; c < 3; c++) {
        raw->edges[c] = rows[4 * c];
    }
    raw->tilts[0] = rows[3];
    raw->tilts[1] = rows[6];
    raw->tilts[2] = rows[7];
    raw->cell = true;
    return true;
}
