#include "figures/sequence/video.h"

#include <errno.h>
#include <gio/gio.h>
#include <glib/gstdio.h>
#include <string.h>

#include "base/file.h"

struct gb_video {
    GSubprocess *process;
    char *path;
    char *part; /* file under way, renamed to path at the end */
};

/* ffmpeg reads raw RGBA frames from its standard input. */
static GSubprocess *start(const struct gb_video_settings *settings, const char *part,
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

bool gb_video_open(struct gb_video **out, const struct gb_video_settings *settings,
                   struct gb_error *err)
{
    *out = NULL;
    if (!check_program(settings->path, err) ||
        !gb_file_check_target(settings->path, err)) {
        return false;
    }
    struct gb_video *video = g_new0(struct gb_video, 1);
    video->path = g_strdup(settings->path);
    video->part = g_strdup_printf("%s.part%s", settings->path, settings->extension);
    video->process = start(settings, video->part, err);
    if (video->process == NULL) {
        (void)gb_video_close(video, false, NULL);
        return false;
    }
    *out = video;
    return true;
}

bool gb_video_add(struct gb_video *video, const struct gb_image *image,
                  struct gb_error *err)
{
    const size_t size = 4 * (size_t)image->width * (size_t)image->height;
    GOutputStream *pipe = g_subprocess_get_stdin_pipe(video->process);
    return g_output_stream_write_all(pipe, image->rgba, size, NULL, NULL, NULL) ||
           gb_error_set(err, GB_ERR_MACHINE, "ffmpeg accepts no more frames");
}

/* Last line of the stderr of ffmpeg. */
static void read_reason(struct gb_video *video, char *reason, size_t size)
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
static bool finish_process(struct gb_video *video, struct gb_error *err)
{
    char reason[200];
    g_output_stream_close(g_subprocess_get_stdin_pipe(video->process), NULL, NULL);
    read_reason(video, reason, sizeof reason);
    const bool encoded = g_subprocess_wait_check(video->process, NULL, NULL);
    g_object_unref(video->process);
    return encoded || gb_error_set(err, GB_ERR_MACHINE, "%.300s: ffmpeg failed: %s",
                                   video->path, reason);
}

bool gb_video_close(struct gb_video *video, bool done, struct gb_error *err)
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
