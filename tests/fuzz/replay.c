/* Calls a fuzz target with every file of the folders given: old finds stay tests.  Counts
 * for TAP. */
#include <dirent.h>
#include <string.h>

#include "fuzz/target.h"

static int replay(const char *folder, const char *name)
{
    static uint8_t data[1 << 22];
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return 1;
    }
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    LLVMFuzzerTestOneInput(data, size);
    /* and cut at some places, as a full disk would */
    for (size_t part = 1; part < 8; part++) {
        LLVMFuzzerTestOneInput(data, size * part / 8);
    }
    return 0;
}

int main(int argc, char **argv)
{
    int count = 0, bad = 0;
    for (int i = 1; i < argc; i++) {
        DIR *folder = opendir(argv[i]);
        const struct dirent *entry;
        while (folder != NULL && (entry = readdir(folder)) != NULL) {
            if (entry->d_name[0] == '.') {
                continue;
            }
            const int failed = replay(argv[i], entry->d_name);
            printf("%sok %d %s\n", failed ? "not " : "", ++count, entry->d_name);
            bad += failed;
        }
        if (folder != NULL) {
            closedir(folder);
        }
    }
    printf("1..%d\n", count);
    return bad > 0 || count == 0;
}
