// For Unity: what the material properties of Bakery and of Unity's own lightmaps hold, decoded to E/pi.
// normalWorld, normalTangent: unit. unity_Lightmap must be decoded (DecodeLightmap) where it is packed.
#ifndef RNMBAKE_UNITY
#define RNMBAKE_UNITY

#ifdef RNMBAKE_RNM
// bakeryLightmapMode 3: _RNM0, _RNM1, _RNM2. Of maps of the convention `rnm-bakery`.
float3 rnmbake_unity_rnm(float3 rnm0, float3 rnm1, float3 rnm2, float3 normalTangent)
{
    return rnm_decode_linear(rnm0, rnm1, rnm2, normalTangent);
}
#endif

#ifdef RNMBAKE_SH2
// bakeryLightmapMode 4 (SH): unity_Lightmap is L0; _RNM0, _RNM1, _RNM2 are L1 along the world's x, y, z.
float3 rnmbake_unity_sh(float3 lightmapColor, float3 rnm0, float3 rnm1, float3 rnm2, float3 normalWorld)
{
    return max(packed_sh2_decode(lightmapColor, rnm0, rnm1, rnm2, 2.0, normalWorld), 0.0);
}

// bakeryLightmapMode 6 (MonoSH): unity_Lightmap is L0, unity_LightmapInd the direction map.
float3 rnmbake_unity_monosh(float3 lightmapColor, float3 lightmapDir, float3 normalWorld)
{
    return max(mono_sh2_decode(lightmapColor, lightmapDir, 2.0, normalWorld), 0.0);
}
#endif

#ifdef RNMBAKE_ZH3
// MonoSH whose maps were refitted for ZH3.
float3 rnmbake_unity_monosh_zh3(float3 lightmapColor, float3 lightmapDir, float3 normalWorld)
{
    return max(mono_zh3_decode(lightmapColor, lightmapDir, 2.0, normalWorld), 0.0);
}
#endif

#ifdef RNMBAKE_GEOMERICS
// MonoSH whose maps were refitted for the non-linear decode of Bakery's shader.
float3 rnmbake_unity_monosh_geomerics(float3 lightmapColor, float3 lightmapDir, float3 normalWorld)
{
    return max(mono_geomerics_decode(lightmapColor, lightmapDir, 2.0, normalWorld), 0.0);
}
#endif

#ifdef RNMBAKE_DIRECTIONS
// Unity's own directional lightmaps: unity_Lightmap and unity_LightmapInd.
float3 rnmbake_unity_dominant(float3 lightmapColor, float4 lightmapDir, float3 normalWorld)
{
    return dominant_decode(lightmapColor, lightmapDir.xyz, lightmapDir.w, normalWorld);
}
#endif

#endif
