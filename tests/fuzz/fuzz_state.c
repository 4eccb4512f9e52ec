/* A state file, for pictures and for going on.  The digests would stop nearly everything
 * that is invented, so a record that can be read is also offered without its hash being
 * looked at: see fuzz_record.c. */
#include "fuzz/target.h"

#include "hdf/hdf_record.h"
#include "io/state.h"

static struct gb_record record;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[TARGET_PATH];
    struct gb_state *state = NULL;
    struct gb_error err = {0};
    const int fd = target_open(data, size, path);
    if (!gb_state_read(&state, path, &err) && err.text[0] == '\0') {
        abort();
    }
    gb_state_destroy(state);
    (void)gb_hdf_record_read(&record, path, &err);
    gb_record_finish(&record);
    target_close(fd, path);
    return 0;
}
