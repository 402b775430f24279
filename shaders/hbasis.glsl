// hbasis.glsl - functions that are orthonormal over the upper hemisphere: four or six coefficients of E/pi.
// Habel and Wimmer, "Efficient Irradiance Normal Mapping" (I3D 2010). n: unit normal in tangent space.
#ifndef RNMBAKE_HBASIS
#define RNMBAKE_HBASIS
#include "rnmbake_types.glsl"

vec3 h4_decode(vec3 h0, vec3 h1, vec3 h2, vec3 h3, vec3 n)
{
    return 0.39894228 * h0 + 0.69098830 * (n.y * h1 + (2.0 * n.z - 1.0) * h2 + n.x * h3);
}

vec3 h6_decode(vec3 h0, vec3 h1, vec3 h2, vec3 h3, vec3 h4, vec3 h5, vec3 n)
{
    return h4_decode(h0, h1, h2, h3, n) +
           1.54509681 * (n.x * n.y * h4 + 0.5 * (n.x * n.x - n.y * n.y) * h5);
}

#endif
