// ssbump.glsl - self-shadowed bump maps: how much of the light along each basis direction arrives.
// Green, "Efficient Self-Shadowed Radiosity Normal Mapping" (SIGGRAPH 2007). s: the map's three channels,
// right-handed, scale "third" (1/3 each in the open). lm0..lm2: lightmaps scaled to the flat bake.
#ifndef RNMBAKE_SSBUMP
#define RNMBAKE_SSBUMP
#include "rnmbake_types.glsl"
#include "rnm.glsl"

// To scale "third". open: what the file stores in the open, 0.57735 for "ndotb", 0.288675 for "mod2x".
vec3 ssbump_to_third(vec3 stored, float open)
{
    return stored / (3.0 * open);
}

// Between right-handed (y up) and left-handed (y down): upper left and lower left change places.
vec3 ssbump_flip_hand(vec3 s)
{
    return s.xzy;
}

// Light of lightmaps: no squares, no renormalisation.
vec3 ssbump_decode(vec3 s, vec3 lm0, vec3 lm1, vec3 lm2)
{
    return s.x * lm0 + s.y * lm1 + s.z * lm2;
}

// With the fourth channel: what the three maps share counts as coming from straight above.
vec3 ssbump_decode4(vec3 s, float up, vec3 lm0, vec3 lm1, vec3 lm2)
{
    vec3 shared_light = min(lm0, min(lm1, lm2));
    return ssbump_decode(s, lm0 - shared_light, lm1 - shared_light, lm2 - shared_light) + up * shared_light;
}

// A dynamic light towards l (unit, tangent space): 1 for one straight above in the open.
float ssbump_light(vec3 s, vec3 l)
{
    return clamp(1.7320508 * dot(s, rnm_dots(l)), 0.0, 1.0);
}

// The normal for reflections: where most of the open sky is.
vec3 ssbump_bent_normal(vec3 s)
{
    vec3 sum = rnm_sum(s);
    float square = dot(sum, sum);
    return square > 0.0 ? sum / sqrt(square) : vec3(0.0, 0.0, 1.0);
}

// Blinn's highlight about the bent normal, shaded as the diffuse light is. l, view: unit, from the surface.
float ssbump_specular(vec3 s, vec3 l, vec3 view, float exponent)
{
    float along = max(dot(ssbump_bent_normal(s), normalize(l + view)), 0.0);
    return pow(along, exponent) * ssbump_light(s, l);
}

// A detail map over another: all channels by the detail's mean, which leaves the bent normal as it is.
vec3 ssbump_detail(vec3 s, vec3 detail)
{
    return s * (detail.x + detail.y + detail.z);
}

// From one map to another: light is linear in the channels, so it is blended, too.
vec3 ssbump_blend(vec3 from, vec3 to, float amount)
{
    return mix(from, to, amount);
}

#endif
