// sh2.glsl - light that is linear in the normal (spherical harmonics of two bands, "L1"): E/pi = a + v . n.
// Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps" (2001).
// l0: a of each colour; l1x, l1y, l1z: v. n: unit normal in the space that the layers are in. The result is
// negative where the lobe is: clamp it.
#ifndef RNMBAKE_SH2
#define RNMBAKE_SH2
#include "rnmbake_types.glsl"

vec3 sh2_decode(vec3 l0, vec3 l1x, vec3 l1y, vec3 l1z, vec3 n)
{
    return l0 + n.x * l1x + n.y * l1y + n.z * l1z;
}

// v along one axis out of what a packed layer t1x, t1y, t1z stores: t = 1/2 + v / (2 K a).
// range: K, 2 for Bakery and MonoSH, 4 for Godot.
vec3 packed_sh2_unpack(vec3 l0, vec3 t, float range)
{
    return (2.0 * t - 1.0) * range * l0;
}

vec3 packed_sh2_decode(vec3 l0, vec3 tx, vec3 ty, vec3 tz, float range, vec3 n)
{
    return sh2_decode(l0, packed_sh2_unpack(l0, tx, range), packed_sh2_unpack(l0, ty, range),
                      packed_sh2_unpack(l0, tz, range), n);
}

// One direction map for all colours (MonoSH): dir holds t of x, y and z.
vec3 mono_sh2_decode(vec3 l0, vec3 dir, float range, vec3 n)
{
    return l0 * (1.0 + range * dot(2.0 * dir - 1.0, n));
}

#endif
