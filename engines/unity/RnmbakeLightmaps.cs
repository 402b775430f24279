// Shows the lightmaps of lightmaps.json on the objects of scene.glb. Unity keeps a renderer's lightmap for what it
// has baked itself alone, so this component sets them whenever it is enabled, in the editor and in the game.
//
// Tools > rnmbake > Add the lightmapped scene puts it to work; by hand: put it on the scene that was imported from
// scene.glb, and fill its fields with lightmaps.json and the pages in their order.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Rnmbake {
    [ExecuteAlways]
    [DisallowMultipleComponent]
    public class RnmbakeLightmaps : MonoBehaviour {
        [Serializable]
        private class Placed {
            public string name;  // of the node, which importers keep
            public int page;
        }

        [Serializable]
        private class Document {
            public int schema_version;
            public Placed[] objects;
        }

        [Tooltip("lightmaps.json")]
        public TextAsset record;

        [Tooltip("page0.l0.exr, page1.l0.exr, ...")]
        public Texture2D[] light = new Texture2D[0];

        [Tooltip("page0.dir.png, page1.dir.png, ...; none for light without directions")]
        public Texture2D[] direction = new Texture2D[0];

        private int first = -1;

        private void OnEnable() {
            if (record == null || light.Length == 0) return;
            first = AddPages();
            var pages = new Dictionary<string, int>();
            foreach (Placed placed in JsonUtility.FromJson<Document>(record.text).objects)
                pages[placed.name] = placed.page;
            foreach (Renderer lit in GetComponentsInChildren<Renderer>(true)) {
                int page;
                if (!pages.TryGetValue(lit.name, out page) && !pages.TryGetValue(NameAbove(lit), out page)) continue;
                lit.lightmapIndex = first + page;
                lit.lightmapScaleOffset = new Vector4(1, 1, 0, 0);  // the second UV set is the page's own already
            }
        }

        // Frees nothing but the references: other scenes' indices stay what they are.
        private void OnDisable() {
            LightmapData[] all = LightmapSettings.lightmaps;
            for (int page = 0; first >= 0 && page < light.Length && first + page < all.Length; page++)
                all[first + page] = new LightmapData();
            if (first >= 0) LightmapSettings.lightmaps = all;
            first = -1;
        }

        // Some importers make an object of its own of each material's part of a mesh, below the node.
        private static string NameAbove(Renderer lit) {
            return lit.transform.parent == null ? "" : lit.transform.parent.name;
        }

        private int AddPages() {
            var all = new List<LightmapData>(LightmapSettings.lightmaps);
            int begin = all.Count;
            for (int page = 0; page < light.Length; page++) {
                var data = new LightmapData();
                data.lightmapColor = light[page];
                if (page < direction.Length) data.lightmapDir = direction[page];
                all.Add(data);
            }
            if (direction.Length > 0) LightmapSettings.lightmapsMode = LightmapsMode.CombinedDirectional;
            LightmapSettings.lightmaps = all.ToArray();
            return begin;
        }
    }
}
