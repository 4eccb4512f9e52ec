#define _GNU_SOURCE /* memfd_create */

#include "tui/term/term.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <math.h>
#include <ncurses.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <term.h>
#include <termios.h>
#include <unistd.h>
#include <wchar.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "greenbody/status.h"
#include "tui/term/settings.h"
#include "tui/term/term_profile.h"

/* The terminal, with and without curses.  In this order: the log file and what happens
 * at a crash, the clipboard, signals as events, keys and mouse events from bytes,
 * colours and themes, and struct gb_term, which takes over the terminal and restores
 * it. */

/* The log file, and restoring the terminal after a crash. */

enum { TAIL_BYTES = 1024 };

void gb_term_tail_init(struct gb_stderr_tail *stderr_tail)
{
    stderr_tail->length = -1;
}

/* The last line of a text, without control characters. */
static bool last_line(char *text, char *line, size_t size)
{
    g_strchomp(text);
    const char *end = strrchr(text, '\n');
    g_strlcpy(line, end != NULL ? end + 1 : text, size);
    for (char *at = line; *at != '\0'; at++) {
        *at = *at == '\033' || g_ascii_iscntrl(*at) ? ' ' : *at;
    }
    return *line != '\0';
}

/* Opens the log if it is a regular file; opening a pipe without a partner would block
 * forever. */
static int open_file(const char *path, int flags)
{
    struct stat info;
    const int fd = open(path, flags | O_CLOEXEC | O_NONBLOCK, 0600);
    if (fd >= 0 && (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode))) {
        close(fd);
        errno = ENXIO; /* as for a pipe without a reader */
        return -1;
    }
    return fd;
}

/* Opens the log for reading; -1: error. */
static int term_tty_read_log(void)
{
    char *path = gb_term_log();
    const int fd = open_file(path, O_RDONLY);
    g_free(path);
    return fd;
}

bool gb_term_tail_poll(struct gb_stderr_tail *stderr_tail, char *line, size_t size)
{
    struct stat now;
    char text[TAIL_BYTES + 1];
    if (fstat(STDERR_FILENO, &now) != 0 || !S_ISREG(now.st_mode)) {
        return false;
    }
    const int64_t before = stderr_tail->length;
    stderr_tail->length = now.st_size;
    if (before < 0 || now.st_size <= before) {
        return false;
    }
    const int64_t from = MAX(before, now.st_size - TAIL_BYTES);
    const int log = term_tty_read_log();
    const ssize_t n = log < 0 ? -1 : pread(log, text, TAIL_BYTES, from);
    if (log >= 0) {
        close(log);
    }
    text[n > 0 ? n : 0] = '\0';
    return n > 0 && last_line(text, line, size);
}

static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

enum { FAULTS = sizeof faults / sizeof faults[0] };

/* Global, because a signal handler has no argument for its data. */
static struct {
    int screen, err;
    struct termios modes;
    char reset[256];
    size_t length;
    struct sigaction before[FAULTS];
    char state[4200],
        resume[4300]; /* path of the checkpoint, and the line that names it */
} installed;

static bool put(const char *text, size_t length)
{
    return write(installed.err, text, length) >= 0;
}

static void handle(int number)
{
    static const char text[] =
        "greenbody: the program has failed; the terminal was restored\n";
    if (write(installed.screen, installed.reset, installed.length) < 0) {
        _exit(128 + number);
    }
    tcsetattr(installed.screen, TCSANOW, &installed.modes);
    dup2(installed.err, STDERR_FILENO);
    if (!put(text, sizeof text - 1) ||
        (installed.state[0] != '\0' && access(installed.state, R_OK) == 0 &&
         !put(installed.resume, strlen(installed.resume)))) {
        _exit(128 + number);
    }
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &installed.before[i], NULL);
    }
    raise(number);
}

