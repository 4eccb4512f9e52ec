#ifndef GB_PACK_KERNEL_REGISTER_ROWS_H
#define GB_PACK_KERNEL_REGISTER_ROWS_H

/* Rows of numbers in a register, and the transposition of four or eight of them into columns
 * and back: in memory a particle is a row, and the laws work on columns of many contacts. */

#include <stdint.h>
#include <string.h>

#define GB_ROW_INLINE static inline __attribute__((always_inline))

typedef float gb_row __attribute__((vector_size(16)));
typedef float gb_row_pair __attribute__((vector_size(32))); /* two of them */
typedef int32_t gb_row_int __attribute__((vector_size(16)));
typedef int32_t gb_row_int_pair __attribute__((vector_size(32)));
typedef uint32_t gb_row_word __attribute__((vector_size(16)));
typedef uint32_t gb_row_word_pair __attribute__((vector_size(32)));

GB_ROW_INLINE gb_row gb_row_load(const float *from)
{
    gb_row row;
    memcpy(&row, from, sizeof row);
    return row;
}

GB_ROW_INLINE void gb_row_store(float *to, gb_row row)
{
    memcpy(to, &row, sizeof row);
}

/* Two rows beside each other. */
GB_ROW_INLINE void gb_row_beside(const float *low, const float *high, gb_row_pair *both)
{
    *both = __builtin_shufflevector(gb_row_load(low), gb_row_load(high), 0, 1, 2, 3, 4, 5,
                                    6, 7);
}

/* Two rows of whole numbers beside each other. */
GB_ROW_INLINE void gb_row_words_beside(const int32_t *low, const int32_t *high,
                                       gb_row_word_pair *both)
{
    gb_row_word of_low, of_high;
    memcpy(&of_low, low, sizeof of_low);
    memcpy(&of_high, high, sizeof of_high);
    *both = __builtin_shufflevector(of_low, of_high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/* Raises `most` to x, number by number. */
GB_ROW_INLINE void gb_row_pair_raise(gb_row_pair *most, const gb_row_pair *x)
{
    const gb_row_int_pair above = *x > *most;
    *most =
        (gb_row_pair)(((gb_row_int_pair)*x & above) | ((gb_row_int_pair)*most & ~above));
}

/* The low halves of two such pairs beside each other, and the high ones. */
#define GB_ROW_PAIR_LOW(a, b) __builtin_shufflevector((a), (b), 0, 1, 2, 3, 8, 9, 10, 11)
#define GB_ROW_PAIR_HIGH(a, b)                                                           \
    __builtin_shufflevector((a), (b), 4, 5, 6, 7, 12, 13, 14, 15)

/* The first three numbers of rows l (low halves) and l + 4 (high halves), as columns of
 * eight. */
GB_ROW_INLINE void gb_row_pair_columns(const gb_row_pair row[4], gb_row_pair column[3])
{
    const gb_row_pair low01 =
        __builtin_shufflevector(row[0], row[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const gb_row_pair low23 =
        __builtin_shufflevector(row[2], row[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const gb_row_pair high01 =
        __builtin_shufflevector(row[0], row[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const gb_row_pair high23 =
        __builtin_shufflevector(row[2], row[3], 2, 10, 3, 11, 6, 14, 7, 15);
    column[0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
    column[1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
    column[2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
}

/* Back: rows of three columns; their fourth numbers are 0. */
GB_ROW_INLINE void gb_row_of_columns(const float *x, const float *y, const float *z,
                                     gb_row row[4])
{
    const gb_row none = {0.0F}, xs = gb_row_load(x), ys = gb_row_load(y);
    const gb_row zs = gb_row_load(z);
    const gb_row xy = __builtin_shufflevector(xs, ys, 0, 4, 1, 5);
    const gb_row yx = __builtin_shufflevector(xs, ys, 2, 6, 3, 7);
    const gb_row z0 = __builtin_shufflevector(zs, none, 0, 4, 1, 5);
    const gb_row z1 = __builtin_shufflevector(zs, none, 2, 6, 3, 7);
    row[0] = __builtin_shufflevector(xy, z0, 0, 1, 4, 5);
    row[1] = __builtin_shufflevector(xy, z0, 2, 3, 6, 7);
    row[2] = __builtin_shufflevector(yx, z1, 0, 1, 4, 5);
    row[3] = __builtin_shufflevector(yx, z1, 2, 3, 6, 7);
}

/* Adds a row to `to`. */
GB_ROW_INLINE void gb_row_add(float *to, gb_row row)
{
    gb_row_store(to, gb_row_load(to) + row);
}

/* The same for rows of eight; by address, as some compilers refuse them by value. */
GB_ROW_INLINE void gb_row_pair_add(float *to, const gb_row_pair *row)
{
    gb_row_pair sum;
    memcpy(&sum, to, sizeof sum);
    sum += *row;
    memcpy(to, &sum, sizeof sum);
}

/* Adds row number l to a sum if l < n, without a branch that the processor would
 * mispredict. */
GB_ROW_INLINE void gb_row_sum_if(gb_row_pair *sum, const float *row, int l, int n)
{
    const gb_row_int_pair ns = {n, n, n, n, n, n, n, n}, ls = {l, l, l, l, l, l, l, l};
    gb_row_int_pair bits;
    gb_row_pair kept;
    memcpy(&bits, row, sizeof bits);
    bits &= ls < ns;
    memcpy(&kept, &bits, sizeof kept);
    *sum += kept;
}

/* Three columns of eight as rows: l in the low halves, l + 4 in the high ones; their fourth
 * numbers are 0. */
GB_ROW_INLINE void gb_row_pair_rows(const float *x, const float *y, const float *z,
                                    gb_row_pair row[4])
{
    const gb_row_pair none = {0.0F};
    gb_row_pair xs, ys, zs;
    memcpy(&xs, x, sizeof xs);
    memcpy(&ys, y, sizeof ys);
    memcpy(&zs, z, sizeof zs);
    const gb_row_pair xy = __builtin_shufflevector(xs, ys, 0, 8, 1, 9, 4, 12, 5, 13);
    const gb_row_pair yx = __builtin_shufflevector(xs, ys, 2, 10, 3, 11, 6, 14, 7, 15);
    const gb_row_pair z0 = __builtin_shufflevector(zs, none, 0, 8, 1, 9, 4, 12, 5, 13);
    const gb_row_pair z1 = __builtin_shufflevector(zs, none, 2, 10, 3, 11, 6, 14, 7, 15);
    row[0] = __builtin_shufflevector(xy, z0, 0, 1, 8, 9, 4, 5, 12, 13);
    row[1] = __builtin_shufflevector(xy, z0, 2, 3, 10, 11, 6, 7, 14, 15);
    row[2] = __builtin_shufflevector(yx, z1, 0, 1, 8, 9, 4, 5, 12, 13);
    row[3] = __builtin_shufflevector(yx, z1, 2, 3, 10, 11, 6, 7, 14, 15);
}

#endif
