#include "tui/term/term_profile.h"

#include <glib.h>
#include <langinfo.h>
#include <locale.h>
#include <ncurses.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <term.h>
#include <unistd.h>

#include "base/visible.h"
#include "tui/term/pixels.h"
#include "tui/term/term.h"

static const char *from_env(const char *name)
{
    const char *value = getenv(name);
    return value != NULL ? value : "";
}

static bool in_multiplexer(const char *type)
{
    return *from_env("TMUX") != '\0' || *from_env("STY") != '\0' ||
           g_str_has_prefix(type, "screen") || g_str_has_prefix(type, "tmux");
}

/* Many terminals with 256 colours are named xterm, whose entry has eight.  Prefers an
 * entry with more colours if there is one. */
static void prefer_colours(struct gb_term_profile *profile, int fd)
{
    const char *colorterm = from_env("COLORTERM");
    const bool rich =
        strcmp(colorterm, "truecolor") == 0 || strcmp(colorterm, "24bit") == 0;
    if (!rich || profile->colours >= 256 || profile->inside ||
        strcmp(profile->type, "linux") == 0) {
        return;
    }
    char name[sizeof profile->better];
    g_snprintf(name, sizeof name, "%s-256color", profile->type);
    const int colours = gb_term_colours(name, fd);
    if (colours >= 256) {
        g_strlcpy(profile->better, name, sizeof profile->better);
        profile->type = profile->better;
        profile->colours = colours;
    }
}

static bool reports_mouse(const char *type, int fd)
{
    int found = 0;
    if (setupterm(type, fd, &found) != OK) {
        return false;
    }
    const char *mouse = tigetstr("kmous");
    const bool has = mouse != NULL && mouse != (char *)-1;
    del_curterm(cur_term);
    return has;
}

static bool colour_wanted(const struct gb_settings *settings)
{
    return settings->colour == GB_COLOUR_ALWAYS ||
           (settings->colour == GB_COLOUR_AUTO && *from_env("NO_COLOR") == '\0');
}

static int detect_images(const struct gb_term_profile *profile,
                         const struct gb_settings *settings)
{
    if (!gb_pixels_available() || settings->images == GB_IMAGES_NONE) {
        return GB_IMAGES_NONE;
    }
    if (settings->images != GB_IMAGES_AUTO) {
        return settings->images;
    }
    /* an image has about 100 times the bytes of a frame, so over ssh only on request */
    const bool far = *from_env("SSH_CONNECTION") != '\0';
    return profile->inside || far || !profile->coloured ? GB_IMAGES_NONE
                                                        : gb_pixels_detect();
}

/* A terminal named screen without $TMUX is treated as screen: tmux ignores its
 * sequence, whereas screen would display the sequence of tmux. */
static int detect_clipboard(const char *type, const struct gb_settings *settings)
{
    if (settings->clipboard != GB_CLIPBOARD_AUTO) {
        return settings->clipboard;
    }
    if (*from_env("TMUX") != '\0' || g_str_has_prefix(type, "tmux")) {
        return GB_CLIPBOARD_TMUX;
    }
    return in_multiplexer(type) ? GB_CLIPBOARD_SCREEN : GB_CLIPBOARD_OSC52;
}

bool gb_term_profile_detect(struct gb_term_profile *profile, int fd,
                            const struct gb_settings *settings, struct gb_error *err)
{
    setlocale(LC_ALL, "");
    setlocale(LC_NUMERIC, "C"); /* decimal point in every locale */
    *profile =
        (struct gb_term_profile){.own = from_env("TERM"), .images = GB_IMAGES_NONE};
    const bool ascii = settings->ascii != 0;
    profile->utf8 = !ascii && strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    profile->type = gb_term_type(fd, err);
    if (profile->type == NULL) {
        return false;
    }
    profile->inside = in_multiplexer(profile->own);
    profile->colours = gb_term_colours(profile->type, fd);
    prefer_colours(profile, fd);
    profile->coloured = profile->colours >= 8 && colour_wanted(settings);
    profile->braille = profile->utf8 && strcmp(profile->type, "linux") != 0;
    profile->can_mouse = reports_mouse(profile->type, fd);
    profile->images = detect_images(profile, settings);
    profile->theme = settings->theme;
    profile->clipboard = detect_clipboard(profile->own, settings);
    return true;
}