/* Restores the terminal when a fault ends the process.  On SIGSEGV, SIGBUS, SIGFPE,
 * SIGILL and SIGABRT it writes the reset sequence, restores the modes of the terminal
 * and standard error, and raises the signal with its previous action.
 * Async-signal-safe.
 *
 * screen  descriptor of the terminal
 * err     standard error before the screen was opened
 * modes   original modes of the terminal
 * reset   sequence that leaves the alternate screen and shows the cursor; copied */
static void term_tty_crash_install(int screen, int err, const struct termios *modes,
                                   const char *reset)
{
    installed.screen = screen;
    installed.err = err;
    installed.modes = *modes;
    snprintf(installed.reset, sizeof installed.reset, "%s", reset);
    installed.length = strlen(installed.reset);
    struct sigaction action = {.sa_handler = handle};
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &action, &installed.before[i]);
    }
}

static void term_tty_crash_remove(void)
{
    for (int i = 0; i < FAULTS; i++) {
        sigaction(faults[i], &installed.before[i], NULL);
    }
}

void gb_term_crash_set_run(const char *directory)
{
    installed.state[0] = '\0'; /* set again when the line is complete */
    if (directory == NULL) {
        return;
    }
    snprintf(installed.resume, sizeof installed.resume,
             "greenbody: continue from the last checkpoint with: greenbody resume '%s'\n",
             directory);
    snprintf(installed.state, sizeof installed.state, "%s/state.h5", directory);
}

char *gb_term_log(void)
{
    return g_build_filename(g_get_user_state_dir(), "greenbody", "workbench.log", NULL);
}

/* Opens the log; -1 with errno, ENXIO if it is not a file. */
static int open_log(void)
{
    char *path = gb_term_log();
    char *folder = g_path_get_dirname(path);
    g_mkdir_with_parents(folder, 0700);
    const int fd = open_file(path, O_WRONLY | O_CREAT | O_APPEND);
    g_free(path);
    g_free(folder);
    return fd;
}

bool gb_term_check_log(struct gb_error *err)
{
    const int log = open_log();
    const int why = errno;
    if (log >= 0) {
        close(log);
        return true;
    }
    char *path = gb_term_log();
    gb_error_set(
        err, GB_ERR_MACHINE, "nothing is logged: workbench.log: %s (%.300s)",
        why == ENXIO || why == EISDIR ? "is not a regular file" : g_strerror(why), path);
    g_free(path);
    return false;
}

/* Redirects standard output and error to a log file
 * ($XDG_STATE_HOME/greenbody/workbench.log, or /dev/null), because output of libraries
 * would corrupt the screen. */
static void term_tty_redirect(void)
{
    fflush(stdout);
    int log = open_log();
    log = log >= 0 ? log : open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (log >= 0) {
        dup2(log, STDOUT_FILENO);
        dup2(log, STDERR_FILENO);
        close(log);
    }
}

/* Restores the original descriptors from their duplicates. */
static void term_tty_restore(int out, int err)
{
    fflush(stdout);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
}

static bool can_position_cursor(const char *type, int fd)
{
    int found = 0;
    if (setupterm(type, fd, &found) != OK) {
        return false;
    }
    const bool positions = cursor_address != NULL;
    del_curterm(cur_term);
    return positions;
}

int gb_term_colours(const char *type, int fd)
{
    int found = 0;
    if (setupterm(type, fd, &found) != OK) {
        return 0;
    }
    const int colours = tigetnum("colors");
    del_curterm(cur_term);
    return colours > 0 ? colours : 0;
}

const char *gb_term_type(int fd, struct gb_error *err)
{
    const char *own = getenv("TERM");
    int found = 0;
    const bool known = own != NULL && *own != '\0' && setupterm(own, fd, &found) == OK;
    if (known) {
        del_curterm(cur_term);
    }
    static const char *const fallback[] = {"xterm-256color", "xterm", "vt100"};
    if (known && can_position_cursor(own, fd)) {
        return own;
    }
    for (size_t i = 0; !known && i < G_N_ELEMENTS(fallback); i++) {
        if (can_position_cursor(fallback[i], fd)) {
            return fallback[i];
        }
    }
    gb_error_set(err, GB_ERR_MACHINE,
                 "the terminal type TERM=%s %s; `greenbody run PRESET` needs no screen",
                 own == NULL ? "" : own,
                 known ? "cannot position the cursor" : "is unknown");
    return NULL;
}

