#include "io/line_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include <glib.h>

#include "base/file.h"

static bool write_error(const struct gb_line_file *rows, int why, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", rows->path,
                        g_strerror(why));
}

bool gb_line_file_open(struct gb_line_file *rows, const char *directory, const char *name,
                       struct gb_error *err)
{
    rows->path = g_build_filename(directory, name, NULL);
    rows->length = 0;
    rows->fd = open(rows->path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (rows->fd < 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made: %s", rows->path,
                            g_strerror(errno));
    }
    return true;
}

bool gb_line_file_reopen(struct gb_line_file *rows, const char *directory,
                         const char *name, off_t length, struct gb_error *err)
{
    char last = '\n';
    rows->path = g_build_filename(directory, name, NULL);
    rows->length = length;
    rows->fd = open(rows->path, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (rows->fd < 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be opened: %s", rows->path,
                            g_strerror(errno));
    }
    if (length < 0 || (length > 0 && pread(rows->fd, &last, 1, length - 1) != 1) ||
        last != '\n') {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: is not as the checkpoint left it: its first %lld bytes "
                            "should be whole lines",
                            rows->path, (long long)length);
    }
    return ftruncate(rows->fd, length) == 0 || write_error(rows, errno, err);
}

void gb_line_file_close(struct gb_line_file *rows)
{
    if (rows->fd >= 0) {
        close(rows->fd);
    }
    g_free(rows->path);
    *rows = (struct gb_line_file){.fd = -1};
}

/* A disk that is full takes a part before it says so; so does the test hook. */
static ssize_t write_some(const struct gb_line_file *rows, const char *text, size_t size,
                          off_t done)
{
    const bool may = gb_file_may_write();
    const ssize_t n = pwrite(rows->fd, text, may ? size : size / 2, rows->length + done);
    if (!may) {
        errno = ENOSPC;
    }
    return may ? n : -1;
}

bool gb_line_file_append(struct gb_line_file *rows, const char *text,
                         struct gb_error *err)
{
    const size_t size = strlen(text);
    size_t done = 0;
    while (done < size) {
        const ssize_t n = write_some(rows, text + done, size - done, (off_t)done);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            const int why = n < 0 ? errno : EIO;
            if (ftruncate(rows->fd, rows->length) != 0) {
                return write_error(rows, errno, err);
            }
            return write_error(rows, why, err);
        }
        done += (size_t)n;
    }
    rows->length += (off_t)size;
    return true;
}

bool gb_line_file_sync(const struct gb_line_file *rows, struct gb_error *err)
{
    return fsync(rows->fd) == 0 || write_error(rows, errno, err);
}

void gb_line_file_add_text(GString *line, const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        g_string_append_c(line, g_ascii_iscntrl(*c) ? '?' : *c);
    }
    g_string_append_c(line, '\n');
}
