// The light of a page on a model whose UVs are the page's, for screenspace_general. What stands above is the decoder.
sampler Rnm0 : register(s0);       // $basetexture
sampler Rnm1 : register(s1);       // $texture1
sampler Rnm2 : register(s2);       // $texture2
sampler NormalMap : register(s3);  // $texture3, green down
const float4 Albedo : register(c0);     // $c0_x to $c0_z: linear, of the whole surface
const float4 HdrScales : register(c30); // x: of the tone mapping

float4 main(float2 uv : TEXCOORD0) : COLOR
{
    float3 n = normalize(2.0 * tex2D(NormalMap, uv).rgb - 1.0);
    n.y *= page_green;
    float3 light = rnm_decode_squared(tex2D(Rnm0, uv).rgb, tex2D(Rnm1, uv).rgb, tex2D(Rnm2, uv).rgb, n);
    return float4(light * Albedo.rgb * HdrScales.x, 1.0);
}
