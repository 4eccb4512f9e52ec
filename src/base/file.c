#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/alloc.h"
#include "greenbody/status.h"

static bool read_all(int file, char *text, size_t size, size_t *length)
{
    while (*length < size) {
        const ssize_t got = read(file, text + *length, size - *length);
        if (got == 0) {
            return true;
        }
        if (got > 0) {
            *length += (size_t)got;
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

static bool load(int file, const char *path, size_t most, char **text, size_t *length,
                 struct gb_error *err)
{
    struct stat info = {0};
    (void)fstat(file, &info);
    const size_t size = (size_t)info.st_size;
    if (size > most) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: must be at most %zu bytes", path,
                            most);
    }
    *length = 0;
    *text = gb_alloc_array(size + 1, 1, err);
    if (*text == NULL) {
        return false;
    }
    if (!read_all(file, *text, size, length)) {
        gb_error_set(err, GB_ERR_MACHINE, "%s: %s", path, g_strerror(errno));
        gb_alloc_free(*text);
        *text = NULL;
        return false;
    }
    return true;
}

/* O_NONBLOCK: a fifo is refused instead of waiting for its writer */
int gb_file_open(const char *path, struct gb_error *err)
{
    struct stat info = {0};
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) {
        const bool absent = errno == ENOENT || errno == ENOTDIR;
        gb_error_set(err, absent ? GB_ERR_INPUT : GB_ERR_MACHINE, "%s: %s", path,
                     g_strerror(errno));
    } else if (fstat(file, &info) != 0 || !S_ISREG(info.st_mode)) {
        gb_error_set(err, GB_ERR_INPUT, "%s: is not a regular file", path);
        close(file);
        return -1;
    }
    return file;
}

bool gb_file_read(const char *path, size_t most, char **text, size_t *length,
                  struct gb_error *err)
{
    const int file = gb_file_open(path, err);
    if (file < 0) {
        return false;
    }
    const bool good = load(file, path, most, text, length, err);
    close(file);
    return good;
}

/* The part of GLib's message after the last colon. */
const char *gb_file_reason(const GError *error)
{
    const char *colon = strrchr(error->message, ':');
    return colon != NULL && colon[1] == ' ' ? colon + 2 : error->message;
}

/* Mutable state: the test hook. */
static _Atomic long fail_countdown;

long gb_file_fail_after(long k)
{
    return atomic_exchange(&fail_countdown, k);
}

bool gb_file_may_write(void)
{
    const bool fails =
        atomic_load(&fail_countdown) > 0 && atomic_fetch_sub(&fail_countdown, 1) == 1;
    if (fails) {
        errno = ENOSPC;
    }
    return !fails;
}

/* write(2), or failure of the test hook, which acts like a full disk. */
static ssize_t write_some(int fd, off_t at, const char *data, size_t size)
{
    const bool may = gb_file_may_write();
    const ssize_t n = pwrite(fd, data, may ? size : size / 2, at);
    if (!may) {
        errno = ENOSPC;
    }
    return may ? n : -1;
}

bool gb_file_append_at(int fd, off_t at, const char *data, size_t size)
{
    size_t done = 0;
    while (done < size) {
        const ssize_t n = write_some(fd, at + (off_t)done, data + done, size - done);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            const int why = n < 0 ? errno : EIO;
            errno = ftruncate(fd, at) != 0 ? errno : why;
            return false;
        }
        done += (size_t)n;
    }
    return true;
}

bool gb_file_check_target(const char *path, struct gb_error *err)
{
    struct stat info;
    if (path[0] == '\0') {
        return gb_error_set(err, GB_ERR_INPUT, "the name of the output file is empty");
    }
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode)) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: is not a regular file", path);
    }
    char *folder = g_path_get_dirname(path);
    const bool writable = access(folder, W_OK | X_OK) == 0;
    const int why = errno;
    const bool is_folder = g_file_test(folder, G_FILE_TEST_IS_DIR);
    g_free(folder);
    if (!writable || !is_folder) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                            g_strerror(writable ? ENOTDIR : why));
    }
    return true;
}

bool gb_file_replace(const char *path, const void *data, size_t size,
                     struct gb_error *err)
{
    if (!gb_file_check_target(path, err)) {
        return false;
    }
    if (!gb_file_may_write()) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                            g_strerror(errno));
    }
    GError *error = NULL;
    const GFileSetContentsFlags flags =
        G_FILE_SET_CONTENTS_CONSISTENT | G_FILE_SET_CONTENTS_DURABLE;
    if (g_file_set_contents_full(path, data, (gssize)size, flags, 0666, &error)) {
        return true;
    }
    gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                 gb_file_reason(error));
    g_error_free(error);
    return false;
}

/* Syncs a folder, so that a new name in it survives a power failure. */
static bool sync_folder(const char *path)
{
    char *folder = g_path_get_dirname(path);
    const int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool done = fd >= 0 && fsync(fd) == 0;
    if (fd >= 0) {
        (void)close(fd);
    }
    g_free(folder);
    return done;
}

bool gb_file_replace_by(const char *path, const char *temporary, int fd, size_t size,
                        struct gb_error *err)
{
    if (!gb_file_check_target(path, err)) {
        return false;
    }
    if (!gb_file_may_write() || ftruncate(fd, (off_t)size) != 0 || fsync(fd) != 0 ||
        rename(temporary, path) != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", path,
                            g_strerror(errno));
    }
    (void)sync_folder(path); /* some file systems cannot sync folders */
    return true;
}

bool gb_file_is_same(const char *a, const char *b)
{
    char *first = g_canonicalize_filename(a, NULL);
    char *second = g_canonicalize_filename(b, NULL);
    const bool same = strcmp(first, second) == 0;
    g_free(first);
    g_free(second);
    return same;
}
