#ifndef GB_TESTS_FUZZ_TARGET_H
#define GB_TESTS_FUZZ_TARGET_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* One reader of hostile input: libFuzzer calls it with what it invents, replay.c with the
 * corpus.  Whatever the input, the reader returns; an error is one line. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { TARGET_PATH = 64 };

/* The input as a file; its path lasts until target_close.  A file with a real name: HDF5
 * follows links to one before it opens anything, and memory files have none. */
static inline int target_open(const uint8_t *data, size_t size, char path[TARGET_PATH])
{
    snprintf(path, TARGET_PATH, "%s/greenbody-input-XXXXXX",
             access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    const int fd = mkstemp(path);
    if (fd < 0 || write(fd, data, size) != (ssize_t)size) {
        abort();
    }
    return fd;
}

static inline void target_close(int fd, const char *path)
{
    close(fd);
    unlink(path);
}

#endif
