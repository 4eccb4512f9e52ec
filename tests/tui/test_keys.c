#include <glib.h>
#include <ncurses.h>
#include <string.h>

#include "tui/app/keys.h"

static void test_no_duplicates(void)
{
    size_t count = 0;
    const struct gb_key *key = gb_keys_table(&count);
    GHashTable *seen = g_hash_table_new(NULL, NULL);
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < GB_KEYS_PER_ROW && key[i].code[k] != 0; k++) {
            if (!g_hash_table_add(seen, GINT_TO_POINTER(key[i].code[k]))) {
                g_error("key %d of \"%s\" is there twice", key[i].code[k], key[i].name);
            }
        }
    }
    g_hash_table_destroy(seen);
}

/* Dispatch finds what the help page shows, row by row. */
static void test_dispatch(void)
{
    size_t count = 0;
    const struct gb_key *key = gb_keys_table(&count);
    for (size_t i = 0; i < count; i++) {
        g_assert_cmpint(key[i].action, !=, GB_ACTION_NONE);
        g_assert_cmpint(key[i].code[0], !=, 0);
        for (int k = 0; k < GB_KEYS_PER_ROW && key[i].code[k] != 0; k++) {
            g_assert_cmpint(gb_keys_action(key[i].code[k]), ==, key[i].action);
        }
    }
    g_assert_cmpint(gb_keys_action('$'), ==, GB_ACTION_NONE);
    g_assert_cmpint(gb_keys_action(0), ==, GB_ACTION_NONE);
}

/* Every action has its one row, so that the help page cannot leave one out. */
static void test_every_action(void)
{
    size_t count = 0;
    const struct gb_key *key = gb_keys_table(&count);
    for (int action = GB_ACTION_NONE + 1; action <= GB_ACTION_QUIT; action++) {
        int rows = 0;
        for (size_t i = 0; i < count; i++) {
            rows += key[i].action == (enum gb_action)action;
        }
        g_assert_cmpint(rows, ==, 1);
    }
}

static bool plain(int code)
{
    return (code >= ' ' && code < 127) || code == GB_KEY_ESCAPE || code == ('L' & 31);
}

/* Function keys and arrows are eaten by some terminals: each row has another key. */
static void test_plain_key(void)
{
    size_t count = 0;
    const struct gb_key *key = gb_keys_table(&count);
    for (size_t i = 0; i < count; i++) {
        bool has = false;
        for (int k = 0; k < GB_KEYS_PER_ROW && key[i].code[k] != 0; k++) {
            has = has || plain(key[i].code[k]);
        }
        if (!has) {
            g_error("\"%s\" has no plain key", key[i].name);
        }
    }
}

static void test_texts(void)
{
    size_t count = 0;
    const struct gb_key *key = gb_keys_table(&count);
    for (size_t i = 0; i < count; i++) {
        g_assert_cmpuint(strlen(key[i].name), >, 0);
        g_assert_cmpuint(strlen(key[i].name), <, 10); /* the help's column */
        g_assert_cmpuint(strlen(key[i].help), >, 0);
        g_assert_cmpuint(strlen(key[i].help), <, 50);
        g_assert_true(key[i].brief == NULL || strlen(key[i].brief) > 0);
    }
    g_assert_cmpint(key[count - 1].action, ==, GB_ACTION_QUIT);
    g_assert_cmpint(key[count - 2].action, ==, GB_ACTION_HELP);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/keys/no-duplicates", test_no_duplicates);
    g_test_add_func("/tui/keys/dispatch", test_dispatch);
    g_test_add_func("/tui/keys/every-action", test_every_action);
    g_test_add_func("/tui/keys/plain-key", test_plain_key);
    g_test_add_func("/tui/keys/texts", test_texts);
    return g_test_run();
}
