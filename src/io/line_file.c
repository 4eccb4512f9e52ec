#include "io/line_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glib.h>

#include "base/file.h"
#include "base/record.h"
#include "io/text_file.h"

/* Adds whole lines to the text in memory. */
static void remember(struct gb_line_file *rows, const char *text, size_t size)
{
    g_string_append_len(rows->text, text, (gssize)size);
    rows->sum = gb_record_fnv(rows->sum, text, size);
    rows->length = (off_t)rows->text->len;
}

static void note_time(struct gb_line_file *rows)
{
    struct stat info;
    if (fstat(rows->fd, &info) == 0) {
        rows->modified = info.st_mtim;
    }
}

static bool write_error(const struct gb_line_file *rows, int why, struct gb_error *err)
{
    return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be written: %s", rows->path,
                        g_strerror(why));
}

static void begin(struct gb_line_file *rows, const char *directory, const char *name)
{
    *rows = (struct gb_line_file){.path = g_build_filename(directory, name, NULL),
                                  .fd = -1,
                                  .text = g_string_new(NULL),
                                  .sum = GB_RECORD_FNV};
}

bool gb_line_file_open(struct gb_line_file *rows, const char *directory, const char *name,
                       struct gb_error *err)
{
    begin(rows, directory, name);
    rows->fd = open(rows->path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (rows->fd < 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be made: %s", rows->path,
                            g_strerror(errno));
    }
    note_time(rows);
    return true;
}

/* The first `length` bytes of the file into memory; false when there are fewer. */
static bool read_lines(struct gb_line_file *rows, off_t length)
{
    char part[1 << 16];
    while (rows->length < length) {
        const size_t wanted = (size_t)MIN((off_t)sizeof part, length - rows->length);
        const ssize_t n = pread(rows->fd, part, wanted, rows->length);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            return false;
        }
        remember(rows, part, (size_t)n);
    }
    return length == 0 || rows->text->str[length - 1] == '\n';
}

bool gb_line_file_reopen(struct gb_line_file *rows, const char *directory,
                         const char *name, off_t length, struct gb_error *err)
{
    begin(rows, directory, name);
    rows->fd = open(rows->path, O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (rows->fd < 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "%s: cannot be opened: %s", rows->path,
                            g_strerror(errno));
    }
    struct stat info;
    if (fstat(rows->fd, &info) != 0 || !S_ISREG(info.st_mode)) {
        return gb_error_set(err, GB_ERR_INPUT, "%s: is not a regular file", rows->path);
    }
    if (length < 0 || !read_lines(rows, length)) {
        return gb_error_set(err, GB_ERR_INPUT,
                            "%s: is not as the checkpoint left it: its first %lld bytes "
                            "should be whole lines",
                            rows->path, (long long)length);
    }
    note_time(rows);
    return true;
}

bool gb_line_file_cut(const struct gb_line_file *rows, struct gb_error *err)
{
    return ftruncate(rows->fd, rows->length) == 0 || write_error(rows, errno, err);
}

void gb_line_file_close(struct gb_line_file *rows)
{
    if (rows->fd >= 0) {
        close(rows->fd);
    }
    g_free(rows->path);
    if (rows->text != NULL) {
        g_string_free(rows->text, TRUE);
    }
    *rows = (struct gb_line_file){.fd = -1};
}

/* The same file of the same size, not written since. */
static bool is_untouched(const struct gb_line_file *rows)
{
    struct stat ours, named;
    return fstat(rows->fd, &ours) == 0 && lstat(rows->path, &named) == 0 &&
           ours.st_dev == named.st_dev && ours.st_ino == named.st_ino &&
           named.st_size == rows->length &&
           named.st_mtim.tv_sec == rows->modified.tv_sec &&
           named.st_mtim.tv_nsec == rows->modified.tv_nsec;
}

/* The file at the path has the lines and is the one that is open: network file systems
 * may give it another time. */
static bool is_equal(struct gb_line_file *rows)
{
    struct stat ours, named;
    char part[1 << 16];
    off_t at = 0;
    if (fstat(rows->fd, &ours) != 0 || lstat(rows->path, &named) != 0 ||
        ours.st_dev != named.st_dev || ours.st_ino != named.st_ino ||
        named.st_size != rows->length) {
        return false;
    }
    while (at < rows->length) {
        const ssize_t n = pread(rows->fd, part, sizeof part, at);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0 || at + n > rows->length ||
            memcmp(part, rows->text->str + at, (size_t)n) != 0) {
            return false;
        }
        at += n;
    }
    note_time(rows);
    return true;
}

/* The descriptor keeps its number: another thread may be syncing it. */
static bool write_again(struct gb_line_file *rows, struct gb_error *err)
{
    if (!gb_text_file_replace(rows->path, rows->text->str, rows->text->len,
                              GB_TEXT_FILE_OF_RUN, err)) {
        return false;
    }
    const int fd = open(rows->path, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    const bool moved =
        fd >= 0 && dup2(fd, rows->fd) >= 0 && fcntl(rows->fd, F_SETFD, FD_CLOEXEC) == 0;
    const int why = errno;
    if (fd >= 0) {
        close(fd);
    }
    if (!moved) {
        return write_error(rows, why, err);
    }
    note_time(rows);
    rows->restored = true;
    return true;
}

bool gb_line_file_check(struct gb_line_file *rows, bool whole, struct gb_error *err)
{
    return (!whole && is_untouched(rows)) || is_equal(rows) || write_again(rows, err);
}

bool gb_line_file_append(struct gb_line_file *rows, const char *text,
                         struct gb_error *err)
{
    const size_t size = strlen(text);
    if (!gb_line_file_check(rows, false, err)) {
        return false;
    }
    if (!gb_file_append_at(rows->fd, rows->length, text, size)) {
        return write_error(rows, errno, err);
    }
    remember(rows, text, size);
    note_time(rows);
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
