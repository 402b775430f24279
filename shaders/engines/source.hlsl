// For Source (Direct3D 9): normal maps have y down, and self-shadowed bump maps are left-handed.
#ifndef RNMBAKE_SOURCE
#define RNMBAKE_SOURCE

#ifdef RNMBAKE_RNM
// n: unit, as the normal map has it, y down.
float3 rnmbake_source_rnm(float3 lm0, float3 lm1, float3 lm2, float3 n)
{
    return rnm_decode_squared(lm0, lm1, lm2, float3(n.x, -n.y, n.z));
}
#endif

#ifdef RNMBAKE_SSBUMP
// s: a left-handed map's channels.
float3 rnmbake_source_ssbump(float3 s, float3 lm0, float3 lm1, float3 lm2)
{
    return ssbump_decode(ssbump_flip_hand(s), lm0, lm1, lm2);
}
#endif

#endif
