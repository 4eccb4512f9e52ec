#ifndef GB_IO_EXPORT_EXPORT_FORMATS_H
#define GB_IO_EXPORT_EXPORT_FORMATS_H

#include "io/export/export.h"

/* The writers of the table of formats; see gb_export_format. */
void gb_export_extxyz_write(const struct gb_export_frame *frame, GString *particles,
                            GString *contacts);
void gb_export_lammps_dump(const struct gb_export_frame *frame, GString *particles,
                           GString *contacts);
void gb_export_lammps_data(const struct gb_export_frame *frame, GString *particles,
                           GString *contacts);
/* The table of contacts, for formats without one of their own. */
void gb_export_csv_contacts(const struct gb_export_frame *frame, GString *text);

void gb_export_csv_write(const struct gb_export_frame *frame, GString *particles,
                         GString *contacts);
bool gb_export_vtkhdf_write(const struct gb_export_frame *frame, GString *particles,
                            GString *contacts, struct gb_error *err);

#endif
