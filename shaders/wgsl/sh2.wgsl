// sh2.wgsl - sh2.glsl in WGSL: light that is linear in the normal, E/pi = a + v . n; clamp it.

fn sh2_decode(l0: vec3<f32>, l1x: vec3<f32>, l1y: vec3<f32>, l1z: vec3<f32>, n: vec3<f32>) -> vec3<f32> {
    return l0 + n.x * l1x + n.y * l1y + n.z * l1z;
}

// v along one axis out of t = 1/2 + v / (2 K a); range is K.
fn packed_sh2_unpack(l0: vec3<f32>, t: vec3<f32>, range: f32) -> vec3<f32> {
    return (2.0 * t - 1.0) * range * l0;
}

// One direction map for all colours.
fn mono_sh2_decode(l0: vec3<f32>, dir: vec3<f32>, range: f32, n: vec3<f32>) -> vec3<f32> {
    return l0 * (1.0 + range * dot(2.0 * dir - 1.0, n));
}
