#ifndef GB_TESTS_BENCH_SPHERES_H
#define GB_TESTS_BENCH_SPHERES_H

#include <glib.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* The spheres of a LAMMPS data file (atom_style sphere), all of diameter 1. */

/* Place, speed and spin of a sphere, in the order of the file's places. */
struct sphere {
    double x[3], v[3], w[3];
};

struct spheres {
    GArray *row; /* of struct sphere */
    double low[3], high[3];
};

static inline bool spheres_fail(const char *what, const char *where)
{
    fprintf(stderr, "%s: %s: %s\n", g_get_prgname(), where, what);
    return false;
}

/* One line: a bound of the box, or a row of a section, which carries the number of its
 * sphere. */
static inline bool spheres_take(struct spheres *spheres, GHashTable *index_of, bool atoms,
                                const char *line, const char *path)
{
    double n, a[6], low, high;
    char axis;
    if (sscanf(line, "%lf %lf %clo", &low, &high, &axis) == 3 && axis >= 'x' &&
        axis <= 'z') {
        spheres->low[axis - 'x'] = low;
        spheres->high[axis - 'x'] = high;
        return true;
    }
    if (sscanf(line, "%lf %lf %lf %lf %lf %lf %lf", &n, a, a + 1, a + 2, a + 3, a + 4,
               a + 5) != 7) {
        return true;
    }
    void *key = GINT_TO_POINTER((int)n);
    if (atoms) { /* type, diameter, density, position */
        const struct sphere sphere = {.x = {a[3], a[4], a[5]}};
        g_hash_table_insert(index_of, key, GINT_TO_POINTER((int)spheres->row->len));
        g_array_append_val(spheres->row, sphere);
        return a[1] == 1.0 || spheres_fail("expected: diameters of 1", path);
    }
    if (g_hash_table_contains(index_of, key)) {
        const int i = GPOINTER_TO_INT(g_hash_table_lookup(index_of, key));
        memcpy(g_array_index(spheres->row, struct sphere, i).v, a, sizeof a);
    }
    return true;
}

static inline bool spheres_read(const char *path, struct spheres *spheres)
{
    char *text = NULL;
    *spheres = (struct spheres){.row = g_array_new(FALSE, FALSE, sizeof(struct sphere))};
    if (!g_file_get_contents(path, &text, NULL, NULL)) {
        return spheres_fail("cannot be read", path);
    }
    GHashTable *index_of = g_hash_table_new(g_direct_hash, g_direct_equal);
    char **lines = g_strsplit(text, "\n", -1);
    bool atoms = false, good = true;
    for (char **line = lines; *line && good; line++) {
        if (g_str_has_prefix(*line, "Atoms") || g_str_has_prefix(*line, "Velocities")) {
            atoms = **line == 'A';
        } else {
            good = spheres_take(spheres, index_of, atoms, *line, path);
        }
    }
    g_hash_table_destroy(index_of);
    g_strfreev(lines);
    g_free(text);
    return good && (spheres->row->len > 0 || spheres_fail("holds no spheres", path));
}

#endif
