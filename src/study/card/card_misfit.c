#include "study/card/card_misfit.h"

#include <math.h>

#include "measure/fit/average.h"

/* Density at which the predicted curve has the pressure; NaN outside. */
static double predicted_density(const struct gb_card_compared *at, double pz)
{
    double x[GB_CARD_CURVE_POINTS], y[GB_CARD_CURVE_POINTS];
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        x[i] = at[i].predicted_pz.value;
        y[i] = at[i].density;
    }
    const struct gb_average_curve curve = {x, y, GB_CARD_CURVE_POINTS};
    return gb_average_crossing(&curve, pz, NULL);
}

void gb_card_misfit_measure(struct gb_card_misfit *misfit,
                            const struct gb_card_compared curve[GB_CARD_CURVE_POINTS],
                            double from)
{
    int count = 0, densities = 0;
    *misfit = (struct gb_card_misfit){0};
    for (int i = 0; i < GB_CARD_CURVE_POINTS; i++) {
        const struct gb_card_compared *at = &curve[i];
        const double ratio = at->predicted_ratio.value - at->simulated_ratio.value;
        const double share = at->predicted_pz.value / at->simulated_pz.value - 1.0;
        if (at->density < from || !isfinite(ratio) || !isfinite(share)) {
            continue;
        }
        const double off = predicted_density(curve, at->simulated_pz.value) - at->density;
        misfit->ratio += ratio * ratio;
        misfit->pressure += share * share;
        misfit->ratio_most = fmax(misfit->ratio_most, fabs(ratio));
        count++;
        if (isfinite(off)) {
            misfit->density += off * off;
            misfit->density_most = fmax(misfit->density_most, fabs(off));
            densities++;
        }
    }
    misfit->ratio = sqrt(misfit->ratio / count);
    misfit->pressure = sqrt(misfit->pressure / count);
    misfit->density = sqrt(misfit->density / densities);
}
