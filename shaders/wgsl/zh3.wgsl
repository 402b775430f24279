// zh3.wgsl - zh3.glsl in WGSL: the numbers of sh2.wgsl with a quadratic lobe guessed from them; clamp it.

// One colour: E/pi from a and v.
fn zh3_decode1(a: f32, v: vec3<f32>, n: vec3<f32>) -> f32 {
    let size = length(v);
    let rho = select(0.0, min(0.8660254 * size / max(a, 1e-6), 1.7320508), a > 0.0);
    let along = dot(v, n) / max(size, 1e-6);
    return a + dot(v, n) + 0.27950850 * a * rho * (0.08 + 0.6 * rho) * (3.0 * along * along - 1.0);
}

fn zh3_decode(l0: vec3<f32>, l1x: vec3<f32>, l1y: vec3<f32>, l1z: vec3<f32>, n: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(zh3_decode1(l0.x, vec3<f32>(l1x.x, l1y.x, l1z.x), n),
                     zh3_decode1(l0.y, vec3<f32>(l1x.y, l1y.y, l1z.y), n),
                     zh3_decode1(l0.z, vec3<f32>(l1x.z, l1y.z, l1z.z), n));
}
