#define _GNU_SOURCE /* memfd_create */
#include "tui/term/clipboard.h"

#include <glib.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* Part of a sequence in one string of GNU screen: below its limit of 768 bytes. */
enum { SCREEN_PART = 512 };

/* DCS tmux; ... ST with every Esc doubled. */
static void add_tmux(GString *to, const char *plain)
{
    g_string_append(to, "\033Ptmux;");
    for (const char *at = plain; *at != '\0'; at++) {
        g_string_append(to, *at == '\033' ? "\033\033" : (char[]){*at, '\0'});
    }
    g_string_append(to, "\033\\");
}

/* DCS ... ST, which screen sends on; the terminal sees the parts as one sequence. */
static void add_screen(GString *to, const char *plain)
{
    const size_t length = strlen(plain);
    for (size_t at = 0; at < length; at += SCREEN_PART) {
        g_string_append_printf(to, "\033P%.*s\033\\", SCREEN_PART, plain + at);
    }
}

char *gb_clipboard_sequence(int clipboard, const char *text, struct gb_error *err)
{
    const size_t length = strlen(text);
    if (clipboard == GB_CLIPBOARD_OFF) {
        gb_error_set(err, GB_ERR_INPUT, "not copied: the setting clipboard is off");
        return NULL;
    }
    if (length == 0) {
        gb_error_set(err, GB_ERR_INPUT, "nothing to copy");
        return NULL;
    }
    if (length > GB_CLIPBOARD_MAX) {
        gb_error_set(err, GB_ERR_INPUT, "not copied: %zu bytes, terminals accept %d",
                     length, GB_CLIPBOARD_MAX);
        return NULL;
    }
    char *base64 = g_base64_encode((const unsigned char *)text, length);
    char *plain = g_strdup_printf("\033]52;c;%s\a", base64);
    GString *all = g_string_new(plain);
    if (clipboard == GB_CLIPBOARD_TMUX) {
        add_tmux(all, plain);
    } else if (clipboard == GB_CLIPBOARD_SCREEN) {
        add_screen(all, plain);
    }
    g_free(plain);
    g_free(base64);
    return g_string_free(all, FALSE);
}

/* With its default options tmux ignores both sequences of a program, but not its own
 * command, which needs tmux 3.2.  The text is in a file in memory: nothing blocks. */
static void load_buffer(const char *text)
{
    static const char *const words[] = {"tmux", "load-buffer", "-w", "-", NULL};
    const size_t length = strlen(text);
    const int fd = memfd_create("clipboard", MFD_CLOEXEC);
    if (fd < 0) {
        return;
    }
    if (write(fd, text, length) == (ssize_t)length && lseek(fd, 0, SEEK_SET) == 0) {
        g_spawn_async_with_fds(NULL, (char **)words, NULL, G_SPAWN_SEARCH_PATH, NULL, NULL, NULL,
                               fd, STDOUT_FILENO, STDERR_FILENO, NULL);
    }
    close(fd);
}

bool gb_clipboard_copy(struct gb_term *term, const char *text, struct gb_error *err)
{
    const int clipboard = gb_term_clipboard(term);
    char *sequence = gb_clipboard_sequence(clipboard, text, err);
    if (sequence == NULL) {
        return false;
    }
    gb_term_pass(term, sequence);
    g_free(sequence);
    if (clipboard == GB_CLIPBOARD_TMUX && getenv("TMUX") != NULL) {
        load_buffer(text);
    }
    return true;
}
