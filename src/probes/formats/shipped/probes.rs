// Boxes of light probes for Bevy 0.17 and newer. Call spawn_probe_volumes() once the scene is there:
//
//     mod probes;
//     probes::spawn_probe_volumes(&mut commands, &assets, "probes", 1000.0);
//
// `folder` is where the .vxgi.ktx2 files lie below assets/. They hold E/pi in the units of the baked scene;
// `intensity` is what 1 of them is in cd/m2, as for lights and lightmaps of the same scene.
use bevy::light::{IrradianceVolume, LightProbe};
use bevy::prelude::*;

pub struct BakedVolume {
    pub voxels: &'static str,
    pub translation: Vec3,
    pub rotation: Quat,
    pub scale: Vec3,
}

pub fn spawn_probe_volumes(commands: &mut Commands, assets: &AssetServer, folder: &str, intensity: f32) {
    for volume in &BAKED_VOLUMES {
        commands.spawn((
            LightProbe::default(),
            IrradianceVolume {
                voxels: assets.load(format!("{folder}/{}", volume.voxels)),
                intensity,
                ..default()
            },
            Transform {
                translation: volume.translation,
                rotation: volume.rotation,
                scale: volume.scale,
            },
        ));
    }
}

