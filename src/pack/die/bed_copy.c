#include "pack/die/bed_copy.h"

#include <string.h>

#include "base/alloc.h"
#include "pack/die/bed_list.h"
#include "pack/die/bed_welds.h"

struct gb_bed_copy {
    int64_t count;
    gb_bed_row *rows; /* positions, velocities, spins */
    struct gb_die die;
    struct gb_bed_list pairs, walls; /* what touches */
    struct gb_bed_welds *welds;
    double skin;
};

enum { ROW_KINDS = 3 };

static bool make_copy(struct gb_bed_copy **out, int64_t count, struct gb_error *err)
{
    struct gb_bed_copy *copy = gb_alloc_array(1, sizeof *copy, err);
    if (!copy) {
        return false;
    }
    copy->count = count;
    copy->rows = gb_alloc_array(ROW_KINDS * (size_t)count, sizeof *copy->rows, err);
    if (!copy->rows) {
        gb_bed_copy_destroy(copy);
        return false;
    }
    *out = copy;
    return true;
}

void gb_bed_copy_destroy(struct gb_bed_copy *copy)
{
    if (!copy) {
        return;
    }
    gb_alloc_free(copy->rows);
    gb_bed_list_finish(&copy->pairs);
    gb_bed_list_finish(&copy->walls);
    gb_bed_welds_destroy(copy->welds);
    gb_alloc_free(copy);
}

bool gb_bed_copy_take(const struct gb_bed *bed, struct gb_bed_copy **copy,
                      struct gb_error *err)
{
    if (!*copy && !make_copy(copy, bed->count, err)) {
        return false;
    }
    gb_bed_row *const rows[ROW_KINDS] = {bed->position, bed->velocity, bed->roll};
    for (int k = 0; k < ROW_KINDS; k++) {
        memcpy((*copy)->rows + k * bed->count, rows[k],
               (size_t)bed->count * sizeof *rows[k]);
    }
    (*copy)->die = bed->die;
    (*copy)->skin = bed->skin;
    return gb_bed_list_copy_touching(&(*copy)->pairs, &bed->pairs, bed->count, err) &&
           gb_bed_list_copy_touching(&(*copy)->walls, &bed->walls, bed->count, err) &&
           gb_bed_welds_copy(&(*copy)->welds, bed->welds, err);
}

bool gb_bed_copy_restore(struct gb_bed *bed, const struct gb_bed_copy *copy,
                         struct gb_error *err)
{
    gb_bed_row *const rows[ROW_KINDS] = {bed->position, bed->velocity, bed->roll};
    for (int k = 0; k < ROW_KINDS; k++) {
        memcpy(rows[k], copy->rows + k * bed->count,
               (size_t)bed->count * sizeof *rows[k]);
    }
    bed->die = copy->die;
    bed->skin = copy->skin;
    gb_bed_weigh(bed);   /* numbers may have changed */
    bed->listed = false; /* rebuilt at the next evaluation, from these: */
    return gb_bed_list_copy_touching(&bed->pairs, &copy->pairs, bed->count, err) &&
           gb_bed_list_copy_touching(&bed->walls, &copy->walls, bed->count, err) &&
           gb_bed_welds_copy(&bed->welds, copy->welds, err);
}

static uint64_t mix(uint64_t hash, const void *data, size_t bytes)
{
    const unsigned char *byte = data;
    for (size_t k = 0; k < bytes; k++) {
        hash = (hash ^ byte[k]) * UINT64_C(1099511628211); /* FNV-1a */
    }
    return hash;
}

static uint64_t mix_list(uint64_t hash, const struct gb_bed_list *list)
{
    const struct gb_bed_contacts *c = &list->contacts;
    for (int64_t slot = 0; slot < list->count; slot++) {
        if (c->normal[slot] < 0.0) {
            continue;
        }
        const double history[] = {c->deepest[slot], c->shear[0][slot], c->shear[1][slot],
                                  c->shear[2][slot]};
        hash = mix(hash, &list->first[slot], sizeof list->first[slot]);
        hash = mix(hash, &list->other[slot], sizeof list->other[slot]);
        hash = mix(hash, history, sizeof history);
    }
    return hash;
}

static uint64_t mix_welds(uint64_t hash, const struct gb_bed_welds *welds)
{
    for (int64_t k = 0; welds && k < welds->count; k++) {
        const double state[] = {welds->length[k], welds->radius[k], welds->force[0][k],
                                welds->force[1][k], welds->force[2][k]};
        hash = mix(hash, &welds->first[k], sizeof welds->first[k]);
        hash = mix(hash, &welds->other[k], sizeof welds->other[k]);
        hash = mix(hash, state, sizeof state);
    }
    return hash;
}

uint64_t gb_bed_copy_hash(const struct gb_bed *bed)
{
    const size_t bytes = (size_t)bed->count * sizeof(gb_bed_row);
    uint64_t hash = UINT64_C(14695981039346656037);
    hash = mix(hash, bed->position, bytes);
    hash = mix(hash, bed->velocity, bytes);
    hash = mix(hash, bed->roll, bytes);
    hash = mix(hash, &bed->die.punch_position, sizeof bed->die.punch_position);
    hash = mix(hash, &bed->die.punch_velocity, sizeof bed->die.punch_velocity);
    if (bed->die.bore != GB_DIE_BORE_ENDLESS) {
        hash = mix(hash, &bed->die.top, sizeof bed->die.top);
    }
    return mix_welds(mix_list(mix_list(hash, &bed->pairs), &bed->walls), bed->welds);
}
