#include "figures/video.h"

#include <errno.h>
#include <gio/gio.h>
#include <glib/gstdio.h>
#include <string.h>

#include "base/file.h"

struct gb_video {
    GSubprocess *process;
    char *path, *part; /* where it is to be, and where it grows */
};

static const char *const endings[] = {".mp4", ".webm", ".mkv", ".gif"};

static const char *ending_of(const char *path)
{
    for (size_t k = 0; k < G_N_ELEMENTS(endings); k++) {
        if (g_str_has_suffix(path, endings[k])) {
            return endings[k];
        }
    }
    return NULL;
}

bool gb_video_knows(const char *path)
{
    return ending_of(path) != NULL;
}

/* Encoders of films want even sides and colours that every player shows; a GIF wants its
 * own 256 colours. */
static const char *filter_of(const char *path)
{
    return g_str_has_suffix(path, ".gif")
               ? "split[a][b];[a]palettegen[p];[b][p]paletteuse"
               : "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p";
}

bool gb_video_open(struct gb_video **out, const char *path, int width, int height,
                   double frames_per_s, const char *title, struct gb_error *err)
{
    *out = NULL;
    char *program = g_find_program_in_path("ffmpeg");
    if (program == NULL) {
        return gb_error_set(err, GB_ERR_MACHINE,
                            "%.300s: needs the program ffmpeg, which is not here; a name "
                            "ending in .png gives an animated picture without it",
                            path);
    }
    g_free(program);
    if (!gb_file_check_target(path, err)) {
        return false;
    }
    char size[48];
    char rate[G_ASCII_DTOSTR_BUF_SIZE];
    g_snprintf(size, sizeof size, "%dx%d", width, height);
    g_ascii_formatd(rate, sizeof rate, "%.6g", frames_per_s);
    struct gb_video *video = g_new0(struct gb_video, 1);
    video->path = g_strdup(path);
    video->part = g_strdup_printf("%s.part%s", path, ending_of(path));
    char *name = g_strconcat("file:", video->part, NULL);
    char *words = g_strdup_printf("title=%s", title);
    const char *const arguments[] = {"ffmpeg",
                                     "-v",
                                     "error",
                                     "-nostdin",
                                     "-y",
                                     "-f",
                                     "rawvideo",
                                     "-pix_fmt",
                                     "rgba",
                                     "-s",
                                     size,
                                     "-r",
                                     rate,
                                     "-i",
                                     "pipe:0",
                                     "-vf",
                                     filter_of(path),
                                     "-metadata",
                                     words,
                                     "-metadata",
                                     "comment=greenbody " GB_VERSION,
                                     name,
                                     NULL};
    GError *error = NULL;
    video->process = g_subprocess_newv(arguments,
                                       G_SUBPROCESS_FLAGS_STDIN_PIPE |
                                           G_SUBPROCESS_FLAGS_STDOUT_SILENCE |
                                           G_SUBPROCESS_FLAGS_STDERR_PIPE,
                                       &error);
    g_free(name);
    g_free(words);
    if (video->process == NULL) {
        gb_error_set(err, GB_ERR_MACHINE, "ffmpeg cannot be started: %s", error->message);
        g_error_free(error);
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
           gb_error_set(err, GB_ERR_MACHINE, "ffmpeg takes no more frames");
}

/* The last line that ffmpeg said. */
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

bool gb_video_close(struct gb_video *video, bool good, struct gb_error *err)
{
    if (video == NULL) {
        return good;
    }
    if (video->process != NULL) {
        char reason[200];
        g_output_stream_close(g_subprocess_get_stdin_pipe(video->process), NULL, NULL);
        read_reason(video, reason, sizeof reason);
        const bool made = g_subprocess_wait_check(video->process, NULL, NULL);
        if (!made) {
            gb_error_set(err, GB_ERR_MACHINE, "%.300s: ffmpeg cannot make it: %s",
                         video->path, reason);
        }
        good = good && made;
        if (good && g_rename(video->part, video->path) != 0) {
            good = gb_error_set(err, GB_ERR_MACHINE, "%.300s: cannot be written: %s",
                                video->path, g_strerror(errno));
        }
        if (!good) {
            g_unlink(video->part);
        }
        g_object_unref(video->process);
    }
    g_free(video->part);
    g_free(video->path);
    g_free(video);
    return good;
}
