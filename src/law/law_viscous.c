#include "law/law_viscous.h"

double gb_law_viscous_time(double viscosity_pa_s, double young_pa, double poisson)
{
    if (viscosity_pa_s <= 0.0) {
        return 0.0; /* also at nu = 0, where the fraction below is 0/0 */
    }
    const double square = poisson * poisson;
    return viscosity_pa_s * (1.0 - square) * (1.0 - 2.0 * poisson) /
           (3.0 * young_pa * square);
}
