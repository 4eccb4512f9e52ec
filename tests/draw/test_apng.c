/* A PNG that moves: its chunks, their numbers, and the part of a frame that changed. */
#include <glib.h>
#include <glib/gstdio.h>
#include <string.h>

#include "draw/image.h"

enum { WIDTH = 40, HEIGHT = 30, FRAMES = 3 };

static guint32 number(const char *at)
{
    guint32 value = 0;
    for (int k = 0; k < 4; k++) {
        value = value << 8 | (guint8)at[k];
    }
    return value;
}

static struct gb_image *canvas(void)
{
    struct gb_image *image = NULL;
    g_assert_true(gb_image_create(&image, WIDTH, HEIGHT, NULL));
    memset(image->rgba, 255, (size_t)4 * WIDTH * HEIGHT);
    return image;
}

static void dot(struct gb_image *image, int x, int y)
{
    image->rgba[4 * (y * image->width + x)] = 0;
}

static void write_film(const char *path)
{
    const struct gb_image_text text = {"Seed", "7"};
    struct gb_image_animation *apng = NULL;
    struct gb_error err = {0};
    struct gb_image *image = canvas();
    g_assert_true(gb_image_animation_create(&apng, FRAMES, true, &text, 1, &err));
    g_assert_true(gb_image_animation_add(apng, image, 125, &err));
    dot(image, 5, 7);
    dot(image, 20, 11);
    g_assert_true(gb_image_animation_add(apng, image, 125, &err));
    g_assert_true(gb_image_animation_add(apng, image, 1500, &err)); /* nothing new */
    g_assert_true(gb_image_animation_write(apng, path, &err));
    gb_image_animation_destroy(apng);
    gb_image_destroy(image);
}

/* Width, height, left, top and milliseconds of a frame. */
static void check_frame(const char *data, guint32 w, guint32 h, guint32 x, guint32 y,
                        guint32 ms)
{
    const guint32 wanted[] = {w, h, x, y};
    for (int k = 0; k < 4; k++) {
        g_assert_cmpuint(number(data + 4 + 4 * k), ==, wanted[k]);
    }
    g_assert_cmpuint(number(data + 20), ==, ms << 16 | 1000);
}

static void check_chunks(const char *png, gsize size)
{
    guint32 next = 0;
    int frames = 0;
    GString *order = g_string_new(NULL);
    for (gsize at = 8; at + 12 <= size; at += number(png + at) + 12) {
        const char *name = png + at + 4;
        const char *data = name + 4;
        g_string_append_len(order, name, 4);
        g_string_append_c(order, ' ');
        if (memcmp(name, "acTL", 4) == 0) {
            g_assert_cmpuint(number(data), ==, FRAMES);
        } else if (memcmp(name, "fcTL", 4) == 0) {
            g_assert_cmpuint(number(data), ==, next++);
            frames++;
            if (frames == 1) {
                check_frame(data, WIDTH, HEIGHT, 0, 0, 125);
            } else if (frames == 2) {
                check_frame(data, 16, 5, 5, 7, 125);
            } else {
                check_frame(data, 1, 1, 0, 0, 1500);
            }
        } else if (memcmp(name, "fdAT", 4) == 0) {
            g_assert_cmpuint(number(data), ==, next++);
        }
    }
    g_assert_cmpint(frames, ==, FRAMES);
    g_assert_true(
        g_str_has_suffix(order->str, "acTL fcTL IDAT fcTL fdAT fcTL fdAT IEND "));
    g_string_free(order, TRUE);
}

static void test_film(void)
{
    char *base = g_dir_make_tmp("apng-XXXXXX", NULL);
    char *path = g_build_filename(base, "x.png", NULL);
    char *again = g_build_filename(base, "y.png", NULL);
    char *png = NULL;
    char *same = NULL;
    char *seed = NULL;
    gsize size = 0;
    gsize other = 0;
    struct gb_error err = {0};
    write_film(path);
    write_film(again);
    g_assert_true(g_file_get_contents(path, &png, &size, NULL));
    g_assert_true(g_file_get_contents(again, &same, &other, NULL));
    g_assert_cmpuint(size, ==, other);
    g_assert_cmpint(memcmp(png, same, size), ==, 0);
    check_chunks(png, size);
    g_assert_true(gb_image_read_text(path, "Seed", &seed, &err));
    g_assert_cmpstr(seed, ==, "7");
    g_remove(path);
    g_remove(again);
    g_rmdir(base);
    g_free(seed);
    g_free(png);
    g_free(same);
    g_free(path);
    g_free(again);
    g_free(base);
}

int main(int argc, char **argv)
{
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/apng/film", test_film);
    return g_test_run();
}