/* The clipboard of the user's terminal, set by OSC 52.  The terminal decodes the
 * sequence, so text copied on a remote machine can be pasted on the local one.  Source:
 * xterm control sequences, "Manipulate Selection Data". */

/* Bytes of a sequence per string of GNU screen, below its limit of 768. */
enum { SCREEN_PART = 512 };

/* Adds DCS tmux; ...  ST with every Esc doubled. */
static void add_tmux(GString *to, const char *plain)
{
    g_string_append(to, "\033Ptmux;");
    for (const char *at = plain; *at != '\0'; at++) {
        g_string_append(to, *at == '\033' ? "\033\033" : (char[]){*at, '\0'});
    }
    g_string_append(to, "\033\\");
}

/* Adds DCS ...  ST, which screen passes on; the terminal sees the parts as one
 * sequence. */
static void add_screen(GString *to, const char *plain)
{
    const size_t length = strlen(plain);
    for (size_t at = 0; at < length; at += SCREEN_PART) {
        g_string_append_printf(to, "\033P%.*s\033\\", SCREEN_PART, plain + at);
    }
}

char *gb_term_clipboard_sequence(int clipboard, const char *text, struct gb_error *err)
{
    const size_t length = strlen(text);
    if (clipboard == GB_CLIPBOARD_OFF) {
        gb_error_set(err, GB_ERR_INPUT, "not copied: the setting clipboard is off");
        return NULL;
    }
    if (length == 0) {
        gb_error_set(err, GB_ERR_INPUT, "nothing to copy");
        return NULL;
    }
    if (length > GB_CLIPBOARD_MAX) {
        gb_error_set(err, GB_ERR_INPUT, "not copied: %zu bytes, terminals accept %d",
                     length, GB_CLIPBOARD_MAX);
        return NULL;
    }
    char *base64 = g_base64_encode((const unsigned char *)text, length);
    char *plain = g_strdup_printf("\033]52;c;%s\a", base64);
    GString *all = g_string_new(plain);
    if (clipboard == GB_CLIPBOARD_TMUX) {
        add_tmux(all, plain);
    } else if (clipboard == GB_CLIPBOARD_SCREEN) {
        add_screen(all, plain);
    }
    g_free(plain);
    g_free(base64);
    return g_string_free(all, FALSE);
}

/* Sets a buffer of tmux.  With default options tmux ignores both sequences of a
 * program, but not its own command, which needs tmux 3.2.  The text is in a file in
 * memory, so nothing blocks. */
static void load_buffer(const char *text)
{
    static const char *const words[] = {"tmux", "load-buffer", "-w", "-", NULL};
    const size_t length = strlen(text);
    const int fd = memfd_create("clipboard", MFD_CLOEXEC);
    if (fd < 0) {
        return;
    }
    if (write(fd, text, length) == (ssize_t)length && lseek(fd, 0, SEEK_SET) == 0) {
        g_spawn_async_with_fds(NULL, (char **)words, NULL, G_SPAWN_SEARCH_PATH, NULL,
                               NULL, NULL, fd, STDOUT_FILENO, STDERR_FILENO, NULL);
    }
    close(fd);
}

/* Signals as events that are read, instead of handlers. */
enum { GB_TERM_SIGNALS = 7 };

struct term_signals {
    int fd; /* of a signalfd, to be polled; -1: none */
    sigset_t mask_before;
    struct sigaction before[GB_TERM_SIGNALS], pipe_before;
};

struct gb_term {
    SCREEN *screen;
    FILE *out, *in;
    int out_fd, in_fd;
    struct gb_term_keys keys;
    struct term_signals signals;
    int saved_out, saved_err;
    int64_t frames;
    double since_s; /* clock at the start, s */
    int64_t repaints;
    bool shaded, mouse;
    struct gb_term_profile profile;
    struct termios modes;
    uint64_t style[GB_STYLE_COUNT];
};

