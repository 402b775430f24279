// rnm.wgsl - rnm.glsl in WGSL: the Half-Life 2 basis and the ways the field decodes its three maps.
// n: unit normal in tangent space, y up. lm0..lm2: the layers rnm0..rnm2 in E/pi.

// The dot products of a vector with the three directions of the basis.
fn rnm_dots(v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(v, vec3<f32>( 0.81649658,  0.0,        0.57735027)),
                     dot(v, vec3<f32>(-0.40824829,  0.70710678, 0.57735027)),
                     dot(v, vec3<f32>(-0.40824829, -0.70710678, 0.57735027)));
}

// The way back, as the basis is orthonormal: sum of w_i B_i.
fn rnm_sum(w: vec3<f32>) -> vec3<f32> {
    return w.x * vec3<f32>( 0.81649658,  0.0,        0.57735027) +
           w.y * vec3<f32>(-0.40824829,  0.70710678, 0.57735027) +
           w.z * vec3<f32>(-0.40824829, -0.70710678, 0.57735027);
}

// Of the conventions `rnm` and `rnm-vrad`.
fn rnm_decode_squared(lm0: vec3<f32>, lm1: vec3<f32>, lm2: vec3<f32>, n: vec3<f32>) -> vec3<f32> {
    let dots = max(rnm_dots(n), vec3<f32>(0.0));
    let w = dots * dots;
    return (w.x * lm0 + w.y * lm1 + w.z * lm2) / max(w.x + w.y + w.z, 1e-6);
}

// Of the conventions `rnm-signed` and `rnm-bakery`.
fn rnm_decode_linear(lm0: vec3<f32>, lm1: vec3<f32>, lm2: vec3<f32>, n: vec3<f32>) -> vec3<f32> {
    let w = max(rnm_dots(n), vec3<f32>(0.0));
    return w.x * lm0 + w.y * lm1 + w.z * lm2;
}
