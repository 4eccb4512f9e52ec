#include "fuzz/target.h"

#include <glib.h>

#include "draw/image.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[TARGET_PATH];
    char *value = NULL;
    struct gb_error err = {0};
    const int fd = target_open(data, size, path);
    if (!gb_image_read_text(path, "greenbody", &value, &err) && err.text[0] == '\0') {
        abort();
    }
    g_free(value);
    target_close(fd, path);
    return 0;
}
