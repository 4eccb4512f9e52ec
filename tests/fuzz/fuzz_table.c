#include "fuzz/target.h"

#include <string.h>

#include "base/table.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[TARGET_PATH];
    struct gb_table *table = NULL;
    struct gb_error err = {0};
    const int fd = target_open(data, size, path);
    if (gb_table_read(&table, path, "branch", &err)) {
        for (size_t row = 0; row < gb_table_rows(table); row++) {
            if (strlen(gb_table_word(table, row)) > size) {
                abort();
            }
        }
        (void)gb_table_column(table, "density", &err);
    } else if (err.text[0] == '\0' || strchr(err.text, '\n') != NULL) {
        abort();
    }
    gb_table_destroy(table);
    target_close(fd, path);
    return 0;
}
