// sg.glsl - six spherical Gaussians over the upper hemisphere, sg0..sg5, by the irradiance of each.
// Hill's fit, in Pettineo, "SG Series Part 3: Diffuse Lighting From an SG Light Source" (2016).
// Lobes exp(sharpness (D . axis - 1)) of sharpness 4.42598544. n: unit normal in tangent space.
#ifndef RNMBAKE_SG
#define RNMBAKE_SG
#include "rnmbake_types.glsl"

// E/pi of a lobe for the cosine between its axis and the normal. Hill's fit with numbers in place of the
// sharpness: a bent cosine, a parabola about the terminator and the cosine itself where it is bright.
float sg_irradiance(float cosine)
{
    float slope = 0.36 * cosine;
    float terminator = slope + 0.32988098;
    float bent = abs(slope) <= 0.32988098 ? terminator * terminator * 2.10513634 : max(cosine, 0.0);
    return 0.34985972 * bent + 0.00114188;
}

// Axes: the normal of the surface, and five around it, 65 degrees off.
vec3 sg_decode(vec3 sg[6], vec3 n)
{
    vec3 light = sg_irradiance(n.z) * sg[0];
    light += sg_irradiance(dot(n, vec3( 0.90630779,  0.0,        0.42261826))) * sg[1];
    light += sg_irradiance(dot(n, vec3( 0.28006451,  0.86194993, 0.42261826))) * sg[2];
    light += sg_irradiance(dot(n, vec3(-0.73321840,  0.53271435, 0.42261826))) * sg[3];
    light += sg_irradiance(dot(n, vec3(-0.73321840, -0.53271435, 0.42261826))) * sg[4];
    light += sg_irradiance(dot(n, vec3( 0.28006451, -0.86194993, 0.42261826))) * sg[5];
    return light;
}

#endif
