#include "tui/term/term.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <ncurses.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <term.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "tui/term/crash.h"
#include "tui/term/input/term_keys.h"
#include "tui/term/input/term_signals.h"
#include "tui/term/term_profile.h"
#include "tui/term/term_style.h"
#include "tui/term/term_theme.h"
#include "tui/term/term_tty.h"

/* Width of a cell in pixels where the terminal does not report it. */
enum { DEFAULT_CELL_WIDTH = 10 };

struct gb_term {
    SCREEN *screen;
    FILE *out, *in;
    int out_fd, in_fd;
    struct gb_term_keys keys;
    struct gb_term_signals signals;
    int saved_out, saved_err;
    int64_t frames;
    double since_s; /* clock at the start, s */
    int64_t repaints;
    bool shaded, mouse;
    struct gb_term_profile profile;
    struct termios modes;
    uint64_t style[GB_STYLE_COUNT];
};

static void set_modes(void)
{
    cbreak();
    noecho();
    nonl();
    curs_set(0);
    keypad(stdscr, TRUE); /* arrows and keypad send what terminfo says */
}

static bool start_screen(struct gb_term *term, const char *type, struct gb_error *err)
{
    use_env(FALSE); /* LINES and COLUMNS may be outdated */
    use_tioctl(TRUE);
    term->screen = newterm(type, term->out, term->in);
    if (term->screen == NULL) {
        return gb_error_set(err, GB_ERR_MACHINE, "cannot use the terminal type %s", type);
    }
    set_modes();
    gb_term_set_theme(term, term->profile.theme);
    return true;
}

static void install_crash_handler(const struct gb_term *term)
{
    char reset[192];
    const char *leave = tigetstr("rmcup");
    const char *cursor = tigetstr("cnorm");
    const char *plain = tigetstr("sgr0");
    g_snprintf(reset, sizeof reset, "%s%s%s%s\r\n",
               term->profile.can_mouse ? "\033[?1006l\033[?1000l" : "",
               plain != NULL && plain != (char *)-1 ? plain : "",
               leave != NULL && leave != (char *)-1 ? leave : "",
               cursor != NULL && cursor != (char *)-1 ? cursor : "");
    gb_crash_install(term->out_fd, term->saved_err, &term->modes, reset);
}

static int duplicate(int fd)
{
    return fcntl(fd, F_DUPFD_CLOEXEC, 3);
}

/* Keys are read from standard input, or from /dev/tty if input is a pipe. */
static bool open_streams(struct gb_term *term, struct gb_error *err)
{
    if (!isatty(STDOUT_FILENO)) {
        return gb_error_set(err, GB_ERR_MACHINE, "standard output is not a terminal");
    }
    term->saved_out = duplicate(STDOUT_FILENO);
    term->saved_err = duplicate(STDERR_FILENO);
    term->out_fd = duplicate(STDOUT_FILENO);
    term->in_fd = isatty(STDIN_FILENO) ? duplicate(STDIN_FILENO)
                                       : open("/dev/tty", O_RDONLY | O_CLOEXEC);
    term->out = term->out_fd < 0 ? NULL : fdopen(term->out_fd, "w");
    term->in = term->in_fd < 0 ? NULL : fdopen(term->in_fd, "r");
    if (term->out == NULL || term->in == NULL ||
        tcgetattr(term->out_fd, &term->modes) != 0) {
        return gb_error_set(err, GB_ERR_MACHINE, "cannot open the terminal: %s",
                            strerror(errno));
    }
    return true;
}

static void close_streams(struct gb_term *term)
{
    if (term->out != NULL) {
        fclose(term->out);
    }
    if (term->in != NULL) {
        fclose(term->in);
    }
    if (term->saved_out >= 0) {
        close(term->saved_out);
    }
    if (term->saved_err >= 0) {
        close(term->saved_err);
    }
}

