#ifndef GB_PACK_DIE_DIE_H
#define GB_PACK_DIE_DIE_H

#include <stdbool.h>

/* The bore: without an upper end; with one at `top`; drawn off to below the floor. */
enum gb_die_bore { GB_DIE_BORE_ENDLESS, GB_DIE_BORE_OPEN, GB_DIE_BORE_GONE };

/* A cylinder on a floor with a funnel over it and a punch in it.  Axis z through x = y =
 * 0, floor at z = 0; any unit of length.  All are rigid walls: to the contact laws each
 * is a sphere of infinite radius.  Source: P3 section 5, Fig. 13. */
struct gb_die {
    double radius; /* of the cylinder */
    /* The funnel: a flat ring at `height` from the cylinder's wall in to the outlet, and
     * a cone that opens upward from there.  Without it the wall has no upper end. */
    bool funnel;
    double height, outlet;
    double sine, cosine; /* of the angle between the cone's wall and the axis */
    /* The punch: a plane that presses from above. */
    bool punch;
    double punch_position, punch_velocity; /* along z */
    /* The cylinder while the compact is ejected: a block whose flat top, with the open end
     * of the bore, lies at `top` and sinks towards the floor.  A push of the lower punch,
     * seen from that punch. */
    enum gb_die_bore bore;
    double top, side_velocity; /* of the block, along z */
};

enum gb_die_wall { GB_DIE_FLOOR, GB_DIE_SIDE, GB_DIE_PUNCH, GB_DIE_FUNNEL, GB_DIE_WALLS };

/* Overlap of a sphere (centre x, radius) with a wall, negative across a gap; unit points
 * from the wall to the centre.  -INFINITY where the wall is absent. */
double gb_die_overlap(const struct gb_die *die, enum gb_die_wall wall, const double x[3],
                      double radius, double unit[3]);

/* Is the centre where powder may be: inside the walls, whether it touches them or not?
 * False for what is not a number. */
bool gb_die_contains(const struct gb_die *die, const double x[3]);

/* Radius of the room at height z, on the axis of which a centre may be. */
double gb_die_radius_at(const struct gb_die *die, double z);

#endif