/* Sends a sequence that moves no cursor and changes no cell; how copies are sent, one
 * of enum gb_settings_clipboard. */
static void term_pass(struct gb_term *term, const char *sequence)
{
    fputs(sequence, term->out);
    fflush(term->out);
}

static int term_clipboard(const struct gb_term *term)
{
    return term->profile.clipboard;
}

bool gb_term_clipboard_copy(struct gb_term *term, const char *text, struct gb_error *err)
{
    const int clipboard = term_clipboard(term);
    char *sequence = gb_term_clipboard_sequence(clipboard, text, err);
    if (sequence == NULL) {
        return false;
    }
    term_pass(term, sequence);
    g_free(sequence);
    if (clipboard == GB_CLIPBOARD_TMUX && getenv("TMUX") != NULL) {
        load_buffer(text);
    }
    return true;
}

/* Keys, text and mouse events from the bytes of a terminal, with the sequences of
 * terminfo. curses' own input is not used, because it measures the wait for the rest of
 * a sequence by the time of day and hangs if the clock is set back. */

enum { ESCAPE = 27, DELETE = 127 };

/* Meaning of the first bytes.  Length 0: the beginning of something longer. */
struct token {
    size_t length;
    struct gb_term_event event; /* GB_TERM_TIMEOUT: ignored */
};

static const struct token unfinished = {.length = 0};

char *gb_term_keys_room(struct gb_term_keys *keys, size_t *size)
{
    *size = sizeof keys->bytes - keys->count;
    return keys->bytes + keys->count;
}

void gb_term_keys_add(struct gb_term_keys *keys, size_t count, double now_s)
{
    keys->count += count;
    keys->since_s = now_s;
}

static struct token ignored(size_t length)
{
    return (struct token){.length = length, .event = {.kind = GB_TERM_TIMEOUT}};
}

/* Button and modifiers in xterm's encoding: left button and wheel. */
static struct token mouse_token(size_t length, int button, int col, int row)
{
    enum { MODIFIERS = 4 | 8 | 16, LEFT = 0, WHEEL_UP = 64, WHEEL_DOWN = 65 };
    struct token token = ignored(length);
    token.event.row = row - 1;
    token.event.col = col - 1;
    token.event.kind = GB_TERM_MOUSE;
    switch (button & ~MODIFIERS) {
    case LEFT:
        token.event.code = GB_TERM_CLICK;
        break;
    case WHEEL_UP:
        token.event.code = GB_TERM_WHEEL_UP;
        break;
    case WHEEL_DOWN:
        token.event.code = GB_TERM_WHEEL_DOWN;
        break;
    default:
        token.event.kind = GB_TERM_TIMEOUT;
    }
    return token;
}

/* Esc [ M followed by three bytes. */
static struct token old_mouse(const char *bytes, size_t count)
{
    enum { LENGTH = 6, OFFSET = 32 };
    const unsigned char *at = (const unsigned char *)bytes;
    return count < LENGTH
               ? unfinished
               : mouse_token(LENGTH, at[3] - OFFSET, at[4] - OFFSET, at[5] - OFFSET);
}

/* Length of a control sequence, Esc [ parameters letter; 0: incomplete. */
static size_t control_length(const char *bytes, size_t count)
{
    for (size_t i = 2; i < count; i++) {
        if (bytes[i] < ' ' || bytes[i] > '?') {
            return bytes[i] == ESCAPE ? i : i + 1;
        }
    }
    return 0;
}

/* A control sequence that terminfo lacks.  With parameters it is an unknown key and is
 * ignored; without, it is Esc followed by text. */
