#ifndef GB_TUI_PANEL_PANEL_STATE_TEXT_H
#define GB_TUI_PANEL_PANEL_STATE_TEXT_H

#include <stddef.h>

/* Numbers of the state pane; "-" for what is not finite. */

/* By a format of printf for one double. */
void gb_panel_state_text_number(char *text, size_t size, const char *format,
                                double value);
/* "812", "6.31 k", "12.3 M": three digits. */
void gb_panel_state_text_count(char *text, size_t size, double value);
/* "31.2 aJ", "214 fJ": three digits, the prefix below one joule. */
void gb_panel_state_text_energy(char *text, size_t size, double value);

#endif
