// For three.js: put this before the fragment shader's main() in onBeforeCompile, and add the result to
// `irradiance` where the chunk lights_fragment_maps stands. three.js multiplies by albedo / pi.
#ifndef RNMBAKE_THREEJS
#define RNMBAKE_THREEJS

#ifdef RNMBAKE_RNM
uniform sampler2D rnmMap0;
uniform sampler2D rnmMap1;
uniform sampler2D rnmMap2;

// uv: the second UV set (vLightMapUv). n: unit, tangent space, y up.
vec3 rnmbake_three_irradiance(vec2 uv, vec3 n)
{
    return 3.14159265 * rnm_decode_squared(texture(rnmMap0, uv).rgb, texture(rnmMap1, uv).rgb,
                                           texture(rnmMap2, uv).rgb, n);
}
#endif

#endif
