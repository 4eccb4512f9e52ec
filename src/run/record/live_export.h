#ifndef GB_RUN_RECORD_LIVE_EXPORT_H
#define GB_RUN_RECORD_LIVE_EXPORT_H

#include <sys/types.h>

#include "greenbody/params.h"
#include "io/export.h"
#include "run/record/kept_states.h"

/* The kept states of a run as files of other programs, along the run (output.export): a
 * frame for each in DIR/trajectory.FORMAT, or for formats of one state
 * DIR/snapshots/NAME.FORMAT; the contacts in files with "-contacts" behind the name, those
 * of extended XYZ as a table (.csv), those of data files as a dump.
 * What cannot be written is told and left out: it never ends a run. */

/* How much of the trajectory belongs to a checkpoint. */
struct gb_live_extent {
    int64_t format, frames; /* enum gb_live_format */
    int64_t bytes[2];       /* particles, contacts */
};

struct gb_live_export {
    const struct gb_export_format *format; /* NULL: none */
    double density_kg_m3;
    struct gb_live_extent extent;
    int fd[2]; /* -1: not open yet */
    char told[GB_EVENT_TEXT];
};

/* For checked params. */
void gb_live_export_init(struct gb_live_export *live, const struct gb_params *params);
void gb_live_export_finish(struct gb_live_export *live);

/* Cuts the trajectory to a checkpoint.  One of another format begins anew; one that is
 * shorter than it was is left alone, and no frames are added. */
void gb_live_export_resume(struct gb_live_export *live, const char *directory,
                           const struct gb_live_extent *extent);

/* Appends a frame, before the checkpoint of its point is taken. */
void gb_live_export_frame(struct gb_live_export *live, const char *directory,
                          const struct gb_state *state);
/* Files of a format of one state, once the folder of the kept states is there. */
void gb_live_export_files(struct gb_live_export *live, const char *directory,
                          const struct gb_kept_names *names,
                          const struct gb_state *state);

/* An event about what could not be written, once; false: none. */
bool gb_live_export_told(struct gb_live_export *live, char *text, size_t size);

#endif
