#include "io/preset.h"
#include "io/preset_folders.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glib.h>
#include <glib/gstdio.h>

static char *folder; /* scratch, removed at the end */

static char *in_folder(const char *name)
{
    return g_build_filename(folder, name, NULL);
}

static char *write_bytes(const char *bytes, size_t length)
{
    char *path = in_folder("a.ini");
    g_assert_true(g_file_set_contents(path, bytes, (gssize)length, NULL));
    return path;
}

static char *write_text(const char *text)
{
    return write_bytes(text, strlen(text));
}

static char *read_text(const char *path)
{
    char *text = NULL;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    return text;
}

static struct gb_preset *load(const char *path)
{
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    const bool good = gb_preset_load(&preset, path, &err);
    g_test_message("%s", err.text);
    g_assert_true(good);
    return preset;
}

static void set(struct gb_preset *preset, const char *assignment)
{
    g_assert_true(gb_params_assign(gb_preset_params(preset), assignment, NULL));
}

static const char sample[] = "# a comment\n"
                             "\n"
                             "[contact]\n"
                             "  mu   =   0.20  \n"
                             "x-note = mine\n"
                             "# between\n"
                             "bridge_length=0.1nm\n"
                             "[my group]\n"
                             "anything = goes; really\n"
                             "\n"
                             "[particles]\n"
                             "count = 500";

/* Unchanged values leave the file as it is, to the byte. */
static void test_untouched(void)
{
    char *path = write_text(sample), *copy = in_folder("b.ini");
    struct gb_preset *preset = load(path);
    g_assert_cmpfloat(gb_preset_params(preset)->mu, ==, 0.2);
    g_assert_cmpstr(gb_preset_path(preset), ==, path);
    g_assert_true(gb_preset_save(preset, copy, GB_PRESET_CHANGED_KEYS, NULL));
    char *saved = read_text(copy);
    g_assert_cmpstr(saved, ==, sample);
    g_assert_cmpstr(gb_preset_path(preset), ==, copy);
    gb_preset_destroy(preset);
    g_free(saved);
    g_free(copy);
    g_free(path);
}

static void test_changed(void)
{
    char *path = write_text(sample);
    struct gb_preset *preset = load(path);
    set(preset, "contact.mu=0.3");
    set(preset, "contact.alpha=0.37");
    set(preset, "particles.count=600");
    set(preset, "loading.until=density = 0.6");
    g_assert_true(gb_preset_save(preset, path, GB_PRESET_CHANGED_KEYS, NULL));
    char *saved = read_text(path);
    g_assert_cmpstr(saved, ==,
                    "# a comment\n"
                    "\n"
                    "[contact]\n"
                    "  mu   =   0.3  \n"
                    "x-note = mine\n"
                    "# between\n"
                    "bridge_length=0.1nm\n"
                    "alpha = 0.37\n"
                    "[my group]\n"
                    "anything = goes; really\n"
                    "\n"
                    "[particles]\n"
                    "count = 600\n"
                    "\n"
                    "[loading]\n"
                    "until = density = 0.6\n");
    g_free(saved);
    set(preset, "contact.mu=0.4"); /* a second save starts from the first */
    g_assert_true(gb_preset_save(preset, path, GB_PRESET_CHANGED_KEYS, NULL));
    gb_preset_destroy(preset);
    preset = load(path);
    g_assert_cmpfloat(gb_preset_params(preset)->mu, ==, 0.4);
    g_assert_cmpfloat(gb_preset_params(preset)->until_density, ==, 0.6);
    gb_preset_destroy(preset);
    g_free(path);
}

/* complete writes every key, and what is read back is the same. */
static void test_complete(void)
{
    struct gb_preset *preset = NULL;
    char *path = in_folder("complete.ini");
    g_assert_true(gb_preset_create(&preset, NULL));
    g_assert_cmpstr(gb_preset_path(preset), ==, "");
    set(preset, "particles.diameter=9.7 nm");
    set(preset, "loading.unload_from=100 MPa; 1 GPa");
    set(preset, "scene.title=a = b; [c] \xc2\xb5");
    const struct gb_params params = *gb_preset_params(preset);
    g_assert_true(gb_preset_save(preset, path, GB_PRESET_ALL_KEYS, NULL));
    gb_preset_destroy(preset);
    preset = load(path);
    g_assert_true(memcmp(gb_preset_params(preset), &params, sizeof params) == 0);
    gb_preset_destroy(preset);
    char *text = read_text(path);
    size_t count = 0;
    const struct gb_field *fields = gb_params_fields(&count);
    struct gb_key_lines lines;
    g_assert_true(gb_preset_lines_init(&lines, path, text, strlen(text), NULL));
    for (size_t i = 0; i < count; i++) {
        g_assert_nonnull(gb_preset_lines_find(&lines, fields[i].group, fields[i].key));
    }
    gb_preset_lines_finish(&lines);
    g_free(text);
    g_free(path);
}

