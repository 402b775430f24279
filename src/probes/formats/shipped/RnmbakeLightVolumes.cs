// Makes VRC Light Volumes (version 2) out of the .asset files beside this script. Put the whole folder into an
// Editor folder of the project, then: Tools > rnmbake > Make light volumes. Pack them as usual: on the Light
// Volume Manager, without baking.
using System.IO;
using UnityEditor;
using UnityEngine;
using VRCLightVolumes;

namespace Rnmbake {
    public static class RnmbakeLightVolumes {
        private readonly struct BakedVolume {
            public readonly string Name;
            public readonly Vector3 Centre, Size;
            public readonly Quaternion Rotation;
            public readonly Vector3Int Resolution;

            public BakedVolume(string name, Vector3 centre, Quaternion rotation, Vector3 size, Vector3Int resolution) {
                Name = name;
                Centre = centre;
                Rotation = rotation;
                Size = size;
                Resolution = resolution;
            }
        }

        private static readonly BakedVolume[] Volumes = {
            // volumes
        };

        [MenuItem("Tools/rnmbake/Make light volumes")]
        private static void Make() {
            string[] scripts = AssetDatabase.FindAssets("RnmbakeLightVolumes t:MonoScript");
            string folder = Path.GetDirectoryName(AssetDatabase.GUIDToAssetPath(scripts[0]));
            foreach (BakedVolume baked in Volumes) {
                var made = new GameObject(baked.Name);
                Undo.RegisterCreatedObjectUndo(made, "Make light volumes");
                made.transform.SetPositionAndRotation(baked.Centre, baked.Rotation);
                made.transform.localScale = baked.Size;
                var volume = made.AddComponent<LightVolume>();
                volume.SetupDependencies();
                volume.Bake = false;
                volume.AdaptiveResolution = false;
                volume.Resolution = baked.Resolution;
                volume.Texture0 = Load(folder, baked.Name, 0);
                volume.Texture1 = Load(folder, baked.Name, 1);
                volume.Texture2 = Load(folder, baked.Name, 2);
                // The light is along the world's axes as the volume stands now; turned later, it turns with it.
                volume.LightVolumeInstance.InvBakedRotation = Quaternion.Inverse(baked.Rotation);
                EditorUtility.SetDirty(volume);
                EditorUtility.SetDirty(volume.LightVolumeInstance);
            }
        }

        private static Texture3D Load(string folder, string name, int texture) {
            string path = Path.Combine(folder, name + "_" + texture + ".asset").Replace('\\', '/');
            var found = AssetDatabase.LoadAssetAtPath<Texture3D>(path);
            if (found == null) Debug.LogError("rnmbake: " + path + " is missing or no Texture3D");
            return found;
        }
    }
}
