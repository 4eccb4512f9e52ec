#include "pack/kernel/simd.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    int bits;
} levels[] = {{"sse2", 128}, {"avx2", 256}, {"avx512", 512}};

enum { LEVELS = sizeof levels / sizeof levels[0], MOST = 512 };

int gb_simd_most = MOST;

/* 0: no such level. */
static int bits_of(const char *name)
{
    for (int i = 0; i < LEVELS; i++) {
        if (strcmp(name, levels[i].name) == 0) {
            return levels[i].bits;
        }
    }
    return 0;
}

/* Before main, hence before any thread: the loops read it without a lock. */
__attribute__((constructor)) static void read_environment(void)
{
    const char *name = getenv("GB_SIMD");
    const int bits = name != NULL ? bits_of(name) : MOST;
    gb_simd_most = bits > 0 ? bits : MOST;
}

bool gb_simd_check(struct gb_error *err)
{
    const char *name = getenv("GB_SIMD");
    return name == NULL || bits_of(name) > 0 ||
           gb_error_set(err, GB_ERR_INPUT,
                        "GB_SIMD = %.40s: must be one of sse2, avx2, avx512", name);
}

const char *gb_simd_name(int width)
{
    for (int i = 0; i < LEVELS; i++) {
        if (levels[i].bits == width) {
#if defined(__x86_64__)
            return levels[i].name;
#else
            return "compiler's";
#endif
        }
    }
    return "none";
}
