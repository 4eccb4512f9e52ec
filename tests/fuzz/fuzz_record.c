/* A checkpoint whose numbers were changed behind the back of its hash: resumed, or
 * refused with a line.  The input is a list of changes: item, byte, value. */
#include "fuzz/target.h"

#include <string.h>

#include "run/checkpoint.h"

static struct gb_record kept, changed;
static struct gb_params params;

static void make(void)
{
    struct gb_error err = {0};
    struct gb_experiment *experiment = NULL;
    gb_params_init(&params);
    if (!gb_params_assign(&params, "particles.count=60", &err) ||
        !gb_params_assign(&params, "structure.base=5.5 d", &err) ||
        !gb_params_assign(&params, "numerics.tolerance=1e-1", &err) ||
        !gb_params_assign(&params, "numerics.threads=1", &err) ||
        !gb_experiment_create(&experiment, &params, NULL, NULL, &err)) {
        abort();
    }
    while (gb_experiment_advance(experiment, 1000, &err) != GB_STEP_POINT) {
    }
    if (!gb_checkpoint_take(experiment, &kept, &err)) {
        abort();
    }
    gb_experiment_destroy(experiment);
}

static void copy(void)
{
    gb_record_clear(&changed);
    for (int k = 0; k < kept.count; k++) {
        const struct gb_record_item *from = &kept.item[k];
        struct gb_record_item *to = gb_record_add(&changed, from->name, from->type,
                                                  from->rows, from->columns, "", NULL);
        if (to == NULL) {
            abort();
        }
        if (from->f32) {
            gb_record_numbers(from, 0, from->rows * from->columns, to->data);
        } else {
            memcpy(to->data, from->data, gb_record_bytes(from));
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct gb_experiment *experiment = NULL;
    struct gb_error err = {0};
    if (kept.count == 0) {
        make();
    }
    copy();
    for (size_t i = 0; i + 4 <= size && i < 64; i += 4) {
        struct gb_record_item *item = &changed.item[data[i] % changed.count];
        const size_t bytes = gb_record_bytes(item);
        if (bytes > 0) {
            const size_t at = ((size_t)data[i + 1] << 8 | data[i + 2]) % bytes;
            ((uint8_t *)item->data)[at] = data[i + 3];
        }
    }
    if (gb_experiment_resume(&experiment, &params, &changed, &err)) {
        (void)gb_experiment_advance(experiment, 5, &err);
    } else if (err.text[0] == '\0') {
        abort();
    }
    gb_experiment_destroy(experiment);
    return 0;
}
