#include "pack/die/bed_blocks.h"

#include <string.h>

#include "base/alloc.h"

int64_t gb_bed_blocks_size(int64_t particles)
{
    int64_t size = GB_BED_BLOCKS_SIZE;
    while (size < GB_BED_BLOCKS_SIZE_MAX && particles >= 2 * size * GB_BED_BLOCKS_LEFT) {
        size *= 2;
    }
    return size;
}

int64_t gb_bed_blocks_begin(int64_t particles, int64_t b)
{
    return b * gb_bed_blocks_size(particles);
}

int64_t gb_bed_blocks_end(int64_t particles, int64_t b)
{
    const int64_t end = gb_bed_blocks_begin(particles, b + 1);
    return end < particles ? end : particles;
}

static void release_crossings(struct gb_bed_blocks *blocks)
{
    gb_alloc_free(blocks->target);
    gb_alloc_free(blocks->row);
    gb_alloc_free(blocks->row_particle);
    blocks->target = blocks->row = blocks->row_particle = NULL;
    blocks->room = 0;
}

static bool make_room(struct gb_bed_blocks *blocks, int64_t crossings,
                      struct gb_error *err)
{
    if (crossings <= blocks->room) {
        return true;
    }
    const size_t room = (size_t)(crossings + crossings / 4);
    release_crossings(blocks);
    blocks->target = gb_alloc_array(room, sizeof *blocks->target, err);
    blocks->row = gb_alloc_array(room, sizeof *blocks->row, err);
    blocks->row_particle = gb_alloc_array(room, sizeof *blocks->row_particle, err);
    if (!blocks->target || !blocks->row || !blocks->row_particle) {
        release_crossings(blocks);
        return false;
    }
    blocks->room = (int64_t)room;
    return true;
}

bool gb_bed_blocks_init(struct gb_bed_blocks *blocks, int64_t particles,
                        struct gb_error *err)
{
    const int64_t size = gb_bed_blocks_size(particles);
    const int64_t count = (particles + size - 1) / size;
    const size_t ends = (size_t)count + 1;
    *blocks = (struct gb_bed_blocks){.count = count, .size = size};
    blocks->block = gb_alloc_array((size_t)count, sizeof *blocks->block, err);
    blocks->cost = gb_alloc_array(ends, sizeof *blocks->cost, err);
    blocks->crossing = gb_alloc_array(ends, sizeof *blocks->crossing, err);
    blocks->entry = gb_alloc_array(ends, sizeof *blocks->entry, err);
    if (!blocks->block || !blocks->cost || !blocks->crossing || !blocks->entry ||
        !make_room(blocks, 2 * particles, err)) {
        gb_bed_blocks_finish(blocks);
        return false;
    }
    return true;
}

void gb_bed_blocks_finish(struct gb_bed_blocks *blocks)
{
    gb_alloc_free(blocks->block);
    gb_alloc_free(blocks->cost);
    gb_alloc_free(blocks->crossing);
    gb_alloc_free(blocks->entry);
    release_crossings(blocks);
    *blocks = (struct gb_bed_blocks){0};
}

bool gb_bed_blocks_number(struct gb_bed_blocks *blocks, struct gb_error *err)
{
    for (int64_t b = 0; b < blocks->count; b++) {
        blocks->crossing[b + 1] = blocks->crossing[b] + blocks->block[b].crossings;
    }
    return make_room(blocks, blocks->crossing[blocks->count], err);
}

void gb_bed_blocks_enter(struct gb_bed_blocks *blocks)
{
    int64_t *entry = blocks->entry;
    const int64_t crossings = blocks->crossing[blocks->count];
    memset(entry, 0, ((size_t)blocks->count + 1) * sizeof *entry);
    for (int64_t c = 0; c < crossings; c++) {
        entry[blocks->target[c] / blocks->size + 1]++;
    }
    for (int64_t b = 0; b < blocks->count; b++) {
        entry[b + 1] += entry[b];
    }
    for (int64_t c = 0; c < crossings; c++) { /* entry[b] becomes the end of block b */
        const int32_t particle = blocks->target[c];
        const int64_t e = entry[particle / blocks->size]++;
        blocks->row[e] = (int32_t)c;
        blocks->row_particle[e] = particle;
    }
    memmove(entry + 1, entry, (size_t)blocks->count * sizeof *entry);
    entry[0] = 0;
}
