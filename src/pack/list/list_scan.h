#ifndef GB_PACK_LIST_LIST_SCAN_H
#define GB_PACK_LIST_LIST_SCAN_H

#include "pack/list/neighbour_list.h"

/* Scan of the bins around a particle for its neighbours; the inner part of a list build. */

/* Neighbours that one particle may have within the reach in bins: a dense packing of like
 * sizes has about a dozen. */
enum { GB_LIST_SCAN_MAX = 256 };

struct gb_list_scan_found {
    int32_t other;
    uint8_t image;
    bool near;
};

/* Upper bounds of the two lists: squared distances for diameters of 1, and the gaps that
 * they are made of. */
struct gb_list_scan_bounds {
    double near, far; /* squared, d^2 */
    double skin, gap; /* beyond contact: of `near`, of `far`, d */
};

struct gb_hgrid;

struct gb_list_scan {
    struct gb_neighbour_grid grid;
    struct gb_list_scan_bounds bounds;
    const struct gb_cell *cell;
    const double *position; /* count x 3, inside the cell */
    const double
        *sorted[3]; /* coordinates bin by bin: bin c is start[c] .. start[c + 1] */
    const double (*shift)[3];
    const int32_t *start, *particle;
    const double *diameter;            /* NULL: all are 1 */
    const struct gb_hgrid *candidates; /* instead of the bins; NULL: none */
};

/* Sorts the particles of the list into the bins of `scan->grid`, ascending within each.
 * Uses built_position of the list as scratch. */
bool gb_list_scan_sort(struct gb_list_scan *scan, struct gb_neighbour_list *list,
                       struct gb_error *err);

/* Room that the neighbours j > i of particle i need. */
int64_t gb_list_scan_most(const struct gb_list_scan *scan, int64_t i);

/* Neighbours j > i of particle i, sorted, at most so many; returns their number. */
int gb_list_scan_particle(const struct gb_list_scan *scan, int64_t i,
                          struct gb_list_scan_found *found);

#endif
