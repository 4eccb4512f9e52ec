#include "tui/panel/panel_state_text.h"

#include <math.h>
#include <stdio.h>

void gb_panel_state_text_number(char *text, size_t size, const char *format, double value)
{
    if (isfinite(value)) {
        snprintf(text, size, format, value);
    } else {
        snprintf(text, size, "-");
    }
}

/* "812", "6.31 k", "12.3 M": three digits. */
void gb_panel_state_text_count(char *text, size_t size, double value)
{
    static const char *const prefix[] = {"", "k", "M", "G", "T"};
    size_t k = 0;
    while (fabs(value) >= 999.5 && k < 4) {
        value *= 1e-3;
        k++;
    }
    const int decimals = k == 0 || fabs(value) >= 99.95 ? 0
                         : fabs(value) >= 9.995         ? 1
                                                        : 2;
    snprintf(text, size, "%.*f%s%s", decimals, value, k > 0 ? " " : "", prefix[k]);
}

/* "31.2 aJ", "214 fJ": three digits, the prefix below one joule. */
void gb_panel_state_text_energy(char *text, size_t size, double value)
{
    static const char *const prefix[] = {"", "m", "u", "n", "p", "f", "a"};
    size_t k = 0;
    while (fabs(value) < 0.9995 && k < 6) {
        value *= 1e3;
        k++;
    }
    const int decimals = fabs(value) >= 99.95 ? 0 : fabs(value) >= 9.995 ? 1 : 2;
    if (!isfinite(value)) {
        snprintf(text, size, "-");
    } else if (fabs(value) < 0.005) {
        snprintf(text, size, "0 J");
    } else {
        snprintf(text, size, "%.*f %sJ", decimals, value, prefix[k]);
    }
}
