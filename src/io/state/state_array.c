#include "io/state/state_array.h"

#include "io/state/state_source.h"

static const char *in_memory(const struct gb_state_array *array)
{
    return *(const char *const *)(const void *)((const char *)array->state +
                                                array->member);
}

bool gb_state_array_exists(const struct gb_state_array *array)
{
    return in_memory(array) != NULL ||
           gb_state_source_has(array->state->source, array->member);
}

/* Rows begin .. end - 1, until the next call. */
static const void *rows_at(void *data, int64_t begin, int64_t end)
{
    const struct gb_state_array *array = data;
    const char *memory = in_memory(array);
    return memory != NULL ? memory + (size_t)begin * gb_hdf_row_bytes(&array->shape)
                          : gb_state_source_rows(array->state, array->member, begin, end);
}

void gb_state_array_sum(const struct gb_state_array *array, GChecksum *sum)
{
    struct gb_state_array of = *array;
    const int64_t rows = array->shape.rows, slab = gb_hdf_slab_rows(&array->shape);
    for (int64_t at = 0; at < rows; at += slab) {
        const int64_t end = at + slab < rows ? at + slab : rows;
        const size_t bytes = (size_t)(end - at) * gb_hdf_row_bytes(&array->shape);
        g_checksum_update(sum, rows_at(&of, at, end), (gssize)bytes);
    }
}

bool gb_state_array_put(const struct gb_state_array *array, struct gb_hdf *file,
                        struct gb_error *err)
{
    struct gb_state_array of = *array;
    return gb_hdf_put_rows(file, &array->shape, (struct gb_hdf_rows){rows_at, &of}, err);
}