/* Bytes, and what the one line must say besides the path. */
static const struct {
    const char *bytes;
    size_t length; /* 0: strlen */
    const char *said[3];
} hostile[] = {
    {"[contact]\nmu = -1\n", 0, {":2: contact.mu = -1: must be between 0 and 2"}},
    {"[contact]\n\n# x\nmuu = 1\n",
     0,
     {":4: contact.muu: no such key; did you mean contact.mu? must be one of"}},
    {"[contact]\nmu = 0.1 # no comments here\n", 0, {":2:", "must be between 0 and 2"}},
    {"[contact]\nmu = 0.1\n[x]\n[contact]\nmu = 0.2\n",
     0,
     {":5:", "contact.mu", "line 2"}},
    {"mu = 1\n", 0, {":1:", "[group]"}},
    {"[contact\nmu = 1\n", 0, {":1:", "[group]"}},
    {"[]\n", 0, {":1:", "[group]"}},
    {"[contact]\nmu\n", 0, {":2: mu:", "key = value"}},
    {"[contact]\n= 3\n", 0, {":2:", "key = value"}},
    {"[contact]\nmu =\n", 0, {":2: contact.mu = : must be between 0 and 2"}},
    {"[particles]\ndiameter = 10 MPa\n",
     0,
     {":2: particles.diameter = 10 MPa", "units nm"}},
    {"[scene]\nkind = pile\n",
     0,
     {":2: scene.kind = pile: must be quasistatic, dynamic or die"}},
    {"[contact]\nmu = 0.1\nal\0pha = 1\n", 28, {":3:", "NUL"}},
    {"[contact]\nmu = \xff\xfe\n", 0, {":2:", "UTF-8"}},
    {"\xff\xfe[\0c\0]\0", 8, {":1:", "NUL"}},
    {"[contact]\nmu[de] = 0.1\n", 0, {":2:", "contact.mu[de]"}},
    {"[scene]\ntitle = a\x1b[2Jb\n", 0, {":2: scene.title = a\\x1b[2Jb"}},
};

static void test_hostile(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(hostile); i++) {
        const size_t length =
            hostile[i].length ? hostile[i].length : strlen(hostile[i].bytes);
        char *path = write_bytes(hostile[i].bytes, length);
        struct gb_preset *preset = NULL;
        struct gb_error err = {0};
        g_assert_false(gb_preset_load(&preset, path, &err));
        g_test_message("row %zu: %s", i, err.text);
        g_assert_null(preset);
        g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
        g_assert_true(g_str_has_prefix(err.text, path));
        for (int k = 0; k < 3 && hostile[i].said[k]; k++) {
            g_assert_nonnull(strstr(err.text, hostile[i].said[k]));
        }
        g_free(path);
    }
}

/* Files that are fine, however odd. */
static void test_odd(void)
{
    static const char *const texts[] = {"",
                                        "\n\n",
                                        "# only a comment",
                                        "[contact]\r\nmu = 0.3\r\n",
                                        "\xef\xbb\xbf[contact]\nmu = 0.3\n",
                                        "[other]\nmu = -1\n",
                                        "[contact]\nx-mu = -1\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        char *path = write_text(texts[i]);
        struct gb_preset *preset = load(path);
        const double mu = gb_preset_params(preset)->mu;
        g_assert_cmpfloat(mu, ==, strstr(texts[i], "0.3") ? 0.3 : 0.1);
        g_assert_true(gb_preset_save(preset, path, GB_PRESET_CHANGED_KEYS, NULL));
        gb_preset_destroy(preset);
        g_free(path);
    }
}

static void expect_failure(const char *path, enum gb_status code, const char *said)
{
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    g_assert_false(gb_preset_load(&preset, path, &err));
    g_test_message("%s", err.text);
    g_assert_cmpint(err.code, ==, code);
    g_assert_nonnull(strstr(err.text, said));
}

