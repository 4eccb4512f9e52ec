#ifndef GB_STUDY_STUDY_TEXT_H
#define GB_STUDY_STUDY_TEXT_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/listing.h"
#include "greenbody/status.h"
#include "measure/fit.h"

/* Tables and pages of the studies of compacts. */

/* "12.3 +- 0.4" after a head; "-" where there is no value. */
void gb_study_text_value(GString *text, const char *head,
                         const struct gb_fit_value *value, double factor);
/* The same as a cell. */
void gb_study_text_mean(struct gb_listing *listing, const struct gb_fit_value *value,
                        double factor);

/* "12.3 (11 to 14)" after a head, by a format for each number; "-" for those that are not
 * finite. */
void gb_study_text_interval(GString *text, const char *head, const char *format,
                            const struct gb_fit_value *value, double factor);

struct gb_study_text_file {
    const char *name;
    GString *text;
};

/* Writes files into a folder, each as a whole, and frees the texts. */
bool gb_study_text_write(const struct gb_study_text_file *file, size_t count,
                         const char *directory, struct gb_error *err);

#endif
