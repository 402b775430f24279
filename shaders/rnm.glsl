// rnm.glsl - the Half-Life 2 basis (radiosity normal mapping), and the ways the field decodes its three maps.
// McTaggart, "Half-Life 2 / Valve Source Shading" (GDC 2004). Light is E/pi: multiply it by the albedo.
// n: unit normal in tangent space, y up. lm0..lm2: the layers rnm0..rnm2.
#ifndef RNMBAKE_RNM
#define RNMBAKE_RNM
#include "rnmbake_types.glsl"

// The dot products of a vector with the three directions of the basis.
vec3 rnm_dots(vec3 v)
{
    return vec3(dot(v, vec3( 0.81649658,  0.0,        0.57735027)),
                dot(v, vec3(-0.40824829,  0.70710678, 0.57735027)),
                dot(v, vec3(-0.40824829, -0.70710678, 0.57735027)));
}

// The way back, as the basis is orthonormal: sum of w_i B_i.
vec3 rnm_sum(vec3 w)
{
    return w.x * vec3( 0.81649658,  0.0,        0.57735027) +
           w.y * vec3(-0.40824829,  0.70710678, 0.57735027) +
           w.z * vec3(-0.40824829, -0.70710678, 0.57735027);
}

// Source's decode, corrected: of the conventions `rnm` and `rnm-vrad`.
vec3 rnm_decode_squared(vec3 lm0, vec3 lm1, vec3 lm2, vec3 n)
{
    vec3 w = max(rnm_dots(n), vec3(0.0, 0.0, 0.0));
    w *= w;
    return (w.x * lm0 + w.y * lm1 + w.z * lm2) / max(w.x + w.y + w.z, 1e-6);
}

// Not renormalised: of the conventions `rnm-signed` (BakingLab) and `rnm-bakery` (Bakery, many engines).
vec3 rnm_decode_linear(vec3 lm0, vec3 lm1, vec3 lm2, vec3 n)
{
    vec3 w = max(rnm_dots(n), vec3(0.0, 0.0, 0.0));
    return w.x * lm0 + w.y * lm1 + w.z * lm2;
}

// What vrad makes of the maps before they are stored: times this, a flat normal decodes to the flat map.
vec3 rnm_scale_to_flat(vec3 flat_map, vec3 lm0, vec3 lm1, vec3 lm2)
{
    return 3.0 * flat_map / max(lm0 + lm1 + lm2, vec3(1e-6, 1e-6, 1e-6));
}

#endif
