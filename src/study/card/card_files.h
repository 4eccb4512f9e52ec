#ifndef GB_STUDY_CARD_CARD_FILES_H
#define GB_STUDY_CARD_CARD_FILES_H

#include <glib.h>

#include "study/card/card.h"

/* The tables of a card; stresses in MPa, angles in degrees, moduli in GPa. */

/* A line for each density and side on which the surface is further from its own points (rms)
 * than their 95 % intervals (rms of the standard errors, Student's t); empty where it is
 * not.  card.csv and card.inp have them as comments. */
GString *gb_card_files_misses(const struct gb_card_study *study);
/* card.csv: a row per density, each parameter with its 95 % interval (_low, _high). */
GString *gb_card_files_card(const struct gb_card_study *study, const char *comment);
/* card_points.csv: the yield points, means over the cells with standard errors; `side` is
 * shear, cap or tension. */
GString *gb_card_files_points(const struct gb_card_study *study, const char *comment);
/* card_uniaxial.csv, card_isotropic.csv: pressing along a path, simulated and predicted,
 * with 95 % intervals. */
GString *gb_card_files_path(const struct gb_card_study *study, enum gb_card_path path,
                            const char *comment);
/* card.inp: *MATERIAL with *ELASTIC, *CAP PLASTICITY and *CAP HARDENING for Abaqus, in mm,
 * N, MPa, tonne.  The first field variable is the relative density.
 *
 * mass_density  of the solid, kg/m3 */
GString *gb_card_files_abaqus(const struct gb_card_study *study, const char *comment,
                              double mass_density);

#endif
