// sh3.glsl - spherical harmonics of three bands: nine coefficients of the light that arrives, sh0..sh8.
// Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps" (2001): the
// clamped cosine weighs the bands by 1, 2/3, 1/4 (over pi). n: unit normal in the space of the coefficients.
#ifndef RNMBAKE_SH3
#define RNMBAKE_SH3
#include "rnmbake_types.glsl"

vec3 sh3_decode(vec3 sh[9], vec3 n)
{
    vec3 light = 0.28209479 * sh[0];
    light += 0.32573501 * (n.y * sh[1] + n.z * sh[2] + n.x * sh[3]);
    light += 0.27313711 * (n.x * n.y * sh[4] + n.y * n.z * sh[5] + n.x * n.z * sh[7]);
    light += 0.07884789 * (3.0 * n.z * n.z - 1.0) * sh[6];
    light += 0.13656855 * (n.x * n.x - n.y * n.y) * sh[8];
    return light;
}

#endif