static struct token control_token(const char *bytes, size_t count)
{
    const size_t length = control_length(bytes, count);
    int button, col, row;
    char end;
    if (length == 0) {
        return unfinished;
    }
    char text[32] = "";
    memcpy(text, bytes, length < sizeof text ? length : sizeof text - 1);
    if (sscanf(text, "\033[<%d;%d;%d%c", &button, &col, &row, &end) == 4) {
        return end == 'M' ? mouse_token(length, button, col, row) : ignored(length);
    }
    return ignored(length);
}

static struct token key_token(size_t length, int code)
{
    const enum gb_term_event_kind kind =
        code == KEY_RESIZE ? GB_TERM_RESIZED : GB_TERM_KEY;
    return (struct token){.length = length, .event = {.kind = kind, .code = code}};
}

/* One character of the locale.  A byte that does not belong to one is ignored. */
static struct token character(const char *bytes, size_t count)
{
    const unsigned char first = (unsigned char)bytes[0];
    if (first < ' ' || first == DELETE) {
        return key_token(1, first);
    }
    mbstate_t state = {0};
    wchar_t code = 0;
    const size_t length = mbrtowc(&code, bytes, count, &state);
    if (length == (size_t)-2) {
        return unfinished;
    }
    if (length == (size_t)-1) {
        return ignored(1);
    }
    return (struct token){.length = length,
                          .event = {.kind = GB_TERM_TEXT, .code = (int32_t)code}};
}

/* Finds a key of terminfo.  Length 0 with code ERR: the beginning of a key; length 0
 * with code 0: not a key. */
static size_t defined_key(const char *bytes, size_t count, int *code)
{
    char sequence[GB_TERM_KEYS_BYTES + 1] = "";
    *code = 0;
    for (size_t n = 1; n <= count && bytes[n - 1] != '\0'; n++) {
        sequence[n - 1] = bytes[n - 1];
        *code = key_defined(sequence);
        if (*code != ERR) {
            return *code > 0 ? n : 0;
        }
    }
    return 0;
}

static bool begins(const char *bytes, size_t count, const char *with)
{
    return count >= strlen(with) && memcmp(bytes, with, strlen(with)) == 0;
}

static struct token understand(const char *bytes, size_t count)
{
    int code;
    const size_t length = defined_key(bytes, count, &code);
    if (begins(bytes, count, "\033[M") && code == KEY_MOUSE) {
        return old_mouse(bytes, count);
    }
    if (length > 0 && code != KEY_MOUSE) {
        return key_token(length, code);
    }
    if (count > 2 && begins(bytes, count, "\033[") && bytes[2] >= '0' &&
        bytes[2] <= '?') {
        return control_token(bytes, count);
    }
    return code == ERR ? unfinished : character(bytes, count);
}

static void take(struct gb_term_keys *keys, size_t length)
{
    keys->count -= length;
    memmove(keys->bytes, keys->bytes + length, keys->count);
}

static bool rest_is_late(const struct gb_term_keys *keys, double now_s)
{
    return keys->count == sizeof keys->bytes ||
           now_s - keys->since_s >= GB_TERM_KEYS_REST_S;
}

bool gb_term_keys_next(struct gb_term_keys *keys, double now_s,
                       struct gb_term_event *event)
{
    while (keys->count > 0) {
        struct token token = understand(keys->bytes, keys->count);
        if (token.length == 0 && !rest_is_late(keys, now_s)) {
            return false;
        }
        if (token.length == 0) { /* the first byte alone */
            token = character(keys->bytes, 1);
        }
        take(keys, token.length > 0 ? token.length : 1);
        if (token.length > 0 && token.event.kind != GB_TERM_TIMEOUT) {
            *event = token.event;
            return true;
        }
    }
    return false;
}

int gb_term_keys_wait_ms(const struct gb_term_keys *keys, double now_s, int timeout_ms)
{
    if (keys->count == 0) {
        return timeout_ms;
    }
    const double left_s = keys->since_s + GB_TERM_KEYS_REST_S - now_s;
    const int left_ms = (int)ceil(1e3 * fmax(left_s, 0.0));
    return timeout_ms < 0 || left_ms < timeout_ms ? left_ms : timeout_ms;
}

