// fake_specular.glsl - a baked cube map as the reflection of whatever light a lightmap says is there.
// The cube was rendered once, under some light; scaled by the decoded light it takes that light's strength and
// colour, and masked by it there are no reflections in the dark.
#ifndef RNMBAKE_FAKE_SPECULAR
#define RNMBAKE_FAKE_SPECULAR
#include "rnmbake_types.glsl"

// Where to look into the cube. view: unit, from the surface to the eye; n in the same space.
vec3 fake_specular_direction(vec3 view, vec3 n)
{
    return 2.0 * dot(n, view) * n - view;
}

// cube: its value there, over its mean. light: the decoded E/pi. dark, bright: luminances of the light below
// which there is no reflection, and above which there is all of it.
vec3 fake_specular(vec3 cube, vec3 light, float dark, float bright)
{
    float luminance = dot(light, vec3(0.2126, 0.7152, 0.0722));
    return cube * light * smoothstep(dark, bright, luminance);
}

#endif