static const char *yes_no(bool value)
{
    return value ? "yes" : "no";
}

static void print_size(FILE *out, int fd)
{
    struct winsize size = {0};
    if (!isatty(fd) || ioctl(fd, TIOCGWINSZ, &size) != 0) {
        gb_visible_print(out, "size       standard output is no terminal\n");
        return;
    }
    gb_visible_print(out, "size       %d x %d characters", size.ws_col, size.ws_row);
    if (size.ws_xpixel > 0) {
        gb_visible_print(out, ", %d x %d pixels", size.ws_xpixel, size.ws_ypixel);
    }
    gb_visible_print(out, "; 80 x 24 shows everything, 40 x 12 is the least\n");
}

static void print_terminal(FILE *out, const struct gb_term_profile *profile,
                           const struct gb_settings *settings)
{
    static const char *const graphs[] = {"", "braille", "block", "ascii"};
    const char *graph = settings->graph != GB_GRAPH_AUTO ? graphs[settings->graph]
                        : profile->braille               ? "braille"
                        : profile->utf8                  ? "block"
                                                         : "ascii";
    gb_visible_print(out, "terminal   TERM=%s, taken as %s%s\n", profile->own,
                     profile->type, profile->inside ? ", inside of tmux or screen" : "");
    gb_visible_print(
        out, "colours    %d of terminfo, COLORTERM=%s, NO_COLOR=%s, --color=%s: %s\n",
        profile->colours, from_env("COLORTERM"), from_env("NO_COLOR"),
        gb_settings_word(settings, "color"),
        !profile->coloured        ? "none are used"
        : profile->colours >= 256 ? "256 are used"
        : profile->colours >= 16  ? "16 are used"
                                  : "8 are used");
    static const char *const backgrounds[] = {"a light and a dark background",
                                              "a light background", "a dark background",
                                              "high contrast, white on black"};
    gb_visible_print(
        out, "theme      for %s (COLORFGBG=%s, --theme=%s)\n",
        backgrounds[gb_term_theme_resolve(profile->theme, getenv("COLORFGBG"))],
        from_env("COLORFGBG"), gb_settings_word(settings, "theme"));
    gb_visible_print(out, "plots      %s\n", graph);
    gb_visible_print(out, "mouse      %s, terminfo knows it: %s\n",
                     gb_settings_word(settings, "mouse"), yes_no(profile->can_mouse));
    gb_visible_print(out, "images     %s (libchafa: %s, --images=%s)\n",
                     profile->images == GB_IMAGES_SIXEL ? "sixel"
                     : profile->images == GB_IMAGES_KITTY
                         ? "kitty"
                         : "none, the packing is drawn in cells",
                     yes_no(gb_pixels_available()), gb_settings_word(settings, "images"));
    static const char *const clipboards[] = {"", "OSC 52", "OSC 52 and tmux",
                                             "OSC 52 through screen", "none"};
    gb_visible_print(out, "clipboard  %s (--clipboard=%s)\n",
                     clipboards[profile->clipboard],
                     gb_settings_word(settings, "clipboard"));
    gb_visible_print(out, "frames     at most %d a second\n", settings->slow ? 2 : 10);
}

void gb_term_profile_print(FILE *out, int fd, const struct gb_settings *settings)
{
    struct gb_term_profile profile;
    struct gb_error err = {0};
    const bool works = gb_term_profile_detect(&profile, fd, settings, &err);
    char *path = gb_settings_path();
    char *log = gb_term_log();
    gb_visible_print(out, "locale     %s, %s: UTF-8 %s%s\n", setlocale(LC_CTYPE, NULL),
                     nl_langinfo(CODESET), profile.utf8 ? "is used" : "is not used",
                     settings->ascii ? " (--ascii)" : "");
    print_size(out, fd);
    if (works) {
        print_terminal(out, &profile, settings);
    } else {
        gb_visible_print(out, "terminal   none: %s\n", err.text);
    }
    gb_visible_print(out, "settings   %s%s\n", path,
                     g_file_test(path, G_FILE_TEST_EXISTS) ? "" : " (not there)");
    if (gb_term_check_log(&err)) {
        gb_visible_print(out, "log        %s\n", log);
    } else {
        gb_visible_print(out, "log        %s\n", err.text);
    }
    g_free(log);
    g_free(path);
}
