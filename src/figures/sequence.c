/* Frames of all kept states of a run with one camera and one scale.  They go to a video by
 * ffmpeg, to an animated PNG, or to one PNG each. */

#include "figures/sequence.h"

#include <errno.h>
#include <gio/gio.h>
#include <glib.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

#include "base/file.h"
#include "draw/image.h"
#include "draw/packing_image.h"
#include "draw/text.h"
#include "figures/plotting.h"
#include "figures/states.h"
#include "greenbody/status.h"
#include "io/rundir.h"

struct video_settings {
    const char *path;
    const char *extension; /* of the path */
    const char *filter;    /* of ffmpeg */
    int width, height;     /* pixels */
    double frames_per_s;
    const char *title;
};

struct video {
    GSubprocess *process;
    char *path;
    char *part; /* file under way, renamed to path at the end */
};

/* ffmpeg reads raw RGBA frames from its standard input. */
static GSubprocess *start(const struct video_settings *settings, const char *part,
                          struct gb_error *err)
{
    char size[48];
    char rate[G_ASCII_DTOSTR_BUF_SIZE];
    GError *error = NULL;
    g_snprintf(size, sizeof size, "%dx%d", settings->width, settings->height);
    g_ascii_formatd(rate, sizeof rate, "%.6g", settings->frames_per_s);
    char *url = g_strconcat("file:", part, NULL);
    char *title = g_strconcat("title=", settings->title, NULL);
    /* clang-format off */
    const char *const arguments[] = {
        "ffmpeg", "-v", "error", "-nostdin", "-y",
        "-f", "rawvideo", "-pix_fmt", "rgba", "-s", size, "-r", rate, "-i", "pipe:0",
        "-vf", settings->filter,
        "-metadata", title, "-metadata", "comment=greenbody " GB_VERSION,
        url, NULL};
    /* clang-format on */
    GSubprocess *process = g_subprocess_newv(arguments,
                                             G_SUBPROCESS_FLAGS_STDIN_PIPE |
                                                 G_SUBPROCESS_FLAGS_STDOUT_SILENCE |
                                                 G_SUBPROCESS_FLAGS_STDERR_PIPE,
                                             &error);
    g_free(url);
    g_free(title);
    if (process == NULL) {
        gb_error_set(err, GB_ERR_MACHINE, "ffmpeg cannot be started: %s", error->message);
        g_error_free(error);
    }
    return process;
}

static bool check_program(const char *path, struct gb_error *err)
{
    char *program = g_find_program_in_path("ffmpeg");
    const bool found = program != NULL;
    g_free(program);
    return found || gb_error_set(err, GB_ERR_MACHINE,
                                 "%.300s: needs the program ffmpeg, which is not "
                                 "installed; a name ending in .png gives an animated PNG",
                                 path);
}

static bool video_add(struct video *video, const struct gb_image *image,
                      struct gb_error *err)
{
    const size_t size = 4 * (size_t)image->width * (size_t)image->height;
    GOutputStream *pipe = g_subprocess_get_stdin_pipe(video->process);
    return g_output_stream_write_all(pipe, image->rgba, size, NULL, NULL, NULL) ||
           gb_error_set(err, GB_ERR_MACHINE, "ffmpeg accepts no more frames");
}

/* Last line of the stderr of ffmpeg. */
static void read_reason(struct video *video, char *reason, size_t size)
{
    gsize length = 0;
    char text[4096] = "";
    g_input_stream_read_all(g_subprocess_get_stderr_pipe(video->process), text,
                            sizeof text - 1, &length, NULL, NULL);
    text[length] = '\0';
    g_strchomp(text);
    const char *last = strrchr(text, '\n');
    g_strlcpy(reason, last != NULL ? last + 1 : text, size);
}

/* Waits for ffmpeg; err has the reason when it failed. */
static bool finish_process(struct video *video, struct gb_error *err)
{
    char reason[200];
    g_output_stream_close(g_subprocess_get_stdin_pipe(video->process), NULL, NULL);
    read_reason(video, reason, sizeof reason);
    const bool encoded = g_subprocess_wait_check(video->process, NULL, NULL);
    g_object_unref(video->process);
    return encoded || gb_error_set(err, GB_ERR_MACHINE, "%.300s: ffmpeg failed: %s",
                                   video->path, reason);
}

/* Puts the file in place when all frames were added (done), and returns that; removes it
 * otherwise.  NULL is fine. */
