#ifndef GB_STUDY_CALIBRATE_CALIBRATION_TABLE_H
#define GB_STUDY_CALIBRATE_CALIBRATION_TABLE_H

#include "study/calibrate/calibration.h"

/* Results of a calibration as files and as text. */

/* The text of a calibration in its directory. */
#define GB_CALIBRATION_TABLE_TEXT "calibration.txt"

/* Writes calibration.csv, calibration.txt, fit.csv and calibrated.ini, the preset with the
 * fitted values, which it gives to preset. */
bool gb_calibration_table_write(const struct gb_calibration *calibration,
                                struct gb_preset *preset, struct gb_error *err);

/* Fitted parameters with intervals, correlations, residuals.  g_string_free. */
GString *gb_calibration_table_text(const struct gb_calibration *calibration);

/* Whether a line of that text warns of a value. */
bool gb_calibration_table_warns(const char *line);

#endif
