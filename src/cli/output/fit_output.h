#ifndef GB_CLI_FIT_OUTPUT_H
#define GB_CLI_FIT_OUTPUT_H

#include <glib.h>

#include "many/lab/compaction_data.h"
#include "measure/fit/compaction/compaction_fits.h"

/* Fits of the equations of compaction as text; g_string_free. */

/* Rows equation,parameter,value,low,high,unit by ascending AICc: the parameters, the ends
 * of Heckel's stretch, rms and AICc of each equation that was fitted.  Cells are empty
 * where there is no interval, or no end of it. */
GString *gb_fit_output_csv(const struct gb_compaction_fits *fits,
                           const struct gb_compaction_data *data);

/* The same to be read, with what was fitted to what and the reasons of refusals. */
GString *gb_fit_output_text(const struct gb_compaction_fits *fits,
                            const struct gb_compaction_data *data);

#endif
