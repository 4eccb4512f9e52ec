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
#include <sys/signalfd.h>
#include <term.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "tui/term/crash.h"
#include "tui/term/term_profile.h"
#include "tui/term/term_style.h"
#include "tui/term/term_theme.h"
#include "tui/term/term_tty.h"

/* Longest time between Esc and the rest of a function key, ms. */
enum { ESCAPE_MS = 40 };

/* Width of a cell in pixels where the terminal does not report it. */
enum { DEFAULT_CELL_WIDTH = 10 };

static const int handled_signals[] = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,
                                      SIGTSTP, SIGCONT, SIGWINCH};

enum { HANDLED_SIGNALS = sizeof handled_signals / sizeof handled_signals[0] };

struct gb_term {
    SCREEN *screen;
    WINDOW *keys; /* a pad: reading from it does not refresh the screen */
    FILE *out, *in;
    int out_fd, in_fd, signal_fd;
    int saved_out, saved_err;
    int64_t frames;
    double since_s; /* clock at the start, s */
    int64_t repaints;
    bool shaded, mouse;
    struct gb_term_profile profile;
    struct termios modes;
    sigset_t mask_before;
    struct sigaction before[HANDLED_SIGNALS], pipe_before;
    uint64_t style[GB_STYLE_COUNT];
};

static void set_modes(void)
{
    cbreak();
    noecho();
    nonl();
    curs_set(0);
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
    set_escdelay(ESCAPE_MS);
    gb_term_set_theme(term, term->profile.theme);
    term->keys = newpad(1, 1);
    keypad(term->keys, TRUE);
    nodelay(term->keys, TRUE);
    return true;
}

static void catch_signals(struct gb_term *term)
{
    sigset_t mask;
    sigemptyset(&mask);
    for (int i = 0; i < HANDLED_SIGNALS; i++) {
        sigaction(handled_signals[i], NULL, &term->before[i]);
        sigaddset(&mask, handled_signals[i]);
    }
    const struct sigaction ignore = {.sa_handler = SIG_IGN};
    sigaction(SIGPIPE, &ignore, &term->pipe_before);
    pthread_sigmask(SIG_BLOCK, &mask, &term->mask_before);
    term->signal_fd = signalfd(-1, &mask, SFD_CLOEXEC | SFD_NONBLOCK);
}

/* Pending signals requested the end that has come, and are discarded. */
static void release_signals(struct gb_term *term)
{
    struct signalfd_siginfo late;
    while (read(term->signal_fd, &late, sizeof late) == (ssize_t)sizeof late) {
    }
    for (int i = 0; i < HANDLED_SIGNALS; i++) {
        sigaction(handled_signals[i], &term->before[i], NULL);
    }
    sigaction(SIGPIPE, &term->pipe_before, NULL);
    close(term->signal_fd);
    pthread_sigmask(SIG_SETMASK, &term->mask_before, NULL);
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
    catch_signals(term);
    if (!start_screen(term, term->profile.type, err)) {
        release_signals(term);
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
    delwin(term->keys);
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
    close(term->signal_fd);
    term->signal_fd = -1;
    close_streams(term);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (nothing >= 0) {
        dup2(nothing, STDIN_FILENO);
        close(nothing);
    }
}

void gb_term_destroy(struct gb_term *term)
{
    if (term != NULL && term->signal_fd >= 0) {
        release_signals(term);
    }
    gb_alloc_free(term);
}

void gb_term_suspend(struct gb_term *term)
{
    endwin();
    gb_term_tty_restore(term->saved_out, term->saved_err);
    sigset_t stop;
    sigemptyset(&stop);
    sigaddset(&stop, SIGTSTP);
    const struct sigaction plain = {.sa_handler = SIG_DFL};
    sigaction(SIGTSTP, &plain, NULL);
    pthread_sigmask(SIG_UNBLOCK, &stop, NULL);
    raise(SIGTSTP); /* returns after SIGCONT */
    pthread_sigmask(SIG_BLOCK, &stop, NULL);
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
    struct signalfd_siginfo info;
    const struct gb_term_event nothing = {.kind = GB_TERM_TIMEOUT};
    if (read(term->signal_fd, &info, sizeof info) != (ssize_t)sizeof info) {
        return nothing;
    }
    switch (info.ssi_signo) {
    case SIGINT:
        return (struct gb_term_event){.kind = GB_TERM_INTERRUPT, .code = SIGINT};
    case SIGTERM:
    case SIGQUIT:
        return (struct gb_term_event){.kind = GB_TERM_TERMINATE,
                                      .code = (int32_t)info.ssi_signo};
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
        return nothing;
    }
}

/* Left button and wheel; other mouse events are ignored. */
static struct gb_term_event from_mouse(void)
{
    struct gb_term_event event = {.kind = GB_TERM_TIMEOUT};
    MEVENT mouse;
    if (getmouse(&mouse) != OK) {
        return event;
    }
    event.row = mouse.y;
    event.col = mouse.x;
    event.kind = GB_TERM_MOUSE;
    if (mouse.bstate & BUTTON1_PRESSED) {
        event.code = GB_TERM_CLICK;
    } else if (mouse.bstate & BUTTON4_PRESSED) {
        event.code = GB_TERM_WHEEL_UP;
    } else if (mouse.bstate & BUTTON5_PRESSED) {
        event.code = GB_TERM_WHEEL_DOWN;
    } else {
        event.kind = GB_TERM_TIMEOUT;
    }
    return event;
}

static bool next_key(struct gb_term *term, struct gb_term_event *event)
{
    wint_t code = 0;
    const int how = wget_wch(term->keys, &code);
    if (how == ERR) {
        return false;
    }
    if (how == KEY_CODE_YES && code == KEY_MOUSE) {
        *event = from_mouse();
        return true;
    }
    if (how == KEY_CODE_YES) {
        event->kind = code == KEY_RESIZE ? GB_TERM_RESIZED : GB_TERM_KEY;
    } else {
        event->kind = code < 32 || code == 127 ? GB_TERM_KEY : GB_TERM_TEXT;
    }
    event->code = (int32_t)code;
    return true;
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

struct gb_term_event gb_term_wait(struct gb_term *term, int timeout_ms)
{
    struct gb_term_event event = {.kind = GB_TERM_TIMEOUT};
    if (next_key(term, &event)) {
        return event;
    }
    struct pollfd fds[] = {{term->signal_fd, POLLIN, 0}, {term->in_fd, POLLIN, 0}};
    if (poll(fds, 2, timeout_ms) <= 0) {
        return event;
    }
    if (fds[0].revents != 0) {
        return from_signal(term);
    }
    if (is_closed(term, fds[1].revents)) {
        return (struct gb_term_event){.kind = GB_TERM_HANGUP, .code = SIGHUP};
    }
    next_key(term, &event);
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
