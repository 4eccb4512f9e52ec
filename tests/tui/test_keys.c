#include <glib.h>
#include <ncurses.h>
#include <string.h>

#include "tui/app/keys.h"
#include "tui/view/views.h"

static int scope_of(GHashTable *codes, int code)
{
    return GPOINTER_TO_INT(g_hash_table_lookup(codes, GINT_TO_POINTER(code)));
}

/* In no pane and no dialog has a key two rows. */
static void test_no_duplicates(void)
{
    GHashTable *codes = g_hash_table_new(NULL, NULL);
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const struct gb_key key = gb_keys_at(i);
        for (int k = 0; k < GB_KEYS_PER_ROW && key.code[k] != 0; k++) {
            const int before = scope_of(codes, key.code[k]);
            if (before & key.scope) {
                g_error("key %d of \"%s\" is there twice", key.code[k], key.name);
            }
            g_hash_table_insert(codes, GINT_TO_POINTER(key.code[k]),
                                GINT_TO_POINTER(before | key.scope));
        }
    }
    g_hash_table_destroy(codes);
}

/* Dispatch finds every row of the help page. */
static void test_dispatch(void)
{
    struct gb_key found;
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const struct gb_key key = gb_keys_at(i);
        g_assert_nonnull(key.command);
        g_assert_cmpint(key.scope & (GB_KEY_ANY_PANE | GB_KEY_LEGS | GB_KEY_CURVES), !=,
                        0);
        g_assert_cmpint(key.code[0], !=, 0);
        for (int k = 0; k < GB_KEYS_PER_ROW && key.code[k] != 0; k++) {
            g_assert_true(gb_keys_find(key.code[k], key.scope, &found));
            g_assert_cmpstr(found.name, ==, key.name);
            g_assert_cmpint(gb_keys_action(key.code[k]), ==, key.action);
        }
    }
    g_assert_false(gb_keys_find('$', GB_KEY_EVERYWHERE, &found));
    g_assert_false(gb_keys_find(0, GB_KEY_EVERYWHERE, &found));
    g_assert_cmpint(gb_keys_action('$'), ==, GB_ACTION_NONE);
}

/* Every navigation action and every view has exactly one row; all other rows have
 * different commands. */
static void test_every_row(void)
{
    for (int action = GB_ACTION_NONE + 1; action <= GB_ACTION_BACK; action++) {
        int rows = 0;
        for (size_t i = 0; i < gb_keys_count(); i++) {
            rows += gb_keys_at(i).action == (enum gb_action)action;
        }
        g_assert_cmpint(rows, ==, 1);
    }
    for (size_t v = 0; v < gb_views_count(); v++) {
        struct gb_key key;
        g_assert_true(gb_keys_find(gb_views_at(v)->key[0], GB_KEY_ANY_PANE, &key));
        g_assert_true(gb_views_find(key.name) == gb_views_at(v));
    }
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const struct gb_key one = gb_keys_at(i);
        for (size_t k = 0; k < i; k++) {
            const struct gb_key other = gb_keys_at(k);
            g_assert_true(one.command != other.command || one.action != other.action ||
                          gb_views_find(one.name) != NULL);
        }
    }
}

static void assert_length(const char *text, glong most)
{
    g_assert_cmpint(g_utf8_strlen(text, -1), >, 0);
    g_assert_cmpint(g_utf8_strlen(text, -1), <=, most);
}

/* Each view has its texts, and `v` is cyclic. */
static void test_views(void)
{
    struct gb_params params;
    gb_params_init(&params);
    const struct gb_plot_view *view = gb_views_at(0);
    for (size_t i = 0; i < gb_views_count(); i++) {
        g_assert_nonnull(view->draw);
        g_assert_cmpuint(strlen(view->key), ==, 1);
        assert_length(view->title, GB_VIEW_TITLE);
        assert_length(view->hint, GB_VIEW_HINT);
        if (view->title_by_step != NULL) {
            assert_length(view->title_by_step, GB_VIEW_TITLE);
        }
        g_assert_true(view->applies == NULL || view->excluded != NULL);
        g_assert_true(gb_views_step(gb_views_step(view, 1, &params), -1, &params) ==
                      view);
        view = gb_views_step(view, 1, &params);
    }
    g_assert_true(view == gb_views_at(0));
    /* the law of Hertz has no bridges: no view of them */
    g_assert_true(gb_params_assign(&params, "contact.normal=hertz", NULL));
    for (size_t i = 0; i < gb_views_count(); i++) {
        view = gb_views_step(view, 1, &params);
        g_assert_true(view->applies == NULL || view->applies(&params));
    }
}

