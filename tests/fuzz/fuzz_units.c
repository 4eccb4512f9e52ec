#include "fuzz/target.h"

#include <math.h>
#include <string.h>

#include "base/units.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char text[256], again[64];
    struct gb_error err = {0};
    if (size < 1) {
        return 0;
    }
    const size_t length = size - 1 < sizeof text - 1 ? size - 1 : sizeof text - 1;
    const enum gb_dimension dimension = (enum gb_dimension)(data[0] % 10);
    double value = 0.0, back = 0.0;
    memcpy(text, data + 1, length);
    text[length] = '\0';
    if (!gb_units_parse(text, dimension, &value, &err)) {
        return err.text[0] == '\0' ? (abort(), 0) : 0;
    }
    /* what is written reads back the same, but for the sign of zero */
    gb_units_format(value, dimension, again, sizeof again);
    if (isfinite(value) && (!gb_units_parse(again, dimension, &back, &err) ||
                            back < value || back > value)) {
        fprintf(stderr, "%s is written %s\n", text, again);
        abort();
    }
    return 0;
}