static const int handled[GB_TERM_SIGNALS] = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,
                                             SIGTSTP, SIGCONT, SIGWINCH};

/* Blocks SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGCONT and SIGWINCH in this thread
 * and in threads that it starts; ignores SIGPIPE. */
static void term_signals_catch(struct term_signals *signals)
{
    sigset_t mask;
    sigemptyset(&mask);
    for (int i = 0; i < GB_TERM_SIGNALS; i++) {
        sigaction(handled[i], NULL, &signals->before[i]);
        sigaddset(&mask, handled[i]);
    }
    const struct sigaction ignore = {.sa_handler = SIG_IGN};
    sigaction(SIGPIPE, &ignore, &signals->pipe_before);
    pthread_sigmask(SIG_BLOCK, &mask, &signals->mask_before);
    signals->fd = signalfd(-1, &mask, SFD_CLOEXEC | SFD_NONBLOCK);
}

/* Leaves the signals blocked permanently. */
static void term_signals_give_up(struct term_signals *signals)
{
    close(signals->fd);
    signals->fd = -1;
}

/* The next signal; 0: none. */
static int term_signals_read(const struct term_signals *signals)
{
    struct signalfd_siginfo info;
    const bool whole = read(signals->fd, &info, sizeof info) == (ssize_t)sizeof info;
    return whole ? (int)info.ssi_signo : 0;
}

/* Restores the previous signal mask.  Pending signals are discarded, because they
 * requested the end that has come.  No effect after giving up. */
static void term_signals_release(struct term_signals *signals)
{
    if (signals->fd < 0) {
        return;
    }
    while (term_signals_read(signals) != 0) {
    }
    for (int i = 0; i < GB_TERM_SIGNALS; i++) {
        sigaction(handled[i], &signals->before[i], NULL);
    }
    sigaction(SIGPIPE, &signals->pipe_before, NULL);
    term_signals_give_up(signals);
    pthread_sigmask(SIG_SETMASK, &signals->mask_before, NULL);
}

/* Stops the process; returns after SIGCONT. */
static void term_signals_stop(void)
{
    sigset_t stop;
    sigemptyset(&stop);
    sigaddset(&stop, SIGTSTP);
    const struct sigaction plain = {.sa_handler = SIG_DFL};
    sigaction(SIGTSTP, &plain, NULL);
    pthread_sigmask(SIG_UNBLOCK, &stop, NULL);
    raise(SIGTSTP);
    pthread_sigmask(SIG_BLOCK, &stop, NULL);
}

/* Colours of a theme, as numbers in the 256 and in the 16 colours of terminals.  The
 * latter are taken modulo 8 on terminals with eight colours. -1: the terminal's own
 * colour. */

enum { WHITE_16 = 15, WHITE_256 = 231, BLACK_256 = 16, LIGHT_GREY_16 = 7 };

/* Series: sky blue, orange, green, pink, red, blue: the hues of Okabe and Ito. */
#define PLAIN_16                                                                         \
    {                                                                                    \
        6, 3, 2, 5, 1, 4                                                                 \
    }
#define BRIGHT_16                                                                        \
    {                                                                                    \
        14, 11, 10, 13, 9, 12                                                            \
    }

static const struct gb_term_theme themes[] = {
    [GB_THEME_AUTO] = {{39, 208, 108, 139, 160, 25}, PLAIN_16, 244, 8, -1, -1, -1, -1},
    [GB_THEME_LIGHT] = {{32, 136, 65, 139, 124, 24}, PLAIN_16, 240, 8, -1, -1, -1, -1},
    [GB_THEME_DARK] =
        {{45, 221, 151, 169, 196, 33}, BRIGHT_16, 247, LIGHT_GREY_16, -1, -1, -1, -1},
    [GB_THEME_CONTRAST] = {{81, 214, 35, 211, 223, 111},
                           BRIGHT_16,
                           WHITE_256,
                           WHITE_16,
                           WHITE_256,
                           WHITE_16,
                           BLACK_256,
                           0},
};

