#include "draw/image/palette.h"

#include <math.h>

/* Anchors of viridis at 0, 1/16, ..., 1. */
static const uint8_t anchors[][3] = {
    {68, 1, 84},    {72, 26, 108},  {71, 47, 125},  {65, 68, 135},  {57, 86, 140},
    {49, 104, 142}, {42, 120, 142}, {35, 136, 142}, {31, 152, 139}, {34, 168, 132},
    {53, 183, 121}, {84, 197, 104}, {122, 209, 81}, {165, 219, 54}, {210, 226, 27},
    {234, 229, 26}, {253, 231, 37},
};

enum { LAST = sizeof anchors / sizeof anchors[0] - 1 };

/* Where the scale of coordination numbers begins on viridis. */
static const double contacts_start = 0.06;

void gb_palette_scale(double x, uint8_t rgb[3])
{
    const double at = fmin(fmax(x, 0.0), 1.0) * LAST;
    const int k = at >= LAST ? LAST - 1 : (int)at;
    const double t = at - k;
    for (int c = 0; c < 3; c++) {
        rgb[c] = (uint8_t)lrint(anchors[k][c] + t * (anchors[k + 1][c] - anchors[k][c]));
    }
}

void gb_palette_contacts(int contacts, uint8_t rgb[3])
{
    const double share = (double)contacts / GB_PALETTE_CONTACTS;
    gb_palette_scale(
        contacts_start + (1.0 - contacts_start) * fmin(fmax(share, 0.0), 1.0), rgb);
}

void gb_palette_field(double x, uint8_t rgb[3])
{
    gb_palette_scale(contacts_start + (1.0 - contacts_start) * fmin(fmax(x, 0.0), 1.0),
                     rgb);
}