static void test_files(void)
{
    expect_failure("/no/such/file.ini", GB_ERR_INPUT, "/no/such/file.ini: No such file");
    expect_failure("no-such-preset", GB_ERR_INPUT, "no such file or preset; looked in ");
    expect_failure("", GB_ERR_INPUT, "no such file or preset");
    expect_failure(folder, GB_ERR_INPUT, "directory");
    expect_failure("/dev/zero", GB_ERR_INPUT, "the limit for a preset");
    char *path = write_text("[contact]\nmu = 0.1\n");
    g_assert_cmpint(truncate(path, 100 * 1000 * 1000), ==, 0);
    expect_failure(path, GB_ERR_INPUT,
                   "larger than 1048576 bytes, the limit for a preset");
    if (geteuid() != 0) { /* root reads everything */
        g_assert_cmpint(chmod(path, 0), ==, 0);
        expect_failure(path, GB_ERR_MACHINE, "Permission denied");
        g_assert_cmpint(chmod(path, 0600), ==, 0);
    }
    expect_failure("/proc/self/mem", GB_ERR_MACHINE, "/proc/self/mem");
    g_free(path);
}

/* A save that fails leaves the preset and what was there before as they were. */
static void test_failed_save(void)
{
    char *path = write_text("[contact]\nmu = 0.1\n"), *bad = in_folder("missing/b.ini");
    struct gb_preset *preset = load(path);
    struct gb_error err = {0};
    set(preset, "contact.mu=0.2");
    g_assert_false(gb_preset_save(preset, bad, GB_PRESET_CHANGED_KEYS, &err));
    g_assert_cmpint(err.code, !=, GB_OK);
    g_assert_cmpstr(gb_preset_path(preset), ==, path);
    g_assert_true(gb_preset_save(preset, path, GB_PRESET_CHANGED_KEYS, NULL));
    char *saved = read_text(path);
    g_assert_cmpstr(saved, ==, "[contact]\nmu = 0.2\n");
    g_free(saved);
    gb_preset_destroy(preset);
    g_free(bad);
    g_free(path);
}

/* Files changed at random are read or refused in one line, and never break the program.
 */
static void test_random(void)
{
    char *path = g_build_filename(GB_TEST_PRESETS, "default.ini", NULL);
    char *text = read_text(path);
    const gint32 length = (gint32)strlen(text);
    g_free(path);
    for (int i = 0; i < 150; i++) {
        char *bytes = g_memdup2(text, (gsize)length);
        const int changes = g_test_rand_int_range(1, 6);
        for (int k = 0; k < changes; k++) {
            bytes[g_test_rand_int_range(0, length)] =
                (char)g_test_rand_int_range(-128, 128);
        }
        path = write_bytes(bytes, (size_t)g_test_rand_int_range(0, length + 1));
        struct gb_preset *preset = NULL;
        struct gb_error err = {0};
        if (gb_preset_load(&preset, path, &err)) {
            gb_params_check(gb_preset_params(preset), &err);
            g_assert_true(gb_preset_save(
                preset, path, i % 2 ? GB_PRESET_ALL_KEYS : GB_PRESET_CHANGED_KEYS, &err));
            gb_preset_destroy(preset);
            gb_preset_destroy(load(path));
        } else {
            g_assert_cmpint(err.code, ==, GB_ERR_INPUT);
            g_assert_true(g_str_has_prefix(err.text, path));
            g_assert_null(strchr(err.text, '\n'));
        }
        g_free(path);
        g_free(bytes);
    }
    g_free(text);
}

static void test_list(void)
{
    char **names = gb_preset_folders_list();
    g_assert_true(g_strv_contains((const char *const *)names, "default"));
    g_assert_true(g_strv_contains((const char *const *)names, "p1-set2-9.7nm"));
    for (int i = 1; names[i]; i++) {
        g_assert_cmpstr(names[i - 1], <, names[i]);
    }
    g_strfreev(names);
}

/* The user's own preset comes before the shipped one; .ini may be typed or not. */
static void test_lookup(void)
{
    char *own = g_build_filename(g_get_user_config_dir(), "greenbody", "presets", NULL);
    char *file = g_build_filename(own, "default.ini", NULL);
    char *path = gb_preset_folders_find("default");
    g_assert_nonnull(path);
    g_assert_cmpstr(path, !=, file);
    g_free(path);
    g_assert_cmpint(g_mkdir_with_parents(own, 0700), ==, 0);
    g_assert_true(g_file_set_contents(file, "[contact]\nmu = 0.7\n", -1, NULL));
    for (int i = 0; i < 2; i++) {
        path = gb_preset_folders_find(i ? "default.ini" : "default");
        g_assert_cmpstr(path, ==, file);
        g_free(path);
    }
    g_assert_null(gb_preset_folders_find("../default"));
    g_assert_null(gb_preset_folders_find("nothing"));
    g_unlink(file);
    g_free(file);
    g_free(own);
}

