/* The shell command that repeats the run on screen. */
#include <glib.h>
#include <string.h>

#include "tui/session/previous.h"

static void test_command(void)
{
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    if (!gb_preset_load(&preset, "default", &err)) {
        g_error("%s", err.text);
    }
    struct gb_params *params = gb_preset_params(preset);
    char *text = gb_previous_command(preset, params, 80);
    g_assert_cmpstr(text, ==, "greenbody run default");
    g_free(text);
    g_assert_true(gb_params_assign(params, "contact.mu=0.25", NULL));
    g_assert_true(gb_params_assign(params, "loading.until=density = 0.5", NULL));
    text = gb_previous_command(preset, params, 80);
    g_assert_cmpstr(text, ==,
                    "greenbody run default contact.mu=0.25 "
                    "'loading.until=density = 0.5'");
    g_free(text);
    text = gb_previous_command(preset, params, 40);
    char **lines = g_strsplit(text, "\n", -1);
    for (int i = 0; lines[i] != NULL; i++) {
        g_assert_cmpint((int)strlen(lines[i]), <=, 40);
        g_assert_true(lines[i + 1] == NULL || g_str_has_suffix(lines[i], " \\"));
    }
    g_strfreev(lines);
    g_free(text);
    gb_preset_destroy(preset);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/tui/repeat/command", test_command);
    return g_test_run();
}
