// Lightmaps of scene.glb for Bevy 0.17 and newer. In main():
//
//     mod rnmbake_lightmaps;
//     app.add_plugins(rnmbake_lightmaps::LightmapsPlugin { folder: "level", exposure: 1000.0 });
//
// and, in a startup system,
//
//     commands.spawn(SceneRoot(assets.load(GltfAssetLabel::Scene(0).from_asset("level/scene.glb"))));
//
// `folder` is where scene.glb and the pages lie below assets/; "" for assets/ itself. Pages hold E/pi in the
// units of the baked scene; `exposure` is what 1 of them is in cd/m2, beside your lamps. Nodes are told by their
// names: one of LIGHTMAPPED in another scene gets a lightmap, too.
use bevy::pbr::Lightmap;
use bevy::prelude::*;

pub struct LightmapsPlugin {
    pub folder: &'static str,
    pub exposure: f32,
}

#[derive(Resource)]
struct LightmapPages {
    images: Vec<Handle<Image>>,
    exposure: f32,
}

impl Plugin for LightmapsPlugin {
    fn build(&self, app: &mut App) {
        let assets = app.world().resource::<AssetServer>();
        let below = if self.folder.is_empty() { "" } else { "/" };
        let images = PAGES
            .iter()
            .map(|page| assets.load(format!("{}{below}{page}", self.folder)))
            .collect();
        app.insert_resource(LightmapPages {
            images,
            exposure: self.exposure,
        })
        .add_systems(Update, light_new_meshes);
    }
}

// A node's meshes are its children, one for each material.
fn light_new_meshes(
    mut commands: Commands,
    pages: Res<LightmapPages>,
    meshes: Query<(Entity, &ChildOf, &MeshMaterial3d<StandardMaterial>), Added<Mesh3d>>,
    names: Query<&Name>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    for (entity, child_of, material) in &meshes {
        let Ok(name) = names.get(child_of.parent()) else {
            continue;
        };
        let Some((_, page)) = LIGHTMAPPED.iter().find(|(node, _)| *node == name.as_str()) else {
            continue;
        };
        #[allow(unused_mut)]
        if let Some(mut material) = materials.get_mut(&material.0) {
            material.lightmap_exposure = pages.exposure;
        }
        commands.entity(entity).insert(Lightmap {
            image: pages.images[*page].clone(),
            uv_rect: Rect::new(0.0, 0.0, 1.0, 1.0), // UV_1 of scene.glb is the page's already
            bicubic_sampling: false,
        });
    }
}