/* The message names whole folders. */
static void test_long_folder(void)
{
    char *name = g_strnfill(200, 'f'), *other = g_strconcat("/", name, "/presets", NULL);
    char *text = g_strdup_printf("%s/greenbody/presets, %s", folder, other);
    g_setenv("GB_PRESET_DIR", other, TRUE);
    expect_failure("no-such-preset", GB_ERR_INPUT, text);
    g_setenv("GB_PRESET_DIR", GB_TEST_PRESETS, TRUE);
    g_free(text);
    g_free(other);
    g_free(name);
}

/* A table of sizes lies beside its preset; a copy of the preset elsewhere carries the
 * table itself, so that a run directory is whole. */
static void test_sizes(void)
{
    static const char csv[] = "diameter_um,share_number\n1,0.25\n2,0.75\n";
    static const char text[] = "[particles]\ntable = sizes.csv\n";
    char *table = in_folder("sizes.csv"), *path = write_text(text);
    char *beside = in_folder("b.ini"), *inner = in_folder("run");
    char *elsewhere = g_build_filename(inner, "preset.ini", NULL);
    g_assert_true(g_file_set_contents(table, csv, -1, NULL));
    g_assert_cmpint(g_mkdir(inner, 0777), ==, 0);
    struct gb_preset *preset = load(path);
    g_assert_cmpint(gb_preset_params(preset)->sizes.count, ==, 2);
    g_assert_true(gb_preset_save(preset, beside, GB_PRESET_CHANGED_KEYS, NULL));
    char *saved = read_text(beside);
    g_assert_cmpstr(saved, ==, text);
    g_free(saved);
    g_assert_true(gb_preset_save(preset, elsewhere, GB_PRESET_CHANGED_KEYS, NULL));
    saved = read_text(elsewhere);
    g_assert_cmpstr(saved, ==, "[particles]\ntable = number: 1 um 0.25; 2 um 0.75\n");
    g_free(saved);
    gb_preset_destroy(preset);
    g_assert_cmpint(g_remove(table), ==, 0);
    preset = load(elsewhere);
    g_assert_cmpfloat(gb_preset_params(preset)->sizes.row[1].fraction, ==, 0.75);
    gb_preset_destroy(preset);
    struct gb_error err = {0};
    g_assert_false(gb_preset_load(&preset, path, &err));
    g_test_message("%s", err.text);
    g_assert_nonnull(strstr(err.text, "a.ini:2: particles.table: "));
    g_assert_nonnull(strstr(err.text, "sizes.csv: "));
    g_assert_cmpint(g_remove(elsewhere), ==, 0);
    g_assert_cmpint(g_rmdir(inner), ==, 0);
    g_free(elsewhere);
    g_free(inner);
    g_free(beside);
    g_free(path);
    g_free(table);
}

/* Presets of version 0.1 meant other random numbers. */
static void test_first_version(void)
{
    char *path = write_text("# greenbody 0.1.0\n[structure]\nseed = 4357\n");
    expect_failure(path, GB_ERR_INPUT, ":1: this preset is from greenbody 0.1: expected");
    g_free(path);
    path = write_text("[structure]\ngenerator = mt19937\n");
    expect_failure(path, GB_ERR_INPUT, "generator");
    g_free(path);
    path = write_text("# as greenbody 0.1.0\n[structure]\nseed = 4357\n");
    gb_preset_destroy(load(path));
    g_free(path);
}

int main(int argc, char **argv)
{
    folder = g_dir_make_tmp("greenbody-XXXXXX", NULL);
    g_assert_nonnull(folder);
    g_setenv("XDG_CONFIG_HOME", folder, TRUE); /* before GLib looks at it */
    g_setenv("GB_PRESET_DIR", GB_TEST_PRESETS, TRUE);
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/preset/untouched", test_untouched);
    g_test_add_func("/preset/changed", test_changed);
    g_test_add_func("/preset/complete", test_complete);
    g_test_add_func("/preset/first-version", test_first_version);
    g_test_add_func("/preset/hostile", test_hostile);
    g_test_add_func("/preset/odd", test_odd);
    g_test_add_func("/preset/files", test_files);
    g_test_add_func("/preset/failed-save", test_failed_save);
    g_test_add_func("/preset/random", test_random);
    g_test_add_func("/preset/list", test_list);
    g_test_add_func("/preset/lookup", test_lookup);
    g_test_add_func("/preset/sizes", test_sizes);
    g_test_add_func("/preset/long-folder", test_long_folder);
    const int status = g_test_run();
    static const char *const files[] = {
        "a.ini", "b.ini", "complete.ini", "greenbody/presets", "greenbody", ""};
    for (size_t i = 0; i < G_N_ELEMENTS(files); i++) {
        char *path = in_folder(files[i]);
        g_remove(path);
        g_free(path);
    }
    g_free(folder);
    return status;
}
