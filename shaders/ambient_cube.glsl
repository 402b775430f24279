// ambient_cube.glsl - six colours, one for each side of a cube, weighed by the squares of the normal.
// McTaggart, "Half-Life 2 / Valve Source Shading" (GDC 2004). cube: +x, -x, +y, -y, +z, -z in E/pi.
#ifndef RNMBAKE_AMBIENT_CUBE
#define RNMBAKE_AMBIENT_CUBE
#include "rnmbake_types.glsl"

vec3 ambient_cube_decode(vec3 cube[6], vec3 n)
{
    vec3 w = n * n;
    return w.x * (n.x >= 0.0 ? cube[0] : cube[1]) + w.y * (n.y >= 0.0 ? cube[2] : cube[3]) +
           w.z * (n.z >= 0.0 ? cube[4] : cube[5]);
}

#endif
