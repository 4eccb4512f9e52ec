/* Keys from bytes, cut anywhere, by a clock of its own: nothing here waits. */
#include "tui/term/term.h"

#include <glib.h>
#include <locale.h>
#include <ncurses.h>
#include <string.h>

static double now_s = 1000.0;

static void add(struct gb_term_keys *keys, const char *bytes, size_t count)
{
    size_t size;
    char *room = gb_term_keys_room(keys, &size);
    g_assert_cmpuint(count, <=, size);
    memcpy(room, bytes, count);
    gb_term_keys_add(keys, count, now_s);
}

/* All events as words: key codes as numbers, text as itself, mouse as its code and place. */
static void append_events(struct gb_term_keys *keys, GString *text)
{
    struct gb_term_event event;
    while (gb_term_keys_next(keys, now_s, &event)) {
        if (event.kind == GB_TERM_KEY) {
            g_string_append_printf(text, " %d", event.code);
        } else if (event.kind == GB_TERM_MOUSE) {
            g_string_append_printf(text, " mouse%d@%d,%d", event.code, event.row,
                                   event.col);
        } else {
            g_assert_cmpint(event.kind, ==, GB_TERM_TEXT);
            g_string_append_c(text, ' ');
            g_string_append_unichar(text, (gunichar)event.code);
        }
    }
}

struct row {
    const char *bytes, *events;
    size_t count; /* 0: strlen(bytes) */
};

static const struct row rows[] = {
    {"qG", " q G", 0},
    {"\r\t\001", " 13 9 1", 0},
    {"\0x", " 0 x", 2},
    {"\177", " 263", 0}, /* KEY_BACKSPACE */
    {"\033OA\033OBk", " 259 258 k", 0},
    {"\033[5~\033OP", " 339 265", 0},
    {"\303\251\342\202\254x", " \303\251 \342\202\254 x", 0},    /* two and three bytes */
    {"a\377b", " a b", 0},                                       /* no character */
    {"\033x", " 27 x", 0},                                       /* Alt-x */
    {"\033\033OA", " 27 259", 0},                                /* Alt-Up */
    {"\033[<0;12;3M\033[<0;12;3mz", " mouse0@2,11 z", 0},        /* press, release */
    {"\033[<64;1;1M\033[<69;2;1M", " mouse1@0,0 mouse2@0,1", 0}, /* with Shift */
    {"\033[<2;5;5Mz", " z", 0},                                  /* the right button */
    {"\033[200~z\033[1;99Qz", " z z", 0}, /* keys of other terminals */
    {"\033[1\033OAz", " 259 z", 0},       /* cut off by the next key */
};

static void test_whole(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        struct gb_term_keys keys = {.count = 0};
        GString *text = g_string_new("");
        add(&keys, rows[i].bytes,
            rows[i].count > 0 ? rows[i].count : strlen(rows[i].bytes));
        append_events(&keys, text);
        g_assert_cmpstr(text->str, ==, rows[i].events);
        g_assert_cmpuint(keys.count, ==, 0);
        g_string_free(text, TRUE);
    }
}

/* Byte by byte, with pauses that are just short enough. */
static void test_cut(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        struct gb_term_keys keys = {.count = 0};
        GString *text = g_string_new("");
        const size_t count = rows[i].count > 0 ? rows[i].count : strlen(rows[i].bytes);
        for (size_t n = 0; n < count; n++) {
            now_s += 0.9 * GB_TERM_KEYS_REST_S;
            append_events(&keys, text);
            add(&keys, rows[i].bytes + n, 1);
            append_events(&keys, text);
        }
        g_assert_cmpstr(text->str, ==, rows[i].events);
        g_string_free(text, TRUE);
    }
}

/* The beginning of a sequence is kept for its time, then it is keys; and so it is by a clock
 * that does not go on, since the wait says how long it takes. */
static void test_rest(void)
{
    static const struct row late[] = {
        {"\033", " 27", 0},    {"\033[", " 27 [", 0}, {"\033[1;5", " 27 [ 1 ; 5", 0},
        {"\033O", " 27 O", 0}, {"\342\202", "", 0},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(late); i++) {
        struct gb_term_keys keys = {.count = 0};
        GString *text = g_string_new("");
        g_assert_cmpint(gb_term_keys_wait_ms(&keys, now_s, -1), ==, -1);
        g_assert_cmpint(gb_term_keys_wait_ms(&keys, now_s, 500), ==, 500);
        add(&keys, late[i].bytes, strlen(late[i].bytes));
        append_events(&keys, text);
        g_assert_cmpstr(text->str, ==, "");
        g_assert_cmpint(gb_term_keys_wait_ms(&keys, now_s, -1), >=, 1);
        g_assert_cmpint(gb_term_keys_wait_ms(&keys, now_s, 500), <=,
                        (int)(1e3 * GB_TERM_KEYS_REST_S) + 1);
        g_assert_cmpint(gb_term_keys_wait_ms(&keys, now_s, 5), ==, 5);
        const int wait_ms = gb_term_keys_wait_ms(&keys, now_s, 500);
        now_s += 1e-3 * wait_ms + 1e-9; /* no earlier, and no second wait */
        g_assert_cmpint(gb_term_keys_wait_ms(&keys, now_s, 500), ==, 0);
        append_events(&keys, text);
        g_assert_cmpstr(text->str, ==, late[i].events);
        g_assert_cmpuint(keys.count, ==, 0);
        g_string_free(text, TRUE);
    }
}

/* A sequence without an end leaves room for what comes. */
static void test_endless(void)
{
    struct gb_term_keys keys = {.count = 0};
    GString *text = g_string_new("");
    add(&keys, "\033[", 2);
    for (int i = 0; i < 5 * GB_TERM_KEYS_BYTES; i++) {
        add(&keys, "1", 1);
        append_events(&keys, text);
        g_assert_cmpuint(keys.count, <, GB_TERM_KEYS_BYTES);
    }
    g_string_free(text, TRUE);
}

/* The three bytes of terminals without the longer form. */
static void test_old_mouse(void)
{
    struct gb_term_keys keys = {.count = 0};
    GString *text = g_string_new("");
    add(&keys, "\033[M \",", 6);
    add(&keys, "\033[M#\",z", 7); /* release */
    add(&keys, "\033[M`!", 5);
    append_events(&keys, text);
    g_assert_cmpstr(text->str, ==, " mouse0@11,1 z");
    add(&keys, "!", 1);
    append_events(&keys, text);
    g_assert_cmpstr(text->str, ==, " mouse0@11,1 z mouse1@0,0");
    g_string_free(text, TRUE);
}

static void with_terminal(const char *type)
{
    FILE *out = fopen("/dev/null", "w"), *in = fopen("/dev/null", "r");
    g_assert_nonnull(newterm(type, out, in));
    keypad(stdscr, TRUE);
}

static void test_xterm(void)
{
    with_terminal("xterm-256color");
    test_whole();
    test_cut();
    test_rest();
    test_endless();
}

static void test_screen(void)
{
    with_terminal("screen");
    test_old_mouse();
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    setlocale(LC_ALL, "C.UTF-8");
    g_test_add_func("/term_keys/xterm", test_xterm);
    g_test_add_func("/term_keys/screen", test_screen);
    return g_test_run();
}
