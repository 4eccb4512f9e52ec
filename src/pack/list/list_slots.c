#include "pack/list/list_slots.h"

#include <string.h>

#include "base/alloc.h"
#include "pack/list/blocks.h"

bool gb_list_slots_init(struct gb_list_slots *slots, int64_t capacity,
                        struct gb_error *err)
{
    const size_t n = (size_t)capacity;
    slots->count = 0;
    slots->at = gb_alloc_array(n, sizeof *slots->at, err);
    slots->pair = gb_alloc_array(n, sizeof *slots->pair, err);
    return slots->at && slots->pair;
}

void gb_list_slots_finish(struct gb_list_slots *slots)
{
    gb_alloc_free(slots->at);
    gb_alloc_free(slots->pair);
    *slots = (struct gb_list_slots){0};
}

static int64_t block_of(const struct gb_neighbour_list *list, int64_t i)
{
    return i / gb_blocks_size(list->count);
}

/* One past the last pair of particle i. */
static int64_t end_of(const struct gb_neighbour_list *list,
                      const struct gb_pair_list *pairs, int64_t i)
{
    const int64_t stop = pairs->stop[block_of(list, i)];
    return pairs->start[i + 1] < stop ? pairs->start[i + 1] : stop;
}

int64_t gb_list_slots_find(const struct gb_neighbour_list *list,
                           const struct gb_pair_list *pairs,
                           const struct gb_inserted_pair *pair)
{
    const int64_t end = end_of(list, pairs, pair->first);
    int64_t k = pairs->start[pair->first];
    while (k < end && pairs->other[k] < pair->other) {
        k++;
    }
    return k;
}

bool gb_list_slots_holds(const struct gb_neighbour_list *list,
                         const struct gb_pair_list *pairs,
                         const struct gb_inserted_pair *pair)
{
    const int64_t k = gb_list_slots_find(list, pairs, pair);
    return k < end_of(list, pairs, pair->first) && pairs->other[k] == pair->other;
}

void gb_list_slots_add(struct gb_list_slots *slots, const struct gb_neighbour_list *list,
                       const struct gb_pair_list *pairs,
                       const struct gb_inserted_pair *pair)
{
    slots->at[slots->count] = gb_list_slots_find(list, pairs, pair);
    slots->pair[slots->count++] = pair;
}

/* Splits off the changes of the block of the first one; the others are left in *slots. */
static struct gb_list_slots take_block(const struct gb_neighbour_list *list,
                                       struct gb_list_slots *slots, int64_t *b)
{
    struct gb_list_slots own = *slots;
    *b = block_of(list, own.pair[0]->first);
    own.count = 0;
    while (own.count < slots->count && block_of(list, own.pair[own.count]->first) == *b) {
        own.count++;
    }
    slots->at += own.count;
    slots->pair += own.count;
    slots->count -= own.count;
    return own;
}

bool gb_list_slots_fit(const struct gb_neighbour_list *list,
                       const struct gb_pair_list *pairs, struct gb_list_slots slots)
{
    while (slots.count > 0) {
        int64_t b;
        const struct gb_list_slots own = take_block(list, &slots, &b);
        const int64_t end = gb_blocks_end(list->count, b);
        if (pairs->stop[b] + own.count > pairs->start[end]) {
            return false;
        }
    }
    return true;
}

bool gb_list_slots_cross(const struct gb_list_slots *slots, int64_t count)
{
    const int64_t size = gb_blocks_size(count);
    for (int p = 0; p < slots->count; p++) {
        if (slots->pair[p]->first / size != slots->pair[p]->other / size) {
            return true;
        }
    }
    return false;
}

/* Opens a gap before every slot, in an array of items of `size` bytes that ends at `end`. */
static void open_gaps(void *array, size_t size, int64_t end,
                      const struct gb_list_slots *slots)
{
    char *byte = array;
    for (int p = slots->count - 1; p >= 0; p--) {
        const int64_t at = slots->at[p];
        memmove(byte + (size_t)(at + p + 1) * size, byte + (size_t)at * size,
                (size_t)(end - at) * size);
        end = at;
    }
}

/* Removes the item of every slot. */
static void close_gaps(void *array, size_t size, int64_t end,
                       const struct gb_list_slots *slots)
{
    char *byte = array;
    for (int p = 0; p < slots->count; p++) {
        const int64_t from = slots->at[p] + 1;
        const int64_t to = p + 1 < slots->count ? slots->at[p + 1] : end;
        memmove(byte + (size_t)(from - p - 1) * size, byte + (size_t)from * size,
                (size_t)(to - from) * size);
    }
}

typedef void move_items(void *array, size_t size, int64_t end,
                        const struct gb_list_slots *slots);

static void move_pairs(struct gb_pair_list *pairs, move_items *move, int64_t end,
                       const struct gb_list_slots *slots)
{
    move(pairs->first, sizeof *pairs->first, end, slots);
    move(pairs->other, sizeof *pairs->other, end, slots);
    move(pairs->image, sizeof *pairs->image, end, slots);
    move(pairs->row, sizeof *pairs->row, end, slots);
}

/* Moves the starts of the particles of block b behind the slots, and its stop. */
static void shift_starts(struct gb_pair_list *pairs, int64_t particles, int64_t b,
                         const struct gb_list_slots *slots, int64_t sign)
{
    const int64_t end = gb_blocks_end(particles, b);
    int p = 0;
    for (int64_t i = slots->pair[0]->first + 1; i < end; i++) {
        while (p < slots->count && slots->pair[p]->first < i) {
            p++;
        }
        pairs->start[i] += sign * p;
    }
    pairs->stop[b] += sign * slots->count;
    pairs->pair_count += sign * slots->count;
}

/* Records for inserted near pairs: not in contact. */
static void insert_contacts(struct gb_contacts *contacts, int64_t end,
                            const struct gb_list_slots *slots)
{
    for (int p = 0; p < contacts->planes; p++) {
        open_gaps(contacts->plane[p], gb_real_size(contacts->real), end, slots);
    }
    for (int p = 0; p < slots->count; p++) {
        gb_contacts_clear(contacts, slots->at[p] + p);
    }
}

void gb_list_slots_insert(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                          struct gb_contacts *contacts, struct gb_list_slots slots)
{
    while (slots.count > 0) {
        int64_t b;
        const struct gb_list_slots own = take_block(list, &slots, &b);
        if (contacts) {
            insert_contacts(contacts, pairs->stop[b], &own);
        }
        move_pairs(pairs, open_gaps, pairs->stop[b], &own);
        for (int p = 0; p < own.count; p++) {
            const int64_t k = own.at[p] + p;
            pairs->first[k] = own.pair[p]->first;
            pairs->other[k] = own.pair[p]->other;
            pairs->image[k] = (uint8_t)own.pair[p]->image;
            pairs->row[k] = own.pair[p]->other; /* of a pair that crosses: set later */
        }
        shift_starts(pairs, list->count, b, &own, 1);
    }
}

void gb_list_slots_remove(struct gb_neighbour_list *list, struct gb_pair_list *pairs,
                          struct gb_list_slots slots)
{
    while (slots.count > 0) {
        int64_t b;
        const struct gb_list_slots own = take_block(list, &slots, &b);
        move_pairs(pairs, close_gaps, pairs->stop[b], &own);
        shift_starts(pairs, list->count, b, &own, -1);
        for (int p = 0; p < own.count; p++) {
            gb_neighbour_list_free_slot(pairs, pairs->stop[b] + p,
                                        gb_blocks_end(list->count, b) - 1);
        }
    }
}
