// zh3.glsl - the numbers of sh2.glsl with a quadratic lobe guessed from them.
// Roughton, Sloan, Silvennoinen, Iwanicki, Shirley, "ZH3: Quadratic Zonal Harmonics" (i3D 2024).
// Fed with a plain fit to a hemisphere it is too bright: layers must be refitted for it (`zh3`).
// The result may be negative: clamp it.
#ifndef RNMBAKE_ZH3
#define RNMBAKE_ZH3
#include "rnmbake_types.glsl"
#include "sh2.glsl"

// One colour: E/pi from a and v.
float zh3_decode1(float a, vec3 v, vec3 n)
{
    float size = length(v);
    float rho = a > 0.0 ? min(0.8660254 * size / max(a, 1e-6), 1.7320508) : 0.0;
    float along = dot(v, n) / max(size, 1e-6);
    float lobe = 0.27950850 * a * rho * (0.08 + 0.6 * rho) * (3.0 * along * along - 1.0);
    return a + dot(v, n) + lobe;
}

vec3 zh3_decode(vec3 l0, vec3 l1x, vec3 l1y, vec3 l1z, vec3 n)
{
    return vec3(zh3_decode1(l0.x, vec3(l1x.x, l1y.x, l1z.x), n),
                zh3_decode1(l0.y, vec3(l1x.y, l1y.y, l1z.y), n),
                zh3_decode1(l0.z, vec3(l1x.z, l1y.z, l1z.z), n));
}

// MonoSH: the same shape for all colours.
vec3 mono_zh3_decode(vec3 l0, vec3 dir, float range, vec3 n)
{
    return l0 * zh3_decode1(1.0, range * (2.0 * dir - 1.0), n);
}

#endif
