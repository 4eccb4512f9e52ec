#ifndef GB_SCENE_FIELD_SYMBOL_H
#define GB_SCENE_FIELD_SYMBOL_H

#include "greenbody/params.h"

/* Symbol of a key in figures and reports, quantities in italics (ISO 80000-1): markup with
 * <i>, <sub> and <sup>, as in Pango and HTML.  NULL: it has none. */
const char *gb_field_symbol(const struct gb_field *field);

#endif
