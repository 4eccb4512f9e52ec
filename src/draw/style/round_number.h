#ifndef GB_DRAW_STYLE_ROUND_NUMBER_H
#define GB_DRAW_STYLE_ROUND_NUMBER_H

/* Largest of 1, 2, 5 x 10^k that is at most `max`, which is positive. */
double gb_round_number_below(double max);

/* Smallest of 1, 1.5, 2, 3, 4, 5, 6, 8 x 10^k that is at least `min`, which is positive. */
double gb_round_number_above(double min);

/* Of 1, 2, 5, 10 x 10^k the one nearest to a positive step. */
double gb_round_number_step(double rough);

#endif
