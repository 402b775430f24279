// directions.glsl - encodings of one direction for each texel: AHD, and Unity's dominant direction.
// AHD (ambient and highlight direction): Iwanicki, "Lighting Technology of The Last of Us" (SIGGRAPH 2013).
// Dominant: what Unity's built-in pipeline decodes from its pair of lightmap and direction map.
#ifndef RNMBAKE_DIRECTIONS
#define RNMBAKE_DIRECTIONS
#include "rnmbake_types.glsl"

// direction: unit vector of the layer of that name. n in its space.
vec3 ahd_decode(vec3 ambient, vec3 directional, vec3 direction, vec3 n)
{
    return ambient + directional * max(dot(direction, n), 0.0);
}

// direction: d/2 + 1/2 as it is stored; directionality: w, the decode's value for the geometric normal.
vec3 dominant_decode(vec3 colour, vec3 direction, float directionality, vec3 n)
{
    return colour * (dot(n, direction - 0.5) + 0.5) / max(directionality, 1e-4);
}

#endif
