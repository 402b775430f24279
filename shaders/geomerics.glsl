// geomerics.glsl - the numbers of sh2.glsl as a power of the half cosine, never negative where |v| <= 2 a.
// Geomerics (Hazel), "Reconstructing Diffuse Lighting from Spherical Harmonic Data" (2015): R0 = a, R1 = v / 2.
// Fed with a plain fit to a hemisphere it is too bright, by a sixth under an even sky: layers must be refitted for it (`geomerics`).
#ifndef RNMBAKE_GEOMERICS
#define RNMBAKE_GEOMERICS
#include "rnmbake_types.glsl"
#include "sh2.glsl"

// One colour: E/pi from a and v.
float geomerics_decode1(float a, vec3 v, vec3 n)
{
    float size = length(v);
    if (a <= 0.0) return a;
    float r = 0.5 * size / max(a, 1e-6);
    float q = clamp(0.5 + 0.5 * dot(v, n) / max(size, 1e-6), 0.0, 1.0);
    return a * (1.0 - r) / (1.0 + r) + 2.0 * size * pow(q, 1.0 + 2.0 * r);
}

vec3 geomerics_decode(vec3 l0, vec3 l1x, vec3 l1y, vec3 l1z, vec3 n)
{
    return vec3(geomerics_decode1(l0.x, vec3(l1x.x, l1y.x, l1z.x), n),
                geomerics_decode1(l0.y, vec3(l1x.y, l1y.y, l1z.y), n),
                geomerics_decode1(l0.z, vec3(l1x.z, l1y.z, l1z.z), n));
}

// MonoSH: the same shape for all colours.
vec3 mono_geomerics_decode(vec3 l0, vec3 dir, float range, vec3 n)
{
    return l0 * geomerics_decode1(1.0, range * (2.0 * dir - 1.0), n);
}

#endif
