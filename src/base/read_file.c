#include "base/read_file.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glib.h>

#include "base/alloc.h"

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

/* Not blocking, so that a fifo is refused instead of waited for. */
int gb_read_file_open(const char *path, struct gb_error *err)
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

bool gb_read_file(const char *path, size_t most, char **text, size_t *length,
                  struct gb_error *err)
{
    const int file = gb_read_file_open(path, err);
    if (file < 0) {
        return false;
    }
    const bool good = load(file, path, most, text, length, err);
    close(file);
    return good;
}