static bool video_close(struct video *video, bool done, struct gb_error *err)
{
    if (video == NULL) {
        return done;
    }
    if (video->process != NULL) {
        done = finish_process(video, err) && done;
        if (done && g_rename(video->part, video->path) != 0) {
            done = gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be written: %s",
                                video->path, g_strerror(errno));
        }
        if (!done) {
            g_unlink(video->part);
        }
    }
    g_free(video->part);
    g_free(video->path);
    g_free(video);
    return done;
}

/* Errors: GB_ERR_MACHINE when there is no ffmpeg. */
static bool video_open(struct video **out, const struct video_settings *settings,
                       struct gb_error *err)
{
    *out = NULL;
    if (!check_program(settings->path, err) ||
        !gb_file_check_target(settings->path, err)) {
        return false;
    }
    struct video *video = g_new0(struct video, 1);
    video->path = g_strdup(settings->path);
    video->part = g_strdup_printf("%s.part%s", settings->path, settings->extension);
    video->process = start(settings, video->part, err);
    if (video->process == NULL) {
        (void)video_close(video, false, NULL);
        return false;
    }
    *out = video;
    return true;
}

/* Duration of the last frame of an animated PNG, ms. */
static const int last_frame_ms = 1500;

enum { MAX_DIGITS = 9 };

/* Path of frame `number`; NULL unless the path has one %d or %0Nd.  g_free. */
static char *numbered_path(const char *path, int number)
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
    struct gb_image_animation *apng;
};

