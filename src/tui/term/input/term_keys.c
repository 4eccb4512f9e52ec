#include "tui/term/input/term_keys.h"

#include <math.h>
#include <ncurses.h>
#include <stdio.h>
#include <string.h>
#include <wchar.h>

enum { ESCAPE = 27, DELETE = 127 };

/* What the first bytes are.  Length 0: the beginning of something longer. */
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

/* Button and modifiers as xterm encodes them: left button and wheel. */
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

/* Esc [ M and three bytes. */
static struct token old_mouse(const char *bytes, size_t count)
{
    enum { LENGTH = 6, OFFSET = 32 };
    const unsigned char *at = (const unsigned char *)bytes;
    return count < LENGTH
               ? unfinished
               : mouse_token(LENGTH, at[3] - OFFSET, at[4] - OFFSET, at[5] - OFFSET);
}

/* Length of a control sequence, Esc [ parameters letter; 0: its end is not there. */
static size_t control_length(const char *bytes, size_t count)
{
    for (size_t i = 2; i < count; i++) {
        if (bytes[i] < ' ' || bytes[i] > '?') {
            return bytes[i] == ESCAPE ? i : i + 1;
        }
    }
    return 0;
}

/* One that terminfo does not have.  With parameters it is a key that means nothing here;
 * without, Esc and text. */
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

/* One character of the locale; a byte that belongs to none is ignored. */
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

/* A key of terminfo; length 0 with code ERR: the beginning of one; with 0: none. */
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
        if (token.length == 0) { /* the first byte for itself */
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
