// lightmap_shadows.glsl - normal mapping shadows under baked light: an extension of rnmbake's own.
// The flat map and the three maps (as they are, not scaled to flat) give a dominant direction for
// normal_shadows.glsl, whose light alone is shadowed.
#ifndef RNMBAKE_LIGHTMAP_SHADOWS
#define RNMBAKE_LIGHTMAP_SHADOWS
#include "rnmbake_types.glsl"
#include "rnm.glsl"

float rnm_luminance(vec3 colour)
{
    return dot(colour, vec3(0.2126, 0.7152, 0.0722));
}

// The layers of sh2.glsl that return all four bakes.
void sh2_fit(vec3 flat_map, vec3 lm0, vec3 lm1, vec3 lm2, out vec3 l0, out vec3 l1x, out vec3 l1y,
             out vec3 l1z)
{
    vec3 mean = (lm0 + lm1 + lm2) / 3.0;
    l1x = 0.81649658 * lm0 - 0.40824829 * (lm1 + lm2);
    l1y = 0.70710678 * (lm1 - lm2);
    l1z = (flat_map - mean) / (1.0 - 0.57735027);
    l0 = flat_map - l1z;
}

// Unit, towards where the light's luminance grows fastest, raised to the horizon where that is below;
// (0, 0, 0) where light comes evenly.
vec3 dominant_direction(vec3 l0, vec3 l1x, vec3 l1y, vec3 l1z)
{
    vec3 towards = vec3(rnm_luminance(l1x), rnm_luminance(l1y), max(rnm_luminance(l1z), 0.0));
    float size = length(towards);
    bool even = size <= max(1e-4 * abs(rnm_luminance(l0)), 1e-12);
    return even ? vec3(0.0, 0.0, 0.0) : towards / size;
}

// E/pi where only the share `left` of the light from `direction` arrives.
vec3 lightmap_shadowed(vec3 l0, vec3 l1x, vec3 l1y, vec3 l1z, vec3 direction, vec3 n, float left)
{
    vec3 nothing = vec3(0.0, 0.0, 0.0);
    vec3 all = max(l0 + n.x * l1x + n.y * l1y + n.z * l1z, nothing);
    vec3 along = max(direction.x * l1x + direction.y * l1y + direction.z * l1z, nothing) * dot(direction, n);
    return all - (1.0 - left) * clamp(along, nothing, all);
}

#endif
