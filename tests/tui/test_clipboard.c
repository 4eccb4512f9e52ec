/* Sequences that set the clipboard: what terminals, tmux and screen find in them. */
#include "tui/term/term.h"

#include <glib.h>
#include <string.h>

static const char text[] = "greenbody run default contact.mu=0.15 # \u03bc\n";

/* The text that a terminal decodes from the first sequence; g_free. */
static char *decoded(const char *sequence)
{
    static const char head[] = "\033]52;c;";
    g_assert_true(g_str_has_prefix(sequence, head));
    const char *from = sequence + strlen(head);
    const char *end = strchr(from, '\a');
    g_assert_nonnull(end);
    char *base64 = g_strndup(from, (gsize)(end - from));
    gsize length = 0;
    unsigned char *bytes = g_base64_decode(base64, &length);
    char *plain = g_strndup((char *)bytes, length);
    g_free(bytes);
    g_free(base64);
    return plain;
}

/* Without what tmux takes off: the frame and one Esc of two; NULL: not its frame. */
static char *through_tmux(const char *sequence)
{
    static const char head[] = "\033Ptmux;";
    GString *inner = g_string_new("");
    const char *at = sequence + strlen(head);
    if (!g_str_has_prefix(sequence, head)) {
        return g_string_free(inner, TRUE);
    }
    while (at[0] != '\033' || at[1] == '\033') {
        g_assert_cmpint(*at, !=, '\0');
        at += *at == '\033';
        g_string_append_c(inner, *at++);
    }
    g_assert_cmpstr(at, ==, "\033\\");
    return g_string_free(inner, FALSE);
}

/* All strings of screen, one behind the other. */
static char *through_screen(const char *sequence)
{
    GString *inner = g_string_new("");
    while (*sequence != '\0') {
        g_assert_true(g_str_has_prefix(sequence, "\033P"));
        const char *end = strstr(sequence, "\033\\");
        g_assert_nonnull(end);
        g_assert_cmpint(end - sequence, <, 768);
        g_string_append_len(inner, sequence + 2, end - sequence - 2);
        sequence = end + 2;
    }
    return g_string_free(inner, FALSE);
}

static void check(int clipboard, char *(*through)(const char *), const char *copied)
{
    struct gb_error err = {0};
    char *sequence = gb_term_clipboard_sequence(clipboard, copied, &err);
    g_assert_nonnull(sequence);
    char *first = decoded(sequence);
    g_assert_cmpstr(first, ==, copied);
    const char *rest = strchr(sequence, '\a') + 1;
    if (through == NULL) {
        g_assert_cmpstr(rest, ==, "");
    } else {
        char *inner = through(rest);
        char *second = decoded(inner);
        g_assert_cmpstr(second, ==, copied);
        g_free(second);
        g_free(inner);
    }
    g_free(first);
    g_free(sequence);
}

static void test_sequences(void)
{
    char *longest = g_strnfill(GB_CLIPBOARD_MAX, 'x');
    const char *const copied[] = {text, "x", longest};
    for (size_t k = 0; k < G_N_ELEMENTS(copied); k++) {
        check(GB_CLIPBOARD_OSC52, NULL, copied[k]);
        check(GB_CLIPBOARD_TMUX, through_tmux, copied[k]);
        check(GB_CLIPBOARD_SCREEN, through_screen, copied[k]);
    }
    g_free(longest);
}

static void refused(int clipboard, const char *copied, const char *why)
{
    struct gb_error err = {0};
    g_assert_null(gb_term_clipboard_sequence(clipboard, copied, &err));
    g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
    g_assert_nonnull(strstr(err.text, why));
}

static void test_refused(void)
{
    char *longer = g_strnfill(GB_CLIPBOARD_MAX + 1, 'x');
    refused(GB_CLIPBOARD_OSC52, "", "nothing to copy");
    refused(GB_CLIPBOARD_OSC52, longer, "74995 bytes, terminals accept 74994");
    refused(GB_CLIPBOARD_OFF, text, "clipboard is off");
    g_free(longer);
}

/* 100,000 bytes of one sequence, terminators included. */
static void test_longest(void)
{
    struct gb_error err = {0};
    char *longest = g_strnfill(GB_CLIPBOARD_MAX, 'x');
    char *sequence = gb_term_clipboard_sequence(GB_CLIPBOARD_OSC52, longest, &err);
    g_assert_cmpuint(strlen(sequence), <=, 100000);
    g_free(sequence);
    g_free(longest);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/clipboard/sequences", test_sequences);
    g_test_add_func("/clipboard/refused", test_refused);
    g_test_add_func("/clipboard/longest", test_longest);
    return g_test_run();
}
