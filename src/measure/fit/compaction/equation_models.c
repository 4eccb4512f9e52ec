#include "measure/fit/compaction/equation_models.h"

#include <math.h>

/* ln(1/(1 - rho)) = K P + A */
double gb_equation_models_heckel(const double *x, double pressure)
{
    return -expm1(-(x[0] * pressure + x[1]));
}

void gb_equation_models_heckel_slope(const double *x, double pressure, double *slope)
{
    const double porosity = exp(-(x[0] * pressure + x[1]));
    slope[0] = pressure * porosity;
    slope[1] = porosity;
}

/* D0/(1 - C), C the relative decrease of volume */
static double compressed(double initial, double c)
{
    return c < 1.0 ? initial / (1.0 - c) : (double)NAN;
}

/* C = a b P/(1 + b P), that is P/C = 1/(a b) + P/a */
double gb_equation_models_kawakita(const double *x, double pressure)
{
    const double bp = x[1] * pressure;
    return compressed(x[2], x[0] * bp / (1.0 + bp));
}

void gb_equation_models_kawakita_slope(const double *x, double pressure, double *slope)
{
    const double bp = x[1] * pressure;
    const double left = 1.0 - x[0] * bp / (1.0 + bp); /* D0/rho */
    const double by_c = x[2] / (left * left);
    slope[0] = by_c * bp / (1.0 + bp);
    slope[1] = by_c * x[0] * pressure / ((1.0 + bp) * (1.0 + bp));
    slope[2] = 1.0 / left;
}

/* C = (1 - D0) (a1 exp(-k1/P) + a2 exp(-k2/P)): C_inf = 1 - D0 is that of full density */
double gb_equation_models_cooper_eaton(const double *x, double pressure)
{
    const double filled = x[0] * exp(-x[2] / pressure) + x[1] * exp(-x[3] / pressure);
    return compressed(x[4], (1.0 - x[4]) * filled);
}

void gb_equation_models_cooper_eaton_slope(const double *x, double pressure,
                                           double *slope)
{
    const double first = exp(-x[2] / pressure);
    const double second = exp(-x[3] / pressure);
    const double filled = x[0] * first + x[1] * second;
    const double left = 1.0 - (1.0 - x[4]) * filled;
    const double by_filled = x[4] * (1.0 - x[4]) / (left * left);
    slope[0] = by_filled * first;
    slope[1] = by_filled * second;
    slope[2] = -by_filled * x[0] * first / pressure;
    slope[3] = -by_filled * x[1] * second / pressure;
    slope[4] = (1.0 - filled) / (left * left);
}

/* A specific volume as a density. */
static double inverse(double volume)
{
    return volume > 0.0 ? 1.0 / volume : (double)NAN;
}

/* 1/rho = c - K ln P */
double gb_equation_models_walker(const double *x, double pressure)
{
    return inverse(x[1] - x[0] * log(pressure));
}

void gb_equation_models_walker_slope(const double *x, double pressure, double *slope)
{
    const double rho = 1.0 / (x[1] - x[0] * log(pressure));
    slope[0] = rho * rho * log(pressure);
    slope[1] = -rho * rho;
}

/* ln P = C2 - C1/rho */
double gb_equation_models_balshin(const double *x, double pressure)
{
    return inverse((x[1] - log(pressure)) / x[0]);
}

void gb_equation_models_balshin_slope(const double *x, double pressure, double *slope)
{
    const double rest = x[1] - log(pressure);
    slope[0] = 1.0 / rest;
    slope[1] = -x[0] / (rest * rest);
}

/* P = tau/alpha (exp(alpha eps) - 1) with eps = ln(rho/D0): the exponential of
 * ln P = ln(tau/alpha) + alpha eps + ln(1 - exp(-alpha eps)) */
double gb_equation_models_adams(const double *x, double pressure)
{
    return x[2] * exp(log1p(x[1] * pressure / x[0]) / x[1]);
}

void gb_equation_models_adams_slope(const double *x, double pressure, double *slope)
{
    const double u = x[1] * pressure / x[0];
    const double strain = log1p(u) / x[1];
    const double rho = x[2] * exp(strain);
    slope[0] = -rho * pressure / (x[0] * x[0] * (1.0 + u));
    slope[1] = rho * (pressure / (x[0] * (1.0 + u)) - strain) / x[1];
    slope[2] = rho / x[2];
}

/* ln(1/(1 - rho)) = ln(1/(1 - D0)) + k P + b sqrt(P) */
double gb_equation_models_shapiro(const double *x, double pressure)
{
    return 1.0 - (1.0 - x[2]) * exp(-x[0] * pressure - x[1] * sqrt(pressure));
}

void gb_equation_models_shapiro_slope(const double *x, double pressure, double *slope)
{
    const double share = exp(-x[0] * pressure - x[1] * sqrt(pressure));
    slope[0] = (1.0 - x[2]) * share * pressure;
    slope[1] = (1.0 - x[2]) * share * sqrt(pressure);
    slope[2] = share;
}

/* ln(1/(1 - rho)) = A sqrt(P) + B */
double gb_equation_models_panelli(const double *x, double pressure)
{
    return -expm1(-(x[0] * sqrt(pressure) + x[1]));
}

void gb_equation_models_panelli_slope(const double *x, double pressure, double *slope)
{
    const double porosity = exp(-(x[0] * sqrt(pressure) + x[1]));
    slope[0] = sqrt(pressure) * porosity;
    slope[1] = porosity;
}

/* ln((r_inf - D0)/(r_inf - rho)) = K P^n */
double gb_equation_models_secondi(const double *x, double pressure)
{
    return x[0] - (x[0] - x[3]) * exp(-x[1] * pow(pressure, x[2]));
}

void gb_equation_models_secondi_slope(const double *x, double pressure, double *slope)
{
    const double power = pow(pressure, x[2]);
    const double share = exp(-x[1] * power);
    slope[0] = 1.0 - share;
    slope[1] = (x[0] - x[3]) * share * power;
    slope[2] = slope[1] * x[1] * log(pressure);
    slope[3] = share;
}
