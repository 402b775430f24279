// tangent_space.glsl - normals out of normal maps, the switch of the green channel, and the way to the world.
#ifndef RNMBAKE_TANGENT_SPACE
#define RNMBAKE_TANGENT_SPACE
#include "rnmbake_types.glsl"

// The same direction where y points the other way (green of a normal map up: Blender, glTF, Unity, Godot;
// down: Unreal, Source). Its own inverse.
vec3 tangent_flip_green(vec3 n)
{
    return vec3(n.x, -n.y, n.z);
}

// A normal map's texel. green: 1 where it points up, -1 where it points down; the result has y up.
vec3 normal_map_unpack(vec3 texel, float green)
{
    return (2.0 * texel - 1.0) * vec3(1.0, green, 1.0);
}

// Of a map with x and y alone (BC5): z follows from the unit length.
vec3 normal_map_unpack2(vec2 texel, float green)
{
    vec2 xy = (2.0 * texel - 1.0) * vec2(1.0, green);
    return vec3(xy, sqrt(max(1.0 - dot(xy, xy), 0.0)));
}

// handedness: the sign in the tangent's fourth component (MikkTSpace).
vec3 tangent_to_world(vec3 n, vec3 tangent, float handedness, vec3 normal)
{
    return normalize(n.x * tangent + n.y * handedness * cross(normal, tangent) + n.z * normal);
}

// The i-th coefficient of sh3.glsl for the other way of y: those that are odd in it change their sign.
vec3 sh3_flip_green(vec3 coefficient, int i)
{
    return i == 1 || i == 4 || i == 5 ? -coefficient : coefficient;
}

#endif
