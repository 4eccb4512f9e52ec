#include "cli/exit_status.h"

#include <glib.h>

#include "base/text/visible.h"

static const struct {
    const char *status, *meaning;
} rows[] = {
    {"0", "done"},
    {"1",
     "a physical or numerical guard stopped the run, or it ended without reaching a goal "
     "(loading.until, a pressure of loading.unload_from) or beyond one (also the end of a leg "
     "of loading.path), or with points that are not in "
     "equilibrium; the results are kept"},
    {"2", "bad usage or input; one line with the rejected value and what is accepted"},
    {"3", "the machine: disk full, no permission, out of memory"},
    {"129", "stopped by SIGHUP; points and state are kept"},
    {"130", "stopped by SIGINT; points and state are kept"},
    {"143", "stopped by SIGTERM; points and state are kept"},
};

void gb_exit_status_print(FILE *to)
{
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        gb_visible_print(to, "%s %s\n", rows[i].status, rows[i].meaning);
    }
}
