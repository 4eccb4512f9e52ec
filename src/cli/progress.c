#include "cli/progress.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/text/visible.h"
#include "io/status/stage_text.h"

static const double terminal_every_s = 0.25;
static const double plain_every_s = 5.0;

enum { LINE_MAX_BYTES = 256, WIDTH_UNKNOWN = 80 };

void gb_progress_init(struct gb_progress *progress, bool quiet)
{
    progress->quiet = quiet;
    progress->terminal = isatty(STDERR_FILENO) == 1;
    progress->shown = 0;
    progress->line_at = 0.0;
}

void gb_progress_clear(struct gb_progress *progress)
{
    if (progress->shown > 0) {
        gb_visible_rewrite(stderr, progress->shown, "");
        progress->shown = 0;
    }
}

void gb_progress_say(struct gb_progress *progress, const char *format, ...)
{
    if (progress->quiet) {
        return;
    }
    gb_progress_clear(progress);
    va_list args;
    va_start(args, format);
    (void)gb_visible_line_of(stderr, format, args);
    va_end(args);
}

bool gb_progress_due(const struct gb_progress *progress, double seconds)
{
    const double every = progress->terminal ? terminal_every_s : plain_every_s;
    return !progress->quiet && seconds - progress->line_at >= every;
}

/* "1 h 05 min", "2 min 10 s", "7 s". */
static void format_left(double seconds, char *text, size_t size)
{
    if (!(seconds >= 0.0) || seconds > 1e8) {
        snprintf(text, size, "time left unknown");
        return;
    }
    const long whole = (long)ceil(seconds);
    if (whole >= 3600) {
        snprintf(text, size, "%ld h %02ld min left", whole / 3600, whole / 60 % 60);
    } else if (whole >= 60) {
        snprintf(text, size, "%ld min %02ld s left", whole / 60, whole % 60);
    } else {
        snprintf(text, size, "%ld s left", whole);
    }
}

/* A run in a die: its stage, and the density where that changes by the pressure.  Powder comes
 * to rest when it does: no time is told then. */
static void format_stage(const struct gb_snapshot *shot, char *line, size_t size)
{
    char left[48], where[128], density[32] = "";
    const enum gb_stage stage = shot->stage.stage;
    format_left(shot->seconds_left, left, sizeof left);
    gb_stage_text_line(&shot->stage, where, sizeof where);
    if (shot->now_valid && (stage == GB_STAGE_PRESS || stage == GB_STAGE_UNLOADING)) {
        snprintf(density, sizeof density, "  density %.4f", shot->now.density);
    }
    snprintf(line, size, "%s%s  %.3gk steps/s  %.0f %%  %s", where, density,
             shot->evaluations_per_s / 1e3, 100.0 * shot->progress,
             shot->seconds_left >= 0.0 ? left : "estimating");
}

void gb_progress_point(char text[GB_PROGRESS_POINT], const struct gb_point *point,
                       const char *separator)
{
    char density[32] = "";
    if (isfinite(point->density)) {
        snprintf(density, sizeof density, "density %.4f%s", point->density, separator);
    }
    snprintf(text, GB_PROGRESS_POINT, "%sp %.4g MPa", density, point->p_pa / 1e6);
}

static void format_line(const struct gb_snapshot *shot, char *line, size_t size)
{
    char left[48];
    char where[GB_PROGRESS_POINT] = "relaxing the start";
    if (shot->stage.stage != GB_STAGE_NONE) {
        format_stage(shot, line, size);
        return;
    }
    format_left(shot->seconds_left, left, sizeof left);
    if (shot->now_valid) {
        gb_progress_point(where, &shot->now, "  ");
    }
    snprintf(line, size, "%s  %.3gM particle-evaluations/s  %.0f %%  %s", where,
             shot->particle_evaluations_per_s / 1e6, 100.0 * shot->progress, left);
}

/* A line longer than the terminal would wrap and could not be rewritten. */
static int terminal_width(void)
{
    struct winsize window;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 1) {
        return window.ws_col;
    }
    return WIDTH_UNKNOWN;
}

/* Replaces the line of a terminal; a line more elsewhere. */
static void write_line(struct gb_progress *progress, double seconds, char *line)
{
    progress->line_at = seconds;
    if (!progress->terminal) {
        gb_visible_line(stderr, "%s", line);
        return;
    }
    const int width = terminal_width() - 1;
    if ((int)strlen(line) > width) {
        line[width] = '\0';
    }
    const int length = (int)strlen(line);
    const int before = progress->shown < width ? progress->shown : width;
    gb_visible_rewrite(stderr, before, line);
    progress->shown = length > before ? length : before;
}

void gb_progress_show(struct gb_progress *progress, const struct gb_snapshot *snapshot)
{
    char line[LINE_MAX_BYTES];
    if (!progress->quiet) {
        format_line(snapshot, line, sizeof line);
        write_line(progress, snapshot->seconds, line);
    }
}

void gb_progress_count(struct gb_progress *progress, size_t done, size_t total,
                       const char *what, double seconds)
{
    char line[LINE_MAX_BYTES];
    char left[48];
    const bool last = done == total && progress->terminal && !progress->quiet;
    if (!last && !gb_progress_due(progress, seconds)) {
        return;
    }
    format_left(seconds / (double)done * (double)(total - done), left, sizeof left);
    snprintf(line, sizeof line, "%zu of %zu %s  %.0f %%  %s", done, total, what,
             100.0 * (double)done / (double)total, left);
    write_line(progress, seconds, line);
}
