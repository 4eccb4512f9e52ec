#ifndef GB_CLI_SIGNALS_H
#define GB_CLI_SIGNALS_H

#include <stdbool.h>

#include "greenbody/status.h"

/* Signals of a command without a screen. */

/* What HUP does; under nohup it is ignored. */
enum gb_signals_hangup {
    GB_SIGNALS_HANGUP_NOTED, /* for gb_signals_take_hangup */
    GB_SIGNALS_HANGUP_ENDS   /* the same as INT */
};

/* Installs the handlers: the first INT or TERM requests an orderly end, the second ends
 * the process at once.  A file size limit and a closed pipe become errors of the write. */
void gb_signals_install(enum gb_signals_hangup hangup);

/* Number of the signal that requests the end; 0: none. */
int gb_signals_caught(void);
/* The same as a callback; data is not used. */
bool gb_signals_cancelled(void *data);

/* True once after the terminal was closed.  stop: HUP counts as caught. */
bool gb_signals_take_hangup(void);
void gb_signals_stop_by_hangup(void);

/* Exit status of a command that ends with err: 128 + the signal, where one ended it. */
int gb_signals_exit_status(const struct gb_error *err);

#endif