static bool close_apng(void *data, bool done, struct gb_error *err)
{
    struct apng_writer *writer = data;
    if (writer == NULL) {
        return done;
    }
    done = done && gb_image_animation_write(writer->apng, writer->output.path, err);
    gb_image_animation_destroy(writer->apng);
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
    return gb_image_animation_create(&writer->apng, output->count,
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
    return gb_image_animation_add(writer->apng, image,
                                  last ? MAX(frame_ms, last_frame_ms) : frame_ms, err);
}

const struct gb_frame_writer gb_sequence_apng = {open_apng, add_apng, close_apng};

static bool open_video(void **out, const struct gb_frame_output *output,
                       const struct gb_state *first, struct gb_error *err)
{
    const struct gb_plotting_format *format =
        gb_plotting_format_find(output->path, GB_PLOTTING_SEQUENCE);
    const struct video_settings settings = {
        .path = output->path,
        .extension = format->extension,
        .filter = format->video_filter,
        .width = output->width,
        .height = output->height,
        .frames_per_s = output->frames_per_s,
        .title = first->preset,
    };
    struct video *video = NULL;
    const bool done = video_open(&video, &settings, err);
    *out = video;
    return done;
}

static bool add_video(void *data, const struct gb_image *image,
                      const struct gb_state *state, int number, struct gb_error *err)
{
    (void)state;
    (void)number;
    return video_add(data, image, err);
}

static bool close_video(void *data, bool done, struct gb_error *err)
{
    return video_close(data, done, err);
}

const struct gb_frame_writer gb_sequence_video = {open_video, add_video, close_video};

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
    char *path = numbered_path(output->path, number);
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

/* One PNG per frame, for a path with one %d or %03d. */
static const struct gb_frame_writer sequence_numbered = {open_numbered, add_numbered,
                                                         close_numbered};

enum { MAX_FRAMES = 10000 };

struct job {
    const struct gb_sequence *sequence;
    struct gb_packing_image *packing_image;
    GPtrArray *paths; /* of the states */
    const struct gb_frame_writer *methods;
    void *writer;
};

static bool is_numbered(const char *output)
{
    return strchr(output, '%') != NULL;
}

static bool check_target(const char *path, bool force, struct gb_error *err)
{
    return gb_rundir_files_protect(path, err) && gb_file_check_target(path, err) &&
           (force || !g_file_test(path, G_FILE_TEST_EXISTS) ||
            gb_error_set(err, GB_ERR_INPUT, "%.300s: exists; --force replaces it", path));
}

static bool check_numbered_targets(const struct job *job, struct gb_error *err)
{
    bool good = true;
    for (guint k = 0; k < job->paths->len && good; k++) {
        char *path = numbered_path(job->sequence->output, (int)k + 1);
        good = path != NULL
                   ? check_target(path, job->sequence->force, err)
                   : gb_error_set(err, GB_ERR_INPUT,
                                  "-o %.300s: expected one number as in frame-%%03d.png",
                                  job->sequence->output);
        g_free(path);
    }
    return good;
}

/* Chooses the writer, and checks its targets before the first frame. */
static bool choose_writer(struct job *job, struct gb_error *err)
{
    const char *output = job->sequence->output;
    if (is_numbered(output)) {
        job->methods = &sequence_numbered;
        return check_numbered_targets(job, err);
    }
    const struct gb_plotting_format *format =
        gb_plotting_format_find(output, GB_PLOTTING_SEQUENCE);
    job->methods = format != NULL ? format->frames : &gb_sequence_apng;
    return check_target(output, job->sequence->force, err);
}

/* Extends the box in view and the scales by those of a state. */
static bool include_state(struct gb_packing_image *packing_image,
                          struct gb_picture_style_request *all,
                          const struct gb_state *state, struct gb_error *err)
{
    struct gb_picture_style *style = NULL;
    const struct gb_cell cell = gb_state_cell(state);
    gb_view_include(&packing_image->viewpoint, &cell);
    if (!gb_picture_style_create(&style, state, &packing_image->style, err)) {
        return false;
    }
    all->low = fmin(all->low, style->scale.low);
    all->high = fmax(all->high, style->scale.high);
    all->max_force_n = fmax(all->max_force_n, style->max_force_n);
    gb_picture_style_destroy(style);
    return true;
}

/* Sets the common box and scales. */
static bool set_common_scales(struct job *job, struct gb_error *err)
{
    struct gb_packing_image *packing_image = job->packing_image;
    struct gb_picture_style_request all = packing_image->style;
    bool good = true;
    all.low = INFINITY;
    all.high = -INFINITY;
    for (guint k = 0; k < job->paths->len && good; k++) {
        struct gb_state *state = NULL;
        good = gb_state_read(&state, g_ptr_array_index(job->paths, k), err) &&
               include_state(packing_image, &all, state, err);
        gb_state_destroy(state);
    }
    packing_image->style = all;
    return good;
}

static bool open_writer(struct job *job, const struct gb_state *first,
                        const struct gb_image *image, struct gb_error *err)
{
    const struct gb_frame_output output = {
        job->sequence->output, job->packing_image,   image->width,
        image->height,         (int)job->paths->len, job->sequence->frames_per_s};
    return job->methods->open(&job->writer, &output, first, err);
}

static bool render_frame(struct job *job, guint k, struct gb_error *err)
{
    struct gb_state *state = NULL;
    struct gb_image *image = NULL;
    const bool done = gb_state_read(&state, g_ptr_array_index(job->paths, k), err) &&
                      gb_packing_image_render(&image, job->packing_image, state, err) &&
                      (k > 0 || open_writer(job, state, image, err)) &&
                      job->methods->add(job->writer, image, state, (int)k + 1, err);
    gb_image_destroy(image);
    gb_state_destroy(state);
    return done;
}

static bool render_all(struct job *job, struct gb_error *err)
{
    bool done = set_common_scales(job, err);
    if (done) {
        const int saved = gb_text_mute_begin();
        done = gb_renderer_open(&job->packing_image->renderer, err);
        gb_text_mute_end(saved);
    }
    for (guint k = 0; k < job->paths->len && done; k++) {
        done = render_frame(job, k, err);
        if (done && job->sequence->progress != NULL) {
            job->sequence->progress(k + 1, job->paths->len, job->sequence->data);
        }
    }
    gb_renderer_close(job->packing_image->renderer);
    job->packing_image->renderer = NULL;
    return job->writer != NULL ? job->methods->close(job->writer, done, err) : done;
}

static bool check_count(const struct job *job, struct gb_error *err)
{
    return (job->paths->len >= 2 && job->paths->len <= MAX_FRAMES) ||
           gb_error_set(err, GB_ERR_INPUT,
                        "%.300s: keeps %u states; --sequence takes 2 to %d: run it with "
                        "output.snapshots_at=\"every 20\" or another number of points",
                        job->sequence->directory, job->paths->len, MAX_FRAMES);
}

bool gb_sequence_write(const struct gb_sequence *sequence,
                       struct gb_packing_image *packing_image, struct gb_error *err)
{
    struct job job = {.sequence = sequence, .packing_image = packing_image};
    job.paths = gb_states_along(sequence->directory, err);
    if (job.paths == NULL) {
        return false;
    }
    char *preset = gb_states_preset(sequence->directory);
    packing_image->preset = preset;
    const bool done =
        check_count(&job, err) && choose_writer(&job, err) && render_all(&job, err);
    g_ptr_array_unref(job.paths);
    packing_image->preset = NULL;
    g_free(preset);
    return done;
}
