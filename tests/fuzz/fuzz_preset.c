#include "fuzz/target.h"

#include "io/preset.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[TARGET_PATH];
    struct gb_preset *preset = NULL;
    struct gb_error err = {0};
    const int fd = target_open(data, size, path);
    if (gb_preset_load(&preset, path, &err)) {
        (void)gb_params_check(gb_preset_params(preset), &err);
    } else if (err.text[0] == '\0') {
        abort(); /* refused without a word */
    }
    gb_preset_destroy(preset);
    target_close(fd, path);
    return 0;
}
