#ifndef GB_CLI_MODULI_FOLDER_H
#define GB_CLI_MODULI_FOLDER_H

#include "io/preset.h"
#include "run/moduli/moduli_states.h"

/* The folder of `greenbody moduli --out`: moduli.csv, and of a preset preset.ini. */
struct gb_moduli_folder {
    const char *path;    /* NULL: none, and nothing is written */
    const char *command; /* as typed, for the table's comment */
    GArray *earlier;     /* struct gb_moduli_state, of the file as it was */
};

void gb_moduli_folder_init(struct gb_moduli_folder *folder, const char *path,
                           const char *command);
void gb_moduli_folder_finish(struct gb_moduli_folder *folder);

/* Makes the folder of a preset and writes preset.ini.  Errors: GB_ERR_INPUT when it has a
 * preset or moduli already, GB_ERR_MACHINE. */
bool gb_moduli_folder_begin(const struct gb_moduli_folder *folder,
                            struct gb_preset *preset, struct gb_error *err);
/* The folder of a run: its own directory, whose table is read to grow, or a folder without
 * moduli.  Errors: as above, and of gb_moduli_states_read. */
bool gb_moduli_folder_open(struct gb_moduli_folder *folder, const char *directory,
                           struct gb_error *err);
/* moduli.csv of the earlier states and these (struct gb_moduli_state). */
bool gb_moduli_folder_write(const struct gb_moduli_folder *folder, const GArray *states,
                            struct gb_error *err);

#endif