const struct gb_term_theme *gb_term_theme_row(int theme)
{
    return &themes[theme];
}

int gb_term_theme_resolve(int theme, const char *colorfgbg)
{
    const char *background = colorfgbg != NULL ? strrchr(colorfgbg, ';') : NULL;
    char *end = NULL;
    const long colour = background != NULL ? strtol(background + 1, &end, 10) : -1;
    if (theme != GB_THEME_AUTO || background == NULL || end == background + 1 ||
        *end != '\0' || colour < 0 || colour > WHITE_16) {
        return theme;
    }
    return colour == LIGHT_GREY_16 || colour > LIGHT_GREY_16 + 1 ? GB_THEME_LIGHT
                                                                 : GB_THEME_DARK;
}

/* Numbers of colour pairs; those of the shades come last. */
enum {
    SERIES = GB_TERM_THEME_SERIES,
    GREY_PAIR = SERIES + 1,
    TEXT_PAIR,
    SHADE_PAIRS,
    PAIRS = SHADE_PAIRS + GB_TERM_SHADES * (GB_TERM_SHADES + 1)
};

static void set_plain(uint64_t *style)
{
    style[GB_STYLE_PLAIN] = A_NORMAL;
    style[GB_STYLE_DIM] = A_DIM;
    style[GB_STYLE_BOLD] = A_BOLD;
    style[GB_STYLE_TITLE] = A_NORMAL;
    style[GB_STYLE_FOCUS] = A_REVERSE | A_BOLD;
    style[GB_STYLE_SELECTED] = A_REVERSE;
    style[GB_STYLE_EDIT] = A_UNDERLINE | A_BOLD;
    style[GB_STYLE_CHANGED] = A_BOLD;
    style[GB_STYLE_GOOD] = A_NORMAL;
    style[GB_STYLE_WARN] = A_BOLD;
    style[GB_STYLE_BAD] = A_BOLD;
    for (int i = 0; i < SERIES; i++) {
        style[GB_STYLE_SERIES + i] = A_NORMAL;
    }
}

/* The colour that this terminal supports. */
static short of_terminal(short colour_256, short colour_16)
{
    return COLORS >= 256                   ? colour_256
           : COLORS >= 16 || colour_16 < 0 ? colour_16
                                           : (short)(colour_16 % 8);
}

static short background_of(const struct gb_term_theme *theme)
{
    return of_terminal(theme->background, theme->background_16);
}

/* Gives text without a colour pair of its own the background of the theme. */
static void paint_background(const struct gb_term_theme *theme)
{
    init_pair(TEXT_PAIR, of_terminal(theme->text, theme->text_16), background_of(theme));
    bkgdset(theme->background < 0 ? ' ' : (chtype)' ' | (chtype)COLOR_PAIR(TEXT_PAIR));
}

static void set_colours(uint64_t *style, const struct gb_term_theme *theme)
{
    const short back = background_of(theme);
    uint64_t pair[SERIES];
    for (short i = 0; i < SERIES; i++) {
        init_pair((short)(i + 1), of_terminal(theme->series[i], theme->series_16[i]),
                  back);
        pair[i] = (uint64_t)COLOR_PAIR(i + 1);
        style[GB_STYLE_SERIES + i] = pair[i];
    }
    if (COLORS >= 16) {
        init_pair(GREY_PAIR, of_terminal(theme->grey, theme->grey_16), back);
        style[GB_STYLE_DIM] = (uint64_t)COLOR_PAIR(GREY_PAIR);
    }
    style[GB_STYLE_CHANGED] = pair[1] | A_BOLD;
    style[GB_STYLE_GOOD] = pair[2];
    style[GB_STYLE_WARN] = pair[1] | A_BOLD;
    style[GB_STYLE_BAD] = pair[4] | A_BOLD;
    style[GB_STYLE_FOCUS] = pair[0] | A_REVERSE | A_BOLD;
}

