#include "tui/term/stderr_tail.h"

#include <glib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tui/term/term_tty.h"

enum { TAIL_BYTES = 1024 };

void gb_stderr_tail_init(struct gb_stderr_tail *stderr_tail)
{
    stderr_tail->length = -1;
}

/* The last line of a text, without control characters. */
static bool last_line(char *text, char *line, size_t size)
{
    g_strchomp(text);
    const char *end = strrchr(text, '\n');
    g_strlcpy(line, end != NULL ? end + 1 : text, size);
    for (char *at = line; *at != '\0'; at++) {
        *at = *at == '\033' || g_ascii_iscntrl(*at) ? ' ' : *at;
    }
    return *line != '\0';
}

bool gb_stderr_tail_poll(struct gb_stderr_tail *stderr_tail, char *line, size_t size)
{
    struct stat now;
    char text[TAIL_BYTES + 1];
    if (fstat(STDERR_FILENO, &now) != 0 || !S_ISREG(now.st_mode)) {
        return false;
    }
    const int64_t before = stderr_tail->length;
    stderr_tail->length = now.st_size;
    if (before < 0 || now.st_size <= before) {
        return false;
    }
    const int64_t from = MAX(before, now.st_size - TAIL_BYTES);
    const int log = gb_term_tty_read_log();
    const ssize_t n = log < 0 ? -1 : pread(log, text, TAIL_BYTES, from);
    if (log >= 0) {
        close(log);
    }
    text[n > 0 ? n : 0] = '\0';
    return n > 0 && last_line(text, line, size);
}
