/* Both ways to an OpenGL context, OSMesa and EGL (GB_GL): ten pictures of the real program,
 * pixel by pixel. */
#include <cairo.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <glib.h>
#include <glib/gstdio.h>

#include "common/program.h"

/* A channel (0 to 255) that differs by more is not rounding; at edges of particles rounding
 * may decide which of two is seen. */
enum { ROUNDING = 2 };
static const double edges = 1e-3; /* share of pixels */

static const char *program;
static char *folder;

#define SMALL "output.checkpoint_every=1h loading.unload_from= -q "

static const struct {
    const char *name, *words;
} runs[] = {
    {"cell", SMALL "default particles.count=300 loading.until=20MPa"},
    {"sizes", SMALL "p1-set2-lognormal particles.count=150 loading.until=density=0.32"},
    {"flat", SMALL "p2-v1 particles.count=150 loading.until=density=0.56 "
                   "loading.relax=0.1ns loading.hold=0.1ns"},
    {"die", SMALL "p3-hertz-mu0.05 particles.count=80 loading.until=2MPa "
                  "die.diameter=25um die.central=20um numerics.fidelity=fast"},
};

static const char *const pictures[] = {
    "cell",
    "cell --color bridges --ground dark --bare",
    "cell --show forces",
    "cell --show both --cut corner",
    "cell --slice y=0.5:3d --view front,flat",
    "cell --rose",
    "sizes --color size --ground transparent",
    "flat",
    "flat --show forces --color sign",
    "die --color pressure --view side",
};

/* False: the library cannot be used here. */
static bool draw(const char *library, const char *words, const char *file)
{
    char *line = g_strdup_printf("snapshot %s --force --size 500x400 -o %s", words, file);
    g_setenv("GB_GL", library, TRUE);
    struct result result = program_call(program, folder, line);
    g_test_message("%s, %s: %d %s", library, words, result.status, result.err);
    g_assert_true(result.status == 0 || result.status == 3);
    const bool drawn = result.status == 0;
    program_finish(&result);
    g_free(line);
    return drawn;
}

static cairo_surface_t *read_picture(const char *file)
{
    char *path = g_build_filename(folder, file, NULL);
    cairo_surface_t *picture = cairo_image_surface_create_from_png(path);
    g_assert_cmpint(cairo_surface_status(picture), ==, CAIRO_STATUS_SUCCESS);
    g_unlink(path);
    g_free(path);
    return picture;
}

static void compare(const char *words, cairo_surface_t *a, cairo_surface_t *b)
{
    const int width = cairo_image_surface_get_width(a);
    const int height = cairo_image_surface_get_height(a);
    const int stride = cairo_image_surface_get_stride(a);
    const uint8_t *left = cairo_image_surface_get_data(a);
    const uint8_t *right = cairo_image_surface_get_data(b);
    int differ = 0, beyond = 0, most = 0, drawn = 0;
    g_assert_cmpint(width, ==, cairo_image_surface_get_width(b));
    g_assert_cmpint(height, ==, cairo_image_surface_get_height(b));
    g_assert_cmpint(stride, ==, cairo_image_surface_get_stride(b));
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const int at = y * stride + 4 * x;
            int largest = 0;
            for (int c = 0; c < 3; c++) {
                largest = MAX(largest, abs(left[at + c] - right[at + c]));
            }
            drawn += memcmp(&left[at], left, 3) != 0;
            differ += largest > 0;
            beyond += largest > ROUNDING;
            most = MAX(most, largest);
        }
    }
    g_test_message("%s: %d of %d pixels differ, at most by %d", words, differ,
                   width * height, most);
    g_assert_cmpint(drawn, >, width * height / 50); /* not only the background */
    g_assert_cmpfloat(beyond, <=, edges * width * height);
}

static void test_pictures(void)
{
    for (size_t i = 0; i < G_N_ELEMENTS(pictures); i++) {
        if (!draw("osmesa", pictures[i], "a.png")) {
            g_test_skip("no OSMesa here");
            return;
        }
        cairo_surface_t *a = read_picture("a.png");
        const bool both = draw("egl", pictures[i], "b.png");
        if (both) {
            cairo_surface_t *b = read_picture("b.png");
            compare(pictures[i], a, b);
            cairo_surface_destroy(b);
        }
        cairo_surface_destroy(a);
        if (!both) {
            g_test_skip("no EGL without a window system here");
            return;
        }
    }
}

/* What a renderer and its compiler bring takes longer to load than all else. */
static void test_start(void)
{
    char *words[] = {(char *)"ldd", (char *)program, NULL};
    char *out = NULL;
    GError *error = NULL;
    g_spawn_sync(NULL, words, NULL, G_SPAWN_SEARCH_PATH, NULL, NULL, &out, NULL, NULL,
                 &error);
    g_assert_no_error(error);
    g_assert_nonnull(strstr(out, "libc."));
    g_assert_null(strstr(out, "OSMesa"));
    g_assert_null(strstr(out, "EGL"));
    g_assert_null(strstr(out, "LLVM"));
    g_free(out);
}

static void test_refused(void)
{
    g_setenv("GB_GL", "glx", TRUE);
    struct result result = program_call(program, folder, "snapshot cell -o c.png");
    g_assert_cmpint(result.status, ==, 2);
    g_assert_nonnull(strstr(result.err, "GB_GL = glx: must be"));
    g_assert_true(strchr(result.err, '\n') == result.err + strlen(result.err) - 1);
    program_finish(&result);
}

static void remove_run(const char *name)
{
    static const char *const files[] = {"curve.csv", "events.log", "preset.ini",
                                        "state.h5", "status.json"};
    char *directory = g_build_filename(folder, name, NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(files); i++) {
        char *path = g_build_filename(directory, files[i], NULL);
        g_unlink(path);
        g_free(path);
    }
    g_rmdir(directory);
    g_free(directory);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_assert_cmpint(argc, ==, 2);
    program = argv[1];
    folder = g_dir_make_tmp("greenbody-test-XXXXXX", NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(runs); i++) {
        char *line = g_strdup_printf("run --out %s %s", runs[i].name, runs[i].words);
        struct result result = program_call(program, folder, line);
        if (result.status != 0) {
            g_error("%s: %s", line, result.err);
        }
        program_finish(&result);
        g_free(line);
    }
    g_test_add_func("/gl/start", test_start);
    g_test_add_func("/gl/refused", test_refused);
    g_test_add_func("/gl/pictures", test_pictures);
    const int status = g_test_run();
    for (size_t i = 0; i < G_N_ELEMENTS(runs); i++) {
        remove_run(runs[i].name);
    }
    g_rmdir(folder);
    g_free(folder);
    return status;
}
