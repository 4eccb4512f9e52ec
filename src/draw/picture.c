#include "draw/picture.h"

#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "base/file.h"
#include "base/units.h"
#include "draw/caption.h"
#include "draw/osmesa.h"
#include "draw/png.h"

void gb_picture_init(struct gb_picture *picture)
{
    *picture = (struct gb_picture){.width = 1600, .height = 1200, .words = true};
    gb_view_parse("corner", &picture->look, NULL);
}

/* Mesa, LLVM, fontconfig and Pango complain on stderr by themselves.  Returns the real
 * one, or -1. */
static int hush(void)
{
    fflush(stderr);
    const int kept = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept >= 0 && nowhere >= 0) {
        dup2(nowhere, STDERR_FILENO);
    }
    if (nowhere >= 0) {
        close(nowhere);
    }
    return kept;
}

static void speak(int kept)
{
    if (kept >= 0) {
        fflush(stderr);
        dup2(kept, STDERR_FILENO);
        close(kept);
    }
}

static bool paint(struct gb_image *image, const struct gb_picture *picture,
                  const struct gb_state *state, struct gb_error *err)
{
    struct gb_osmesa *painter = NULL;
    struct gb_scene *scene = NULL;
    struct gb_caption_layout layout;
    gb_caption_place(image->width, image->height, picture->words, &layout);
    const bool done = gb_scene_create(&scene, state, &picture->look, &layout.scene,
                                      picture->ground, err) &&
                      gb_osmesa_open(&painter, err) &&
                      gb_osmesa_paint(painter, scene, image, err) &&
                      gb_caption_draw(image, &layout, scene, state, err);
    gb_osmesa_close(painter);
    gb_scene_destroy(scene);
    return done;
}

bool gb_picture_paint(struct gb_image **out, const struct gb_picture *picture,
                      const struct gb_state *state, struct gb_error *err)
{
    if (!gb_image_create(out, picture->width, picture->height, err)) {
        return false;
    }
    const int kept = hush();
    const bool done = paint(*out, picture, state, err);
    speak(kept);
    if (!done) {
        gb_image_destroy(*out);
        *out = NULL;
    }
    return done;
}

bool gb_picture_write(const struct gb_picture *picture, const struct gb_state *state,
                      const char *path, struct gb_error *err)
{
    char seed[24];
    char density[32];
    char pressure[48] = "unknown";
    struct gb_image *image = NULL;
    /* before the work, not after it */
    if (!gb_file_check_target(path, err) ||
        !gb_picture_paint(&image, picture, state, err)) {
        return false;
    }
    snprintf(seed, sizeof seed, "%" PRIu64, state->seed);
    snprintf(density, sizeof density, "%.6g", state->point.density);
    if (isfinite(state->point.p_pa)) {
        gb_units_format_short(state->point.p_pa, GB_DIM_PRESSURE, 6, pressure,
                              sizeof pressure);
    }
    const struct gb_png_text texts[] = {
        {"Software", "greenbody " GB_VERSION}, {"Title", state->preset}, {"Seed", seed},
        {"Density", density},                  {"Pressure", pressure},
    };
    const bool done = gb_png_write(image, picture->ground != GB_GROUND_TRANSPARENT, texts,
                                   sizeof texts / sizeof texts[0], path, err);
    gb_image_destroy(image);
    return done;
}
