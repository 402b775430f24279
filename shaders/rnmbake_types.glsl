// rnmbake_types.glsl - lets the other files compile as GLSL, ESSL, and, where RNM_HLSL is defined, as HLSL.
#ifndef RNMBAKE_TYPES
#define RNMBAKE_TYPES

#ifdef RNM_HLSL
#define vec2 float2
#define vec3 float3
#define vec4 float4
#define mix lerp
// Parameters of a function that hold a texture, and its value at a place. No mip level is chosen from
// derivatives, which are undefined within loops.
#define RNM_SAMPLER2D(name) Texture2D name, SamplerState name##_sampler
#define RNM_ARGUMENT(name) name, name##_sampler
#define RNM_SAMPLE(name, uv) name.SampleLevel(name##_sampler, uv, 0.0)
#else
#define RNM_SAMPLER2D(name) sampler2D name
#define RNM_ARGUMENT(name) name
#define RNM_SAMPLE(name, uv) textureLod(name, uv, 0.0)
#endif

#endif
