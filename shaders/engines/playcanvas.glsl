// For PlayCanvas: a chunk of functions, to be called from a chunk of your own in place of lightmapPS.
#ifndef RNMBAKE_PLAYCANVAS
#define RNMBAKE_PLAYCANVAS

#ifdef RNMBAKE_DIRECTIONS
// PlayCanvas's own pair texture_lightMap and texture_dirLightMap: its direction points from the light.
// n: the shaded normal, vertexNormal: the mesh's; both unit, world space.
vec3 rnmbake_playcanvas_dir(vec3 lightMap, vec3 dirLightMap, vec3 n, vec3 vertexNormal)
{
    vec3 d = 2.0 * dirLightMap - 1.0;
    return lightMap * clamp(dot(d, -n), 0.0, 1.0) / max(clamp(dot(d, -vertexNormal), 0.0, 1.0), 0.01);
}
#endif

#endif