/* One hue from dark to light, so that depth is visible with any colour vision. */
static const short shades_256[GB_TERM_SHADES] = {17, 23, 24, 31, 38, 74, 117, 195};

static short shade_pair(int shade, int back)
{
    return (short)(SHADE_PAIRS + shade * (GB_TERM_SHADES + 1) + back + 1);
}

static bool set_shades(short background)
{
    if (COLORS < 256 || COLOR_PAIRS < PAIRS) {
        return false;
    }
    for (int shade = 0; shade < GB_TERM_SHADES; shade++) {
        for (int back = -1; back < GB_TERM_SHADES; back++) {
            init_pair(shade_pair(shade, back), shades_256[shade],
                      back < 0 ? background : shades_256[back]);
        }
    }
    return true;
}

/* Attributes of a shade on a background of another shade; -1: background of the theme. */
static uint64_t term_style_shade(int shade, int back)
{
    return (uint64_t)COLOR_PAIR(shade_pair(shade, back));
}

/* Sets the curses attributes of every enum gb_style for the present terminal: 256, 16,
 * 8 or no colours, none unless `coloured`.  Colours and the background of all cells
 * come from the theme.  True: shades are available. */
static bool term_style_init(uint64_t *style, bool coloured, int theme)
{
    const struct gb_term_theme *row = gb_term_theme_row(theme);
    set_plain(style);
    if (!coloured || !has_colors() || start_color() != OK || use_default_colors() != OK) {
        return false;
    }
    paint_background(row);
    set_colours(style, row);
    return set_shades(background_of(row));
}

/* Width of a cell in pixels if the terminal does not report it. */
enum { DEFAULT_CELL_WIDTH = 10 };

static void set_modes(void)
{
    cbreak();
    noecho();
    nonl();
    curs_set(0);
    keypad(stdscr, TRUE); /* arrows and keypad send the sequences of terminfo */
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
    term_tty_crash_install(term->out_fd, term->saved_err, &term->modes, reset);
}

static int duplicate(int fd)
{
    return fcntl(fd, F_DUPFD_CLOEXEC, 3);
}

/* Opens input and output.  Keys come from standard input, or from /dev/tty if that is a
 * pipe. */
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
    term_signals_catch(&term->signals);
    if (!start_screen(term, term->profile.type, err)) {
        term_signals_release(&term->signals);
        goto fail;
    }
    term_tty_redirect();
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
    term_tty_crash_remove();
    endwin();
    delscreen(term->screen);
    fprintf(stderr, "greenbody: frames drawn: %lld in %.1f s\n", /* into the log */
            (long long)term->frames, gb_clock_s() - term->since_s);
    term_tty_restore(term->saved_out, term->saved_err);
    close_streams(term);
}

void gb_term_abandon(struct gb_term *term)
{
    term_tty_crash_remove();
    term_signals_give_up(&term->signals);
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
        term_signals_release(&term->signals);
    }
    gb_alloc_free(term);
}

/* Stops the process as Ctrl-Z does, and takes over the terminal again when it
 * continues. */
static void term_suspend(struct gb_term *term)
{
    endwin();
    term_tty_restore(term->saved_out, term->saved_err);
    term_signals_stop();
    term_tty_redirect();
    set_modes();
}

/* Handles a new size, which is read from the kernel here and not in a signal handler. */
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
    const int signal = term_signals_read(&term->signals);
    switch (signal) {
    case SIGINT:
        return (struct gb_term_event){.kind = GB_TERM_INTERRUPT, .code = SIGINT};
    case SIGTERM:
    case SIGQUIT:
        return (struct gb_term_event){.kind = GB_TERM_TERMINATE, .code = signal};
    case SIGHUP:
        return (struct gb_term_event){.kind = GB_TERM_HANGUP, .code = SIGHUP};
    case SIGTSTP:
        term_suspend(term);
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

/* Is the terminal closed?  Every read then returns 0 bytes at once, so polling would
 * spin. */
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
    term->shaded = term_style_init(term->style, term->profile.coloured,
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
    return term_style_shade(shade, back);
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
