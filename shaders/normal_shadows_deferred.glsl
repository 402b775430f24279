// normal_shadows_deferred.glsl - the same shadows in screen space, out of a G-buffer's normals and depths.
// Boris Vorontsov, "Normal Mapping Shadows" (2020), deferred: each increment is scaled by a depth test, so
// that what lies before or behind the surface casts nothing.
#ifndef RNMBAKE_NORMAL_SHADOWS_DEFERRED
#define RNMBAKE_NORMAL_SHADOWS_DEFERRED
#include "rnmbake_types.glsl"
#include "tangent_space.glsl"

// The share of the light that is left, 0 to 1. normals: view space, packed to 0..1. depths: linear, in x.
// light: unit, towards it, view space (x right, y up). walk: UVs along x and y for a light in the screen's
// plane, y negative where v runs down; it should shrink with depth. depth_range: a difference from which on a
// step does not count. jitter: 0 to 1, noise of a pixel; 0 for none.
float normal_shadow_deferred(RNM_SAMPLER2D(normals), RNM_SAMPLER2D(depths), vec2 uv, vec3 light, vec2 walk,
                             float depth_range, int steps, float hardness, float jitter)
{
    float depth = RNM_SAMPLE(depths, uv).x;
    float slope = -dot(light, normal_map_unpack(RNM_SAMPLE(normals, uv).xyz, 1.0));
    float steepest = 0.0;
    float shadow = 0.0;
    if (slope >= 0.0) return 1.0; // faces away: nothing to shadow
    for (int i = 1; i <= steps; ++i) {
        float t = (float(i) - jitter) / float(steps);
        vec2 place = uv + t * walk * light.xy;
        float counts = clamp(1.0 - abs(RNM_SAMPLE(depths, place).x - depth) / depth_range, 0.0, 1.0);
        slope -= counts * dot(light, normal_map_unpack(RNM_SAMPLE(normals, place).xyz, 1.0));
        if (slope > steepest) {
            shadow += hardness * (1.0 - t);
            steepest = slope;
        }
    }
    return clamp(1.0 - shadow / float(steps), 0.0, 1.0);
}

#endif
