#ifndef GB_TESTS_FUZZ_TARGET_H
#define GB_TESTS_FUZZ_TARGET_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

/* One reader of hostile input: libFuzzer calls it with what it invents, replay.c with the
 * corpus.  Whatever the input, the reader returns; an error is one line. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { TARGET_PATH = 64 };

/* The input as a file in memory; its path lasts until target_close. */
static inline int target_open(const uint8_t *data, size_t size, char path[TARGET_PATH])
{
    const int fd = memfd_create("input", 0);
    if (fd < 0 || write(fd, data, size) != (ssize_t)size) {
        abort();
    }
    snprintf(path, TARGET_PATH, "/proc/self/fd/%d", fd);
    return fd;
}

static inline void target_close(int fd)
{
    close(fd);
}

#endif
