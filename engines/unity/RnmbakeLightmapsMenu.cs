// Tools > rnmbake > Add the lightmapped scene: select lightmaps.json first.
#if UNITY_EDITOR
using System.Collections.Generic;
using System.IO;
using UnityEditor;
using UnityEngine;

namespace Rnmbake {
    public static class RnmbakeLightmapsMenu {
        private const string Item = "Tools/rnmbake/Add the lightmapped scene";

        [MenuItem(Item, true)]
        private static bool CanAdd() {
            return Path.GetFileName(AssetDatabase.GetAssetPath(Selection.activeObject)) == "lightmaps.json";
        }

        [MenuItem(Item)]
        private static void Add() {
            string record = AssetDatabase.GetAssetPath(Selection.activeObject);
            string folder = Path.GetDirectoryName(record).Replace('\\', '/');
            var scene = AssetDatabase.LoadAssetAtPath<GameObject>(folder + "/scene.glb");
            if (scene == null) {
                Debug.LogError("rnmbake: Unity has not imported " + folder
                        + "/scene.glb; install the package com.unity.cloud.gltfast");
                return;
            }
            var made = (GameObject)PrefabUtility.InstantiatePrefab(scene);
            Undo.RegisterCreatedObjectUndo(made, "Add the lightmapped scene");
            made.SetActive(false);
            var lightmaps = made.AddComponent<RnmbakeLightmaps>();
            lightmaps.record = AssetDatabase.LoadAssetAtPath<TextAsset>(record);
            lightmaps.light = Pages(folder, "{0}/page{1}.l0.exr");
            if (lightmaps.light.Length == 0) lightmaps.light = Pages(folder, "{0}/page{1}.flat.exr");
            lightmaps.direction = Pages(folder, "{0}/page{1}.dir.png");
            made.SetActive(true);
            EditorUtility.SetDirty(lightmaps);
        }

        private static Texture2D[] Pages(string folder, string name) {
            var found = new List<Texture2D>();
            while (true) {
                var page = AssetDatabase.LoadAssetAtPath<Texture2D>(string.Format(name, folder, found.Count));
                if (page == null) return found.ToArray();
                found.Add(page);
            }
        }
    }
}
#endif
