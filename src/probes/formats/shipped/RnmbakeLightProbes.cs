// Puts light probes of light_probes_unity.json, beside this script, into the open scene. Put both into an
// Editor folder of the project, then
//   1. Tools > rnmbake > Place light probes, which makes a Light Probe Group for each volume;
//   2. Window > Rendering > Lighting > Generate Lighting, as only Unity makes tetrahedra of them: with the least
//      samples, what it bakes into the probes is overwritten;
//   3. Tools > rnmbake > Light the probes.
using System;
using System.Collections.Generic;
using System.IO;
using UnityEditor;
using UnityEngine;
using UnityEngine.Rendering;

namespace Rnmbake {
    public static class RnmbakeLightProbes {
        [Serializable]
        private class Volume {
            public string name;
            public float[] positions;     // x, y, z of each probe, world space
            public float[] coefficients;  // RGB of nine coefficients of each, as SphericalHarmonicsL2 has them
        }

        [Serializable]
        private class Document {
            public int version;
            public Volume[] volumes;
        }

        // Places that Unity hands back are those that it was given, but for float rounding.
        private const float CellSize = 0.01f;

        [MenuItem("Tools/rnmbake/Place light probes")]
        private static void Place() {
            foreach (Volume volume in Load().volumes) {
                var made = new GameObject("Probes " + volume.name);
                Undo.RegisterCreatedObjectUndo(made, "Place light probes");
                var group = made.AddComponent<LightProbeGroup>();
                var places = new Vector3[volume.positions.Length / 3];
                for (int i = 0; i < places.Length; i++) places[i] = PlaceOf(volume, i);
                group.probePositions = places;
            }
        }

        [MenuItem("Tools/rnmbake/Light the probes")]
        private static void Light() {
            LightProbes probes = LightmapSettings.lightProbes;
            if (probes == null) {
                Debug.LogError("rnmbake: the scene has no light probes yet: place them, then Generate Lighting");
                return;
            }
            var known = new Dictionary<Vector3Int, List<KeyValuePair<Vector3, SphericalHarmonicsL2>>>();
            foreach (Volume volume in Load().volumes) {
                for (int i = 0; i < volume.positions.Length / 3; i++) {
                    Vector3 place = PlaceOf(volume, i);
                    Vector3Int cell = CellOf(place);
                    if (!known.ContainsKey(cell)) known[cell] = new List<KeyValuePair<Vector3, SphericalHarmonicsL2>>();
                    known[cell].Add(new KeyValuePair<Vector3, SphericalHarmonicsL2>(place, LightOf(volume, i)));
                }
            }
            SphericalHarmonicsL2[] light = probes.bakedProbes;
            Vector3[] places = probes.positions;
            int lit = 0;
            for (int i = 0; i < places.Length; i++) {
                if (Nearest(known, places[i], out SphericalHarmonicsL2 found)) {
                    light[i] = found;
                    lit++;
                }
            }
            probes.bakedProbes = light;
            EditorUtility.SetDirty(probes);
            AssetDatabase.SaveAssets();
            Debug.Log("rnmbake: lit " + lit + " of " + places.Length + " light probes");
        }

        private static bool Nearest(Dictionary<Vector3Int, List<KeyValuePair<Vector3, SphericalHarmonicsL2>>> known,
                                    Vector3 place, out SphericalHarmonicsL2 light) {
            light = new SphericalHarmonicsL2();
            float least = CellSize;
            bool found = false;
            Vector3Int cell = CellOf(place);
            for (int x = -1; x <= 1; x++)
            for (int y = -1; y <= 1; y++)
            for (int z = -1; z <= 1; z++) {
                if (!known.TryGetValue(cell + new Vector3Int(x, y, z), out var candidates)) continue;
                foreach (var candidate in candidates) {
                    float distance = Vector3.Distance(candidate.Key, place);
                    if (distance >= least) continue;
                    least = distance;
                    light = candidate.Value;
                    found = true;
                }
            }
            return found;
        }

        private static Vector3Int CellOf(Vector3 place) {
            return Vector3Int.FloorToInt(place / CellSize);
        }

        private static Vector3 PlaceOf(Volume volume, int probe) {
            return new Vector3(volume.positions[3 * probe], volume.positions[3 * probe + 1], volume.positions[3 * probe + 2]);
        }

        private static SphericalHarmonicsL2 LightOf(Volume volume, int probe) {
            var light = new SphericalHarmonicsL2();
            for (int k = 0; k < 9; k++)
                for (int channel = 0; channel < 3; channel++)
                    light[channel, k] = volume.coefficients[27 * probe + 3 * k + channel];
            return light;
        }

        private static Document Load() {
            string[] scripts = AssetDatabase.FindAssets("RnmbakeLightProbes t:MonoScript");
            string folder = Path.GetDirectoryName(AssetDatabase.GUIDToAssetPath(scripts[0]));
            return JsonUtility.FromJson<Document>(File.ReadAllText(Path.Combine(folder, "light_probes_unity.json")));
        }
    }
}
