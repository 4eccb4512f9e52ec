/* For LD_PRELOAD: each fsync and rename that succeeds is a line of the file $SYNC_LOG. */
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int fsync(int fd);
int rename(const char *from, const char *to);

static void note(const char *call, const char *path)
{
    char line[PATH_MAX + 16];
    const char *log = getenv("SYNC_LOG");
    const int fd =
        log != NULL ? open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666) : -1;
    if (fd >= 0) {
        const int length = snprintf(line, sizeof line, "%s %s\n", call, path);
        (void)!write(fd, line, (size_t)length);
        close(fd);
    }
}

int fsync(int fd)
{
    int (*real)(int) = NULL;
    *(void **)(void *)&real = dlsym(RTLD_NEXT, "fsync");
    const int result = real(fd);
    if (result == 0) {
        char name[64];
        char path[PATH_MAX] = "";
        snprintf(name, sizeof name, "/proc/self/fd/%d", fd);
        (void)!readlink(name, path, sizeof path - 1);
        note("fsync", path);
    }
    return result;
}

int rename(const char *from, const char *to)
{
    int (*real)(const char *, const char *) = NULL;
    *(void **)(void *)&real = dlsym(RTLD_NEXT, "rename");
    const int result = real(from, to);
    if (result == 0) {
        const char *slash = strrchr(to, '/');
        note("rename", slash != NULL ? slash + 1 : to);
    }
    return result;
}
