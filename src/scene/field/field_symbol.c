#include "scene/field/field_symbol.h"

#include <string.h>

static const struct {
    const char *group, *key, *symbol;
} symbols[] = {
    {"material", "young", "<i>E</i>"},
    {"material", "poisson", "<i>\u03bd</i>"},
    {"material", "density", "<i>\u03c1</i><sub>s</sub>"},
    {"material", "d0", "<i>d</i><sub>0</sub>"},
    {"material", "n_d0_cubed", "<i>n</i><sub>0</sub> <i>d</i><sub>0</sub><sup>3</sup>"},
    {"material", "epsilon", "<i>\u03b5</i>"},
    {"material", "yield", "<i>\u03c3</i><sub>Y</sub>"},
    {"material", "hardening", "<i>m</i>"},
    {"material", "hollomon", "<i>\u03c3</i><sub>0</sub>"},
    {"particles", "count", "<i>N</i>"},
    {"particles", "diameter", "<i>d</i>"},
    {"particles", "median", "<i>d</i><sub>50,0</sub>"},
    {"particles", "sigma", "<i>s</i>"},
    {"particles", "least", "<i>d</i><sub>min</sub>"},
    {"particles", "largest", "<i>d</i><sub>max</sub>"},
    {"contact", "alpha", "<i>\u03b1</i>"},
    {"contact", "mu", "<i>\u03bc</i>"},
    {"contact", "mu_wall", "<i>\u03bc</i><sub>w</sub>"},
    {"contact", "mu_pivot", "<i>\u03bc</i><sub>p</sub>"},
    {"contact", "bridge_length", "\u0394<i>r</i><sub>ch</sub>"},
    {"contact", "shear_strength", "<i>\u03c3</i><sub>b</sub>"},
    {"contact", "viscosity", "<i>\u03b7</i>"},
    {"contact", "damping", "<i>\u03be</i>"},
    {"contact", "shear_ratio", "<i>k</i><sub>t</sub> / <i>k</i><sub>n</sub>"},
    {"structure", "overlap", "<i>h</i> / <i>d</i>"},
    {"structure", "density", "<i>\u03c1</i><sub>0</sub>"},
    {"structure", "r_meso", "<i>r</i><sub>meso</sub>"},
    {"die", "diameter", "<i>D</i>"},
    {"die", "eject_speed", "<i>v</i><sub>e</sub>"},
    {"die", "weld_strength", "<i>\u03c3</i><sub>w</sub>"},
    {"loading", "step", "\u0394<i>\u03b5</i>"},
    {"loading", "rate", "<i>v</i>"},
    {"numerics", "time_step", "\u0394<i>t</i>"},
    {"numerics", "cutoff", "<i>r</i><sub>c</sub>"},
};

const char *gb_field_symbol(const struct gb_field *field)
{
    for (size_t k = 0; k < sizeof symbols / sizeof symbols[0]; k++) {
        if (strcmp(symbols[k].group, field->group) == 0 &&
            strcmp(symbols[k].key, field->key) == 0) {
            return symbols[k].symbol;
        }
    }
    return NULL;
}
