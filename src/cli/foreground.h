#ifndef GB_CLI_FOREGROUND_H
#define GB_CLI_FOREGROUND_H

#include "api/simulation_private.h"
#include "cli/progress.h"

/* A run without screen: a simulation (greenbody/simulation.h) with signals, progress on
 * stderr and the exit status of the command. */
struct gb_foreground {
    struct gb_simulation *simulation; /* owned; NULL before gb_foreground_attach */
    struct gb_progress progress;
    bool json; /* the end of the run as JSON on stdout */
    /* Called while the packing is built; NULL: nothing is done. */
    void (*on_packing)(void *data);
    void *data;
    char stopped[64]; /* why a signal ends the run */
};

/* Installs the signal handlers (cli/signals.h).  HUP is handled as output.on_hangup says. */
void gb_foreground_init(struct gb_foreground *run, bool quiet);
void gb_foreground_finish(struct gb_foreground *run);

/* The simulation belongs to the foreground from now on. */
void gb_foreground_attach(struct gb_foreground *run, struct gb_simulation *simulation);

/* Runs to the end; returns the exit status.  Errors have been printed. */
int gb_foreground_run(struct gb_foreground *run);

/* Prints err of a run that fails before it begins, and writes it to the status when there
 * is a directory; returns the exit status. */
int gb_foreground_fail(struct gb_foreground *run, const struct gb_error *err);

#endif
