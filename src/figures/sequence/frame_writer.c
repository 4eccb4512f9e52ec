#include "figures/sequence/frame_writer.h"

#include <math.h>
#include <string.h>

#include <glib.h>

#include "draw/image/png.h"
#include "figures/output_formats.h"
#include "figures/sequence/video.h"

/* Duration of the last frame of an animated PNG, ms. */
static const int last_frame_ms = 1500;

enum { MAX_DIGITS = 9 };

char *gb_frame_writer_path(const char *path, int number)
{
    const char *percent = strchr(path, '%');
    if (percent == NULL) {
        return NULL;
    }
    const int digits = (int)g_ascii_strtoull(percent + 1, NULL, 10);
    const char *end = percent + 1 + strspn(percent + 1, "0123456789");
    if (*end != 'd' || digits > MAX_DIGITS || strchr(end, '%') != NULL) {
        return NULL;
    }
    return g_strdup_printf("%.*s%0*d%s", (int)(percent - path), path, digits, number,
                           end + 1);
}

/* The methods below start with a copy of the output. */

struct apng_writer {
    struct gb_frame_output output;
    struct gb_packing_image_texts texts;
    struct gb_png_animation *apng;
};

static bool close_apng(void *data, bool done, struct gb_error *err)
{
    struct apng_writer *writer = data;
    if (writer == NULL) {
        return done;
    }
    done = done && gb_png_animation_write(writer->apng, writer->output.path, err);
    gb_png_animation_destroy(writer->apng);
    g_free(writer);
    return done;
}

static bool open_apng(void **out, const struct gb_frame_output *output,
                      const struct gb_state *first, struct gb_error *err)
{
    struct apng_writer *writer = g_new0(struct apng_writer, 1);
    writer->output = *output;
    gb_packing_image_describe(&writer->texts, first, output->packing_image->preset);
    *out = writer;
    return gb_png_animation_create(&writer->apng, output->count,
                          gb_packing_image_alpha(output->packing_image),
                          writer->texts.text, writer->texts.count, err);
}

static bool add_apng(void *data, const struct gb_image *image,
                     const struct gb_state *state, int number, struct gb_error *err)
{
    struct apng_writer *writer = data;
    (void)state;
    const int frame_ms = (int)lround(1000.0 / writer->output.frames_per_s);
    const bool last = number == writer->output.count;
    return gb_png_animation_add(writer->apng, image,
                       last ? MAX(frame_ms, last_frame_ms) : frame_ms, err);
}

const struct gb_frame_writer gb_frame_writer_apng = {open_apng, add_apng, close_apng};

static bool open_video(void **out, const struct gb_frame_output *output,
                       const struct gb_state *first, struct gb_error *err)
{
    const struct gb_output_formats_row *format =
        gb_output_formats_find(output->path, GB_OUTPUT_FORMATS_SEQUENCE);
    const struct gb_video_settings settings = {
        .path = output->path,
        .extension = format->extension,
        .filter = format->video_filter,
        .width = output->width,
        .height = output->height,
        .frames_per_s = output->frames_per_s,
        .title = first->preset,
    };
    struct gb_video *video = NULL;
    const bool done = gb_video_open(&video, &settings, err);
    *out = video;
    return done;
}

static bool add_video(void *data, const struct gb_image *image,
                      const struct gb_state *state, int number, struct gb_error *err)
{
    (void)state;
    (void)number;
    return gb_video_add(data, image, err);
}

static bool close_video(void *data, bool done, struct gb_error *err)
{
    return gb_video_close(data, done, err);
}

const struct gb_frame_writer gb_frame_writer_video = {open_video, add_video, close_video};

static bool open_numbered(void **out, const struct gb_frame_output *output,
                          const struct gb_state *first, struct gb_error *err)
{
    (void)first;
    (void)err;
    *out = g_memdup2(output, sizeof *output);
    return true;
}

static bool add_numbered(void *data, const struct gb_image *image,
                         const struct gb_state *state, int number, struct gb_error *err)
{
    const struct gb_frame_output *output = data;
    char *path = gb_frame_writer_path(output->path, number);
    const bool done =
        gb_packing_image_save(image, output->packing_image, state, path, err);
    g_free(path);
    return done;
}

static bool close_numbered(void *data, bool done, struct gb_error *err)
{
    (void)err;
    g_free(data);
    return done;
}

const struct gb_frame_writer gb_frame_writer_numbered = {open_numbered, add_numbered,
                                                         close_numbered};
