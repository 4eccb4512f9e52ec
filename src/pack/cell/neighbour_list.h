#ifndef GB_PACK_CELL_NEIGHBOUR_LIST_H
#define GB_PACK_CELL_NEIGHBOUR_LIST_H

#include <stdbool.h>
#include <stdint.h>

#include "greenbody/status.h"
#include "pack/cell/neighbour_grid.h"

/* One half of the neighbour list: pairs (i, other[k]) with i < other[k] for k in
 * [start[i], start[i+1]), sorted by other within i; and its transpose, where anybody asks
 * for it. */
struct gb_pair_list {
    int64_t pair_count;
    int64_t capacity; /* pairs the arrays can hold */
    int64_t *start;   /* particles + 1 */
    /* One-way lists only, else NULL: behind the last pair of every block of particles
     * (pack/kernel/sweep.h).  What is left before the next block begins is free, so that a pair
     * more moves no other block: pairs of the block's last particle with an image of its
     * own, an edge away along every axis, which touch nobody. */
    int64_t *stop;
    int32_t *first; /* i of each pair, for loops that need not know where i changes */
    int32_t *other;
    uint8_t
        *image; /* which periodic image of other is meant; see gb_neighbour_list_shifts */
    int64_t *in_start; /* particles + 1: pairs in which j is the second particle ... */
    int32_t *in_slot;  /* ... as indices k, ascending */
};

/* A pair that was put into a list after it was built; see pack/cell/list_patch.h. */
struct gb_amendment {
    int32_t first, other, image;
    int32_t near; /* 1: into that list; 0: into `far` */
};

/* Verlet list.  Only pairs that can touch before the next build (nearer than 1 + skin)
 * are in `near` and carry a contact record; `far` ones can only attract across a gap. */
struct gb_neighbour_list {
    int64_t count; /* particles */
    /* Sizes, kept by the caller: a pair touches at the mean of its diameters, and skin
     * and cutoff - 1 are counted from there.  NULL: at 1. */
    const double *diameter;
    double largest; /* of them; else 1 */
    struct gb_pair_list near, far;
    bool one_way; /* without the transposes */
    /* of the last build: who was where, grid cell by grid cell: next[head[c]] ... */
    struct gb_neighbour_grid grid;
    int32_t *head, *next;
    int64_t head_capacity;
    /* and what the same lists can be built from again */
    double *built_at; /* count x 3: positions */
    double built_edge[3];
    double stretch[3]; /* affine scaling of the cell since */
    double strain;     /* largest affine strain since */
    /* pairs put in since, ascending */
    struct gb_amendment *amended;
    int64_t amended_count, amended_most;
};

bool gb_neighbour_list_init(struct gb_neighbour_list *pairs, int64_t count, bool one_way,
                            struct gb_error *err);
void gb_neighbour_list_finish(struct gb_neighbour_list *pairs);

/* Slots of a list, free ones as well. */
static inline int64_t gb_neighbour_list_slots(const struct gb_neighbour_list *pairs,
                                              const struct gb_pair_list *list)
{
    return list->start[pairs->count];
}

/* Marks a slot as one of those that are left at the end of the block of particle i. */
void gb_neighbour_list_vacate(struct gb_pair_list *list, int64_t slot, int64_t i);

/* Builds both lists for positions inside the cell, out to cutoff + skin, on so many
 * threads; what was in them is lost.  Errors:
 * GB_ERR_MEMORY, GB_ERR_GUARD when the cell has become too small for the reach or
 * particles crowd. */
bool gb_neighbour_list_build(struct gb_neighbour_list *pairs, const struct gb_cell *cell,
                             const double *position, double cutoff, double skin,
                             int threads, struct gb_error *err);

/* Lists without a pair, as nothing else is safe to read where a build has failed. */
void gb_neighbour_list_clear(struct gb_neighbour_list *pairs);

/* Longest way that one of the particles begin .. end - 1 has come since the build, beside
 * the affine motion; NaN when a position is not finite. */
double gb_neighbour_list_travel(const struct gb_neighbour_list *pairs,
                                const double *position, int64_t begin, int64_t end);

/* Takes note that the cell and all positions were scaled. */
void gb_neighbour_list_strain(struct gb_neighbour_list *pairs, const double factor[3]);

/* shift[image] is to be added to x_i - x_other. */
void gb_neighbour_list_shifts(const struct gb_cell *cell, double shift[27][3]);

#endif
