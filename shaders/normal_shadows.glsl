// normal_shadows.glsl - shadows that a bumpy surface casts on itself, out of its normal map alone.
// Boris Vorontsov, "Normal Mapping Shadows" (2020). Normals are walked towards the light; what they rise over
// its ray is summed. Published: 32 steps, a walk of 0.22 of the map, hardness 50 * 0.22.
#ifndef RNMBAKE_NORMAL_SHADOWS
#define RNMBAKE_NORMAL_SHADOWS
#include "rnmbake_types.glsl"
#include "tangent_space.glsl"

vec3 normal_shadow_at(RNM_SAMPLER2D(normal_map), vec2 uv, float green)
{
    return normal_map_unpack(RNM_SAMPLE(normal_map, uv).xyz, green);
}

// The share of the light that is left, 0 to 1. light: unit, towards it, tangent space, y up. green: 1 where
// that of the normal map points up, else -1. walk: UVs along x and y for a light in the surface's plane;
// (0.22, -0.22) where v runs down the picture, (0.22, 0.22) where it runs up. jitter: 0 to 1, noise of a
// pixel that turns bands into grain; 0 for none.
float normal_shadow(RNM_SAMPLER2D(normal_map), vec2 uv, float green, vec3 light, vec2 walk, int steps,
                    float hardness, float jitter)
{
    float slope = -dot(light, normal_shadow_at(RNM_ARGUMENT(normal_map), uv, green));
    float steepest = 0.0;
    float shadow = 0.0;
    if (slope >= 0.0) return 1.0; // faces away: nothing to shadow
    for (int i = 1; i <= steps; ++i) {
        float t = (float(i) - jitter) / float(steps);
        slope -= dot(light, normal_shadow_at(RNM_ARGUMENT(normal_map), uv + t * walk * light.xy, green));
        if (slope > steepest) {
            shadow += hardness * (1.0 - t);
            steepest = slope;
        }
    }
    return clamp(1.0 - shadow / float(steps), 0.0, 1.0);
}

// 0 or 1, and over at the first step that rises over the ray.
float normal_shadow_hard(RNM_SAMPLER2D(normal_map), vec2 uv, float green, vec3 light, vec2 walk, int steps,
                         float jitter)
{
    float slope = -dot(light, normal_shadow_at(RNM_ARGUMENT(normal_map), uv, green));
    if (slope >= 0.0) return 1.0;
    for (int i = 1; i <= steps; ++i) {
        float t = (float(i) - jitter) / float(steps);
        slope -= dot(light, normal_shadow_at(RNM_ARGUMENT(normal_map), uv + t * walk * light.xy, green));
        if (slope > 0.0) return 0.0;
    }
    return 1.0;
}

#endif
