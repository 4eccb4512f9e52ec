#ifndef GB_CLI_MODULI_OUTPUT_H
#define GB_CLI_MODULI_OUTPUT_H

#include "run/moduli/moduli_states.h"

/* Moduli of a state on stdout, to be read: C in full, averages, wave speeds, elastic
 * range; with standard errors over replicas. */
void gb_moduli_output_state(const struct gb_moduli_state *state);

#endif
