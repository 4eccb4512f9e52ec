#include "draw/image/palette.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { LAST = GB_PALETTE_ANCHORS - 1 };

static const struct gb_palette_map maps[] = {
    {"viridis",
     "dark blue, green, yellow",
     false,
     0.06,
     {{68, 1, 84},
      {72, 26, 108},
      {71, 47, 125},
      {65, 68, 135},
      {57, 86, 140},
      {49, 104, 142},
      {42, 120, 142},
      {35, 136, 142},
      {31, 152, 139},
      {34, 168, 132},
      {53, 183, 121},
      {84, 197, 104},
      {122, 209, 81},
      {165, 219, 54},
      {210, 226, 27},
      {234, 229, 26},
      {253, 231, 37}}},
    {"fire",
     "violet, red, light yellow",
     false,
     0.0,
     {{60, 31, 79},
      {85, 32, 92},
      {112, 32, 100},
      {138, 30, 104},
      {163, 30, 105},
      {186, 35, 103},
      {205, 46, 99},
      {221, 62, 94},
      {234, 80, 89},
      {244, 100, 86},
      {250, 121, 85},
      {254, 142, 87},
      {255, 162, 95},
      {255, 182, 108},
      {255, 201, 126},
      {254, 220, 150},
      {255, 237, 179}}},
    {"blue-yellow",
     "blue, grey, yellow, for all kinds of colour vision",
     false,
     0.0,
     {{1, 51, 110},
      {33, 60, 113},
      {52, 70, 116},
      {68, 80, 119},
      {82, 90, 122},
      {96, 101, 125},
      {109, 112, 127},
      {122, 123, 130},
      {135, 134, 132},
      {150, 144, 133},
      {164, 154, 134},
      {179, 164, 135},
      {193, 174, 135},
      {208, 185, 136},
      {222, 196, 136},
      {237, 206, 136},
      {251, 217, 136}}},
    {"grey",
     "dark to light grey",
     false,
     0.0,
     {{53, 53, 53},
      {63, 63, 63},
      {74, 74, 74},
      {84, 84, 84},
      {95, 95, 95},
      {107, 107, 107},
      {118, 118, 118},
      {130, 130, 130},
      {142, 142, 142},
      {154, 154, 154},
      {166, 166, 166},
      {179, 179, 179},
      {191, 191, 191},
      {204, 204, 204},
      {217, 217, 217},
      {230, 230, 230},
      {243, 243, 243}}},
    {"diverging",
     "blue, light grey, brown; around 0 where the values have both signs",
     true,
     0.0,
     {{19, 83, 166},
      {65, 100, 175},
      {95, 118, 184},
      {121, 137, 193},
      {145, 156, 202},
      {169, 176, 211},
      {192, 196, 220},
      {215, 217, 229},
      {238, 238, 238},
      {230, 214, 209},
      {222, 190, 181},
      {212, 167, 154},
      {201, 144, 128},
      {189, 122, 102},
      {177, 99, 77},
      {163, 77, 53},
      {148, 53, 30}}},
    {0},
};

const struct gb_palette_map *gb_palette_maps(void)
{
    return maps;
}

const struct gb_palette_map *gb_palette_find(const char *name)
{
    for (const struct gb_palette_map *map = maps; map->name != NULL; map++) {
        if (strcmp(map->name, name) == 0) {
            return map;
        }
    }
    return NULL;
}

static void interpolate(const struct gb_palette_map *map, double x, uint8_t rgb[3])
{
    const double at = fmin(fmax(x, 0.0), 1.0) * LAST;
    const int k = at >= LAST ? LAST - 1 : (int)at;
    const double t = at - k;
    for (int c = 0; c < 3; c++) {
        const int low = map->anchor[k][c];
        rgb[c] = (uint8_t)lrint(low + t * (map->anchor[k + 1][c] - low));
    }
}

void gb_palette_value(const struct gb_palette_map *map, double x, uint8_t rgb[3])
{
    const struct gb_palette_map *used = map != NULL ? map : &maps[0];
    interpolate(used, used->start + (1.0 - used->start) * fmin(fmax(x, 0.0), 1.0), rgb);
}

void gb_palette_scale(double x, uint8_t rgb[3])
{
    interpolate(&maps[0], x, rgb);
}
