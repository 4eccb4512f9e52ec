#ifndef GB_STUDY_CARD_CARD_MISFIT_H
#define GB_STUDY_CARD_CARD_MISFIT_H

#include "measure/fit/fit.h"

enum { GB_CARD_CURVE_POINTS = 60 };

/* Pressing along a path, simulated and predicted, at one density. */
struct gb_card_compared {
    double density;
    struct gb_fit_value simulated_ratio, simulated_pz; /* p_x/p_z; Pa */
    struct gb_fit_value predicted_ratio, predicted_pz;
};

struct gb_card_misfit {
    double ratio;    /* rms of predicted less simulated p_x/p_z */
    double pressure; /* rms of predicted over simulated p_z, less 1 */
    double density;  /* rms of predicted less simulated density at the same p_z */
    double ratio_most, density_most; /* largest of either sign */
};

/* Of the points of a curve from a density on that are simulated and predicted. */
void gb_card_misfit_measure(struct gb_card_misfit *misfit,
                            const struct gb_card_compared curve[GB_CARD_CURVE_POINTS],
                            double from);

#endif
