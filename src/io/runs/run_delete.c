#include "io/runs/run_delete.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/rundir.h"

/* Calls visit for each entry of the directory `name` in `parent`; false: an error of
 * visit, or of reading, in errno. */
static bool for_each(int parent, const char *name,
                     bool (*visit)(int folder, const char *entry, void *data), void *data)
{
    const int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR *dir = fd >= 0 ? fdopendir(fd) : NULL;
    const struct dirent *entry;
    bool good = dir != NULL;
    if (dir == NULL) {
        const int reason = errno;
        if (fd >= 0) {
            close(fd);
        }
        errno = reason;
        return false;
    }
    while (good && (entry = readdir(dir)) != NULL) {
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
            good = visit(fd, entry->d_name, data);
        }
    }
    const int reason = errno;
    closedir(dir);
    errno = reason;
    return good;
}

static bool is_directory(int folder, const char *name)
{
    struct stat info;
    return fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) == 0 &&
           S_ISDIR(info.st_mode);
}

static bool remove_entry(int folder, const char *name, void *data)
{
    if (is_directory(folder, name)) {
        return for_each(folder, name, remove_entry, data) &&
               unlinkat(folder, name, AT_REMOVEDIR) == 0;
    }
    return unlinkat(folder, name, 0) == 0;
}

static bool count_entry(int folder, const char *name, void *data)
{
    if (is_directory(folder, name)) {
        return for_each(folder, name, count_entry, data);
    }
    *(int *)data += strcmp(name, ".lock") != 0; /* which is no file of the run */
    return true;
}

int gb_run_delete_count(const char *directory)
{
    int count = 0;
    (void)for_each(AT_FDCWD, directory, count_entry, &count);
    return count;
}

bool gb_run_delete(const char *directory, struct gb_error *err)
{
    struct gb_rundir dir;
    if (!gb_rundir_open(&dir, directory, err)) {
        return false;
    }
    const bool good =
        for_each(AT_FDCWD, directory, remove_entry, NULL) && rmdir(directory) == 0;
    const int reason = errno;
    gb_rundir_finish(&dir);
    return good || gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be removed: %s",
                                directory, strerror(reason));
}
