// ssbump.wgsl - ssbump.glsl in WGSL. s: the map's channels, right-handed, scale "third".

fn ssbump_decode(s: vec3<f32>, lm0: vec3<f32>, lm1: vec3<f32>, lm2: vec3<f32>) -> vec3<f32> {
    return s.x * lm0 + s.y * lm1 + s.z * lm2;
}

// A dynamic light towards l (unit, tangent space): 1 for one straight above in the open.
fn ssbump_light(s: vec3<f32>, l: vec3<f32>) -> f32 {
    return clamp(1.7320508 * dot(s, rnm_dots(l)), 0.0, 1.0);
}

// The normal for reflections: where most of the open sky is.
fn ssbump_bent_normal(s: vec3<f32>) -> vec3<f32> {
    let sum = rnm_sum(s);
    let square = dot(sum, sum);
    return select(vec3<f32>(0.0, 0.0, 1.0), sum / sqrt(max(square, 1e-20)), square > 0.0);
}
