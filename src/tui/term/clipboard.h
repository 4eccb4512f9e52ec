#ifndef GB_TUI_TERM_CLIPBOARD_H
#define GB_TUI_TERM_CLIPBOARD_H

#include <stdbool.h>

#include "greenbody/status.h"
#include "tui/term/term.h"

/* The clipboard of the user's terminal, set by OSC 52: the terminal decodes the sequence,
 * so that a text copied on a remote machine is pasted on the local one.  Source: xterm
 * control sequences, "Manipulate Selection Data". */

/* Longest text, bytes: its Base64 form and header are the 100,000 bytes that terminals
 * with a limit accept. */
enum { GB_CLIPBOARD_MAX = 74994 };

/* The sequence by one of enum gb_settings_clipboard: OSC52; TMUX, also with the passthrough
 * of tmux; SCREEN, also with the passthrough of GNU screen, whose strings are limited to
 * 768 bytes.  g_free.  Errors: GB_ERR_INPUT for a text that is empty or too long, or with
 * the clipboard off. */
char *gb_clipboard_sequence(int clipboard, const char *text, struct gb_error *err);

/* Sends a text to the clipboard.  Whether the terminal accepts it is not reported by any
 * terminal.  Inside of tmux the text becomes its newest paste buffer, too.  Errors: as
 * above. */
bool gb_clipboard_copy(struct gb_term *term, const char *text, struct gb_error *err);

#endif