static bool plain(int code)
{
    return (code >= ' ' && code < 127) || code == GB_KEY_ESCAPE || code == ('L' & 31);
}

/* Some terminals intercept function keys and arrows: each row has another key. */
static void test_plain_key(void)
{
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const struct gb_key key = gb_keys_at(i);
        bool has = false;
        for (int k = 0; k < GB_KEYS_PER_ROW && key.code[k] != 0; k++) {
            has = has || plain(key.code[k]);
        }
        if (!has) {
            g_error("\"%s\" has no plain key", key.name);
        }
    }
}

static void test_texts(void)
{
    const size_t count = gb_keys_count();
    for (size_t i = 0; i < count; i++) {
        const struct gb_key key = gb_keys_at(i);
        g_assert_cmpuint(strlen(key.name), >, 0);
        g_assert_cmpuint(strlen(key.name), <, 10); /* the help's column */
        g_assert_cmpuint(strlen(key.help), >, 0);
        g_assert_cmpuint(strlen(key.help), <, 50);
        g_assert_true(key.brief == NULL || strlen(key.brief) > 0);
    }
    g_assert_cmpstr(gb_keys_at(count - 1).brief, ==, "quit");
    g_assert_cmpstr(gb_keys_at(count - 2).brief, ==, "help");
}

/* The help begins with a heading and has each of them once. */
static void test_headings(void)
{
    GHashTable *seen = g_hash_table_new(g_str_hash, g_str_equal);
    g_assert_nonnull(gb_keys_heading(0));
    for (size_t i = 0; i < gb_keys_count(); i++) {
        const char *heading = gb_keys_heading(i);
        g_assert_true(heading == NULL || g_hash_table_add(seen, (void *)heading));
    }
    g_assert_cmpuint(g_hash_table_size(seen), ==, 10);
    g_hash_table_destroy(seen);
}

/* Each pane has keys of its own, all of which act in it. */
static void test_footers(void)
{
    for (enum gb_pane pane = GB_PANE_PARAMS; pane < GB_PANES; pane++) {
        const char *const *name = gb_keys_footer(pane);
        g_assert_nonnull(name[0]);
        for (int i = 0; i < GB_KEYS_FOOTER && name[i] != NULL; i++) {
            struct gb_key key;
            g_test_message("pane %d: %s", (int)pane, name[i]);
            g_assert_true(gb_keys_named(name[i], &key));
            g_assert_nonnull(key.brief);
            g_assert_cmpint(key.scope & (1 << pane), !=, 0);
        }
        for (enum gb_pane other = GB_PANE_PARAMS; other < pane; other++) {
            g_assert_true(gb_keys_footer(other)[1] != name[1] ||
                          gb_keys_footer(other)[2] != name[2]);
        }
    }
}

/* The help has every row of the tables of docs/glossary.md. */
static void test_glossary(void)
{
    char *path =
        g_build_filename(g_getenv("GB_PRESET_DIR"), "..", "docs", "glossary.md", NULL);
    char *page = NULL;
    size_t count = 0;
    const struct gb_help_word *words = gb_keys_glossary(&count);
    size_t rows = 0;
    g_assert_true(g_file_get_contents(path, &page, NULL, NULL));
    for (const char *at = page; (at = strstr(at, "\n| ")) != NULL; at++) {
        rows += !g_str_has_prefix(at, "\n| word | meaning");
    }
    for (size_t i = 0; i < count; i++) {
        g_assert_cmpuint(strlen(words[i].meaning), >, 0);
        g_assert_null(strchr(words[i].meaning, '`'));
        rows -= words[i].word != NULL;
    }
    g_assert_cmpuint(rows, ==, 0);
    g_assert_cmpuint(count, >, 50);
    g_free(page);
    g_free(path);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/keys/no-duplicates", test_no_duplicates);
    g_test_add_func("/tui/keys/dispatch", test_dispatch);
    g_test_add_func("/tui/keys/every-row", test_every_row);
    g_test_add_func("/tui/keys/views", test_views);
    g_test_add_func("/tui/keys/plain-key", test_plain_key);
    g_test_add_func("/tui/keys/texts", test_texts);
    g_test_add_func("/tui/keys/headings", test_headings);
    g_test_add_func("/tui/keys/footers", test_footers);
    g_test_add_func("/tui/keys/glossary", test_glossary);
    return g_test_run();
}
