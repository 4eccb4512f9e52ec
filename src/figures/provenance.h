#ifndef GB_FIGURES_PROVENANCE_H
#define GB_FIGURES_PROVENANCE_H

/* Text of preset.ini of a run directory, or of the run of a state file (in the directory or
 * in its folder snapshots); NULL: none.  g_free. */
char *gb_provenance_preset(const char *path);

#endif
