#include "io/runs/run_last_point.h"

#include <string.h>
#include <unistd.h>

#include <glib.h>

#include "base/read_file.h"

/* Longer than the comments with the header, and than a row. */
enum { BLOCK = 16384 };

/* At most BLOCK bytes from a position, ended by a zero. */
static void read_block(int fd, off_t from, char block[BLOCK + 1])
{
    const ssize_t bytes = pread(fd, block, BLOCK, from);
    block[bytes > 0 ? bytes : 0] = '\0';
}

/* The first line that is no comment; ends it by a zero. */
static char *header_in(char *block)
{
    char *line = block;
    while (*line == '#' && (line = strchr(line, '\n')) != NULL) {
        line++;
    }
    char *end = line != NULL ? strchr(line, '\n') : NULL;
    if (end != NULL) {
        *end = '\0';
    }
    return end != NULL ? line : NULL;
}

/* The last line that has its newline; ends it by a zero. */
static char *last_line_in(char *block)
{
    char *end = strrchr(block, '\n');
    if (end == NULL) {
        return NULL;
    }
    *end = '\0';
    char *before = strrchr(block, '\n');
    return before != NULL ? before + 1 : NULL;
}

static bool take(char **names, char **cells, const char *name, double *value)
{
    for (int k = 0; names[k] != NULL; k++) {
        if (strcmp(names[k], name) == 0) {
            char *end = cells[k];
            *value = g_ascii_strtod(cells[k], &end);
            return end != cells[k] && *end == '\0';
        }
    }
    return false;
}

bool gb_run_last_point_read(const char *directory, double *density, double *pressure_pa)
{
    char *path = g_build_filename(directory, "curve.csv", NULL);
    const int fd = gb_read_file_open(path, NULL);
    char first[BLOCK + 1], last[BLOCK + 1];
    double p_mpa = 0.0;
    g_free(path);
    if (fd < 0) {
        return false;
    }
    const off_t size = lseek(fd, 0, SEEK_END);
    read_block(fd, 0, first);
    read_block(fd, size > BLOCK ? size - BLOCK : 0, last);
    close(fd);
    const char *header = header_in(first), *row = last_line_in(last);
    if (header == NULL || row == NULL) {
        return false;
    }
    char **names = g_strsplit(header, ",", -1), **cells = g_strsplit(row, ",", -1);
    const bool good = g_strv_length(names) == g_strv_length(cells) &&
                      take(names, cells, "density", density) &&
                      take(names, cells, "p_MPa", &p_mpa);
    *pressure_pa = 1e6 * p_mpa;
    g_strfreev(names);
    g_strfreev(cells);
    return good;
}