bool gb_term_start(struct gb_term **out, const struct gb_settings *settings,
                   struct gb_error *err)
{
    struct gb_term *term = gb_alloc_array(1, sizeof *term, err);
    if (term == NULL) {
        return false;
    }
    term->saved_out = term->saved_err = -1;
    if (!open_streams(term, err)) {
        goto fail;
    }
    if (!gb_term_profile_detect(&term->profile, term->out_fd, settings, err)) {
        goto fail;
    }
    gb_term_signals_catch(&term->signals);
    if (!start_screen(term, term->profile.type, err)) {
        gb_term_signals_release(&term->signals);
        goto fail;
    }
    gb_term_tty_redirect();
    install_crash_handler(term);
    gb_term_mouse(term, settings->mouse == 0);
    term->since_s = gb_clock_s();
    *out = term;
    return true;
fail:
    close_streams(term);
    gb_alloc_free(term);
    return false;
}

void gb_term_stop(struct gb_term *term)
{
    gb_crash_remove();
    endwin();
    delscreen(term->screen);
    fprintf(stderr, "greenbody: frames drawn: %lld in %.1f s\n", /* into the log */
            (long long)term->frames, gb_clock_s() - term->since_s);
    gb_term_tty_restore(term->saved_out, term->saved_err);
    close_streams(term);
}

void gb_term_abandon(struct gb_term *term)
{
    gb_crash_remove();
    gb_term_signals_give_up(&term->signals);
    close_streams(term);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing >= 0) {
        dup2(nothing, STDIN_FILENO);
        close(nothing);
    }
}

void gb_term_destroy(struct gb_term *term)
{
    if (term != NULL) {
        gb_term_signals_release(&term->signals);
    }
    gb_alloc_free(term);
}

void gb_term_suspend(struct gb_term *term)
{
    endwin();
    gb_term_tty_restore(term->saved_out, term->saved_err);
    gb_term_signals_stop();
    gb_term_tty_redirect();
    set_modes();
}

