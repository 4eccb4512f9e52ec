#ifndef GB_PACK_KERNEL_SIMD_H
#define GB_PACK_KERNEL_SIMD_H

#include <stdbool.h>

#include "greenbody/status.h"

/* Loops compiled once per vector width of the processor family, chosen at run time. */
#if defined(__x86_64__)
#define GB_TARGET_256 __attribute__((target("avx2")))
#if defined(__clang__)
#define GB_TARGET_512 __attribute__((target("avx512f,avx512dq,avx512vl,avx512bw")))
#else
#define GB_TARGET_512                                                                    \
    __attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,prefer-vector-width="      \
                          "512")))
#endif
#endif

/* 1: loops are compiled once per level, 0: only once.  Under a sanitizer levels would differ
 * in nothing that it checks, and each takes a minute to compile. */
#if defined(__has_feature)
#define GB_SIMD_CLANG_CHECKS                                                             \
    (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define GB_SIMD_CLANG_CHECKS 0
#endif
#if !defined(__x86_64__) || defined(__SANITIZE_ADDRESS__) ||                             \
    defined(__SANITIZE_THREAD__) || GB_SIMD_CLANG_CHECKS
#define GB_SIMD_LEVELS 0
#else
#define GB_SIMD_LEVELS 1
#endif

/* The widest vectors that the environment allows: GB_SIMD = sse2, avx2 or avx512 limits
 * the program to those of an older processor.  Read once, before main. */
extern int gb_simd_most;

/* False, error set: GB_SIMD is set to something else. */
bool gb_simd_check(struct gb_error *err);

/* Name of the level with vectors of 128, 256 or 512 bits. */
const char *gb_simd_name(int width);

/* Bits of the widest vectors that this processor, the environment and the caller (0: no
 * limit) allow: 128, 256 or 512. */
static inline int gb_simd_width(int widest)
{
#if defined(__x86_64__)
    const int most = widest > 0 && widest < gb_simd_most ? widest : gb_simd_most;
    if (most >= 512 && __builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw")) {
        return 512;
    }
    return most >= 256 && __builtin_cpu_supports("avx2") ? 256 : 128;
#else
    (void)widest;
    return 128;
#endif
}

/* Defines `void name parameters` from the always-inlined `name_loop`, compiled once per
 * width.  Only for loops whose results do not depend on the order of lanes. */
#if GB_SIMD_LEVELS
#define GB_SIMD_WIDTHS(name, parameters, arguments)                                      \
    GB_TARGET_512 static void name##_512 parameters                                      \
    {                                                                                    \
        name##_loop arguments;                                                           \
    }                                                                                    \
    GB_TARGET_256 static void name##_256 parameters                                      \
    {                                                                                    \
        name##_loop arguments;                                                           \
    }                                                                                    \
    static void name parameters                                                          \
    {                                                                                    \
        const int width = gb_simd_width(0);                                              \
        if (width == 512) {                                                              \
            name##_512 arguments;                                                        \
        } else if (width == 256) {                                                       \
            name##_256 arguments;                                                        \
        } else {                                                                         \
            name##_loop arguments;                                                       \
        }                                                                                \
    }
#else
#define GB_SIMD_WIDTHS(name, parameters, arguments)                                      \
    static void name parameters                                                          \
    {                                                                                    \
        name##_loop arguments;                                                           \
    }
#endif

/* Defines the functions of a table of kernels and `const struct variant *table_for(int
 * widest)`, with VARIANTS rows; widest as in gb_simd_width.  The file defines `struct
 * variant` and three macros: VARIANT(name, attribute, terms...) with the functions of one
 * combination of terms, ROW(same) with its row and a comma, and COMBINATIONS(X, width,
 * attribute), which applies X to every combination. */
#define GB_SIMD_TABLE(width, attribute)                                                  \
    COMBINATIONS(VARIANT, width, attribute)                                              \
    static const struct variant width##_table[] = {COMBINATIONS(ROW, width, attribute)};
#if GB_SIMD_LEVELS
#define GB_SIMD_TABLES                                                                   \
    GB_SIMD_TABLE(w128, )                                                                \
    GB_SIMD_TABLE(w256, GB_TARGET_256)                                                   \
    GB_SIMD_TABLE(w512, GB_TARGET_512)                                                   \
    enum { VARIANTS = sizeof w128_table / sizeof w128_table[0] };                        \
    static const struct variant *table_for(int widest)                                   \
    {                                                                                    \
        const int width = gb_simd_width(widest);                                         \
        return width == 512 ? w512_table : width == 256 ? w256_table : w128_table;       \
    }
#else
#define GB_SIMD_TABLES                                                                   \
    GB_SIMD_TABLE(w128, )                                                                \
    enum { VARIANTS = sizeof w128_table / sizeof w128_table[0] };                        \
    static const struct variant *table_for(int widest)                                   \
    {                                                                                    \
        (void)widest;                                                                    \
        return w128_table;                                                               \
    }
#endif

#define GB_SIMD_LOOP static inline __attribute__((always_inline))

/* Prefetches a cache line into the L2 cache: the line fill buffers of L1 are few, and
 * other reads would wait for them. */
GB_SIMD_LOOP void gb_simd_fetch(const void *line)
{
    enum { TO_READ = 0, SECOND_CACHE = 2 };
    __builtin_prefetch(line, TO_READ, SECOND_CACHE);
}

#endif
