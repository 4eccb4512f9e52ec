#ifndef GB_FIGURES_PROVENANCE_H
#define GB_FIGURES_PROVENANCE_H

/* Text of the preset.ini that belongs to a run directory, or to a state file in it or in
 * its folder snapshots; NULL when there is none.  g_free. */
char *gb_provenance_preset(const char *place);

#endif