/* The new size is read from the kernel here, not in a signal handler. */
static struct gb_term_event resized(struct gb_term *term)
{
    term->repaints++;
    struct winsize size;
    if (ioctl(term->out_fd, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 &&
        size.ws_col > 0) {
        resizeterm(size.ws_row, size.ws_col);
    }
    return (struct gb_term_event){.kind = GB_TERM_RESIZED, .code = 0};
}

static struct gb_term_event from_signal(struct gb_term *term)
{
    const int signal = gb_term_signals_read(&term->signals);
    switch (signal) {
    case SIGINT:
        return (struct gb_term_event){.kind = GB_TERM_INTERRUPT, .code = SIGINT};
    case SIGTERM:
    case SIGQUIT:
        return (struct gb_term_event){.kind = GB_TERM_TERMINATE, .code = signal};
    case SIGHUP:
        return (struct gb_term_event){.kind = GB_TERM_HANGUP, .code = SIGHUP};
    case SIGTSTP:
        gb_term_suspend(term);
        gb_term_repaint(term);
        return resized(term);
    case SIGCONT:
        reset_prog_mode();
        gb_term_repaint(term);
        return resized(term);
    case SIGWINCH:
        return resized(term);
    default:
        return (struct gb_term_event){.kind = GB_TERM_TIMEOUT};
    }
}

/* A closed terminal returns 0 bytes at once for every read: polling would spin. */
static bool is_closed(const struct gb_term *term, short revents)
{
    int waiting = 0;
    if (revents & (POLLHUP | POLLERR | POLLNVAL)) {
        return true;
    }
    return (revents & POLLIN) && ioctl(term->in_fd, FIONREAD, &waiting) == 0 &&
           waiting == 0;
}

static void read_keys(struct gb_term *term)
{
    size_t size;
    char *room = gb_term_keys_room(&term->keys, &size);
    const ssize_t got = read(term->in_fd, room, size);
    gb_term_keys_add(&term->keys, got > 0 ? (size_t)got : 0, gb_clock_s());
}

struct gb_term_event gb_term_wait(struct gb_term *term, int timeout_ms)
{
    struct gb_term_event event = {.kind = GB_TERM_TIMEOUT};
    if (gb_term_keys_next(&term->keys, gb_clock_s(), &event)) {
        return event;
    }
    struct pollfd fds[] = {{term->signals.fd, POLLIN, 0}, {term->in_fd, POLLIN, 0}};
    const int wait_ms = gb_term_keys_wait_ms(&term->keys, gb_clock_s(), timeout_ms);
    const int ready = poll(fds, 2, wait_ms);
    if (ready > 0 && fds[0].revents != 0) {
        return from_signal(term);
    }
    if (ready > 0 && is_closed(term, fds[1].revents)) {
        return (struct gb_term_event){.kind = GB_TERM_HANGUP, .code = SIGHUP};
    }
    if (ready > 0) {
        read_keys(term);
    }
    gb_term_keys_next(&term->keys, gb_clock_s(), &event);
    return event;
}

void gb_term_set_theme(struct gb_term *term, int theme)
{
    term->profile.theme = theme;
    term->shaded = gb_term_style_init(term->style, term->profile.coloured,
                                      gb_term_theme_resolve(theme, getenv("COLORFGBG")));
}

int gb_term_present_theme(const struct gb_term *term)
{
    return term->profile.theme;
}

void gb_term_repaint(struct gb_term *term)
{
    term->repaints++;
    clearok(curscr, TRUE);
}

void gb_term_flush(struct gb_term *term)
{
    refresh();
    term->frames++;
}

void gb_term_size(const struct gb_term *term, int *rows, int *cols)
{
    (void)term;
    *rows = LINES;
    *cols = COLS;
}

bool gb_term_utf8(const struct gb_term *term)
{
    return term->profile.utf8;
}

bool gb_term_braille(const struct gb_term *term)
{
    return term->profile.braille;
}

bool gb_term_shaded(const struct gb_term *term)
{
    return term->shaded;
}

uint64_t gb_term_shade(const struct gb_term *term, int shade, int back)
{
    (void)term;
    return gb_term_style_shade(shade, back);
}

uint64_t gb_term_attributes(const struct gb_term *term, enum gb_style style)
{
    return term->style[style];
}

void gb_term_mouse(struct gb_term *term, bool on)
{
    const mmask_t wanted = BUTTON1_PRESSED | BUTTON4_PRESSED | BUTTON5_PRESSED;
    term->mouse = on && term->profile.can_mouse;
    mouseinterval(0); /* report presses at once, no click detection */
    mousemask(term->mouse ? wanted : 0, NULL);
}

bool gb_term_has_mouse(const struct gb_term *term)
{
    return term->mouse;
}

int gb_term_images(const struct gb_term *term)
{
    return term->profile.images;
}

void gb_term_cell(const struct gb_term *term, int *width, int *height)
{
    struct winsize size = {0};
    const bool reported = ioctl(term->out_fd, TIOCGWINSZ, &size) == 0 &&
                          size.ws_col > 0 && size.ws_row > 0 &&
                          size.ws_xpixel >= size.ws_col && size.ws_ypixel >= size.ws_row;
    *width = reported ? size.ws_xpixel / size.ws_col : DEFAULT_CELL_WIDTH;
    *height = reported ? size.ws_ypixel / size.ws_row : 2 * DEFAULT_CELL_WIDTH;
}

int64_t gb_term_repaints(const struct gb_term *term)
{
    return term->repaints;
}

void gb_term_send(struct gb_term *term, int row, int col, const char *text)
{
    fprintf(term->out, "\0337\033[%d;%dH%s\0338", row + 1, col + 1, text);
    fflush(term->out);
}

void gb_term_pass(struct gb_term *term, const char *sequence)
{
    fputs(sequence, term->out);
    fflush(term->out);
}

int gb_term_clipboard(const struct gb_term *term)
{
    return term->profile.clipboard;
}
