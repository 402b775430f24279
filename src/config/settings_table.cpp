#include "config/settings_table.h"

#include "config/setting_row.h"

#include <string_view>

namespace rnmbake {

namespace {

template <typename T>
Row scene(std::string_view key, T SceneSettings::*field, std::string_view help) {
  return {"scene", key, &BakeSettings::scene, field, help};
}
template <typename T>
Row bake(std::string_view key, T BakingSettings::*field, std::string_view help) {
  return {"bake", key, &BakeSettings::bake, field, help};
}
template <typename T>
Row bake(std::string_view key, T ObjectSettings::*field, std::string_view help) {
  return {"bake", key, &BakeSettings::object, field, help};
}
template <typename T>
Row reference(std::string_view key, T ReferenceSettings::*field, std::string_view help) {
  return Row{"reference", key, &BakeSettings::reference, field, help}.only(
      {Purpose::reference, Purpose::validate});
}
template <typename T>
Row output(std::string_view key, T OutputSettings::*field, std::string_view help) {
  return {"output", key, &BakeSettings::output, field, help};
}
template <typename T>
Row output(std::string_view key, T ObjectSettings::*field, std::string_view help) {
  return {"output", key, &BakeSettings::object, field, help};
}
template <typename T>
Row run(std::string_view key, T RunSettings::*field, std::string_view help) {
  return {"run", key, &BakeSettings::run, field, help};
}

}  // namespace

std::vector<Setting> make_settings_table() {
  using Scene = SceneSettings;
  using Bake = BakingSettings;
  using Object = ObjectSettings;
  using Reference = ReferenceSettings;
  using Output = OutputSettings;
  using Run = RunSettings;
  return {
      scene("file", &Scene::file, "scene to bake: .blend, .glb or .gltf").without_effect(),
      scene("scene", &Scene::scene, "scene of the file to bake").empty_means("the one it was saved with"),
      scene("view_layer", &Scene::view_layer, "view layer of the scene to bake")
          .empty_means("the one it was saved with"),
      scene("frame", &Scene::frame, "frame to bake; -1 is the one that the file was saved at")
          .range(-1, 1'048'574),
      scene("objects", &Scene::objects, "names of the objects to bake; * and ? are wildcards"),
      scene("exclude", &Scene::exclude, "names of objects to leave out; they still cast light and shadow"),
      scene("allow_scripts", &Scene::allow_scripts, "let Python scripts and drivers in the scene file run"),
      scene("allow_dark", &Scene::allow_dark, "go on with a scene in which nothing gives light"),
      scene("sky", &Scene::sky,
            "light a scene that brings no light: radiance of a white sky, in place of its world")
          .empty_means("the scene's own world"),
      scene("sun", &Scene::sun,
            "and a sun beside its lamps: AZIMUTH,ELEVATION,STRENGTH in degrees (from +Y over +X, above the "
            "horizon) and W/m2")
          .empty_means("none"),
      scene("materials", &Scene::materials,
            "lambert replaces every material by its own baked albedo and emission")
          .only({Purpose::bake}),

      bake("uv", &Object::uv, "UV layer of the lightmap")
          .empty_means("a layer named Lightmap, UV2 or lightmap, else the second one, else unwrapped"),
      bake("unwrap", &Object::unwrap, "make lightmap UVs: when there are none, never, or always"),
      bake("unwrap_margin", &Object::unwrap_margin,
           "gap between charts that unwrapping leaves, at most 1/16 of the side")
          .range(0, 1024)
          .unit("texels"),
      bake("tangent_uv", &Object::tangent_uv, "UV layer of the normal map; the tangent frame is its own")
          .empty_means("the active-render layer"),
      bake("flip_green", &Object::flip_green, "the engine's normal maps have Y down (Unreal, Source)"),
      bake("resolution", &Object::resolution, "side of each lightmap, rounded up to a multiple of 4")
          .range(4, 16384)
          .unit("texels"),
      bake("texels_per_unit", &Object::texels_per_unit, "choose each object's resolution by its surface")
          .unit("texels per scene unit")
          .empty_means("use resolution"),
      bake("min_resolution", &Object::min_resolution, "least side that texels_per_unit may choose")
          .range(4, 16384)
          .unit("texels"),
      bake("max_resolution", &Object::max_resolution, "greatest side that texels_per_unit may choose")
          .range(4, 16384)
          .unit("texels"),
      bake("bases", &Bake::bases, "directions to bake")
          .empty_means("flat, rnm0, rnm1, rnm2; with a basis set or file: all of its vectors"),
      bake("basis", &Bake::basis, "TOML file with a list of unit vectors to bake instead of RNM's")
          .empty_means("flat and the three vectors of RNM"),
      bake("basis_set", &Bake::basis_set,
           "directions to bake for encodings that want more than RNM's (rnmbake convert --to h6, sg, sh3), "
           "or to study encodings at (rnmbake study)"),
      bake("engine", &Bake::engine,
           "who computes the light: cycles, or embree, faster, of diffuse surfaces alone")
          .only({Purpose::bake}),
      bake("recipe", &Bake::recipe,
           "receiver is exact; gather, too: neighbours share light that bounced, for less noise of single "
           "texels; auto: gather where it is exact; flat-normal-map is the published recipe, uncorrected")
          .only({Purpose::bake}),
      bake("correct_bump", &Bake::correct_bump,
           "flat-normal-map: turn off the bump correction where this Blender lets us")
          .only({Purpose::bake}),
      bake("horizon", &Object::horizon, "corners whose basis normal lies under their face: exact, or clamped")
          .only({Purpose::bake, Purpose::validate}),
      bake("dispatch", &Bake::dispatch,
           "one Blender launch for each object and basis, each object, or the scene")
          .only({Purpose::bake}),
      bake("atlas_limit", &Bake::atlas_limit, "most pixels in one bake call")
          .range(4096, 1'073'741'824)
          .unit("pixels")
          .only({Purpose::bake, Purpose::validate}),
      bake("memory_limit", &Bake::memory_limit, "most memory that one Blender should need")
          .range(0, 16'777'216)
          .unit("MiB")
          .empty_means("from what the machine has free")
          .only({Purpose::bake, Purpose::validate}),
      bake("split", &Object::split, "bake each material slot or loose part as a target of its own"),
      bake("samples", &Object::samples, "paths for each texel and basis").range(1, 16'777'216),
      bake("noise", &Object::noise,
           "bake until the standard error of an object's texels is so small; samples are then the most")
          .range(0, 100)
          .unit("percent of their mean")
          .empty_means("off")
          .only({Purpose::bake}),
      bake("bounces", &Bake::bounces,
           "longest path of light after the first hit; the tracer has no limit unless this is given")
          .range(0, 1024),
      bake("seed", &Object::seed, "noise pattern; the same seed gives the same noise"),
      bake("clamp", &Object::clamp, "cap on the radiance of one sample; biased")
          .empty_means("off")
          .only({Purpose::bake, Purpose::validate}),
      bake("device", &Bake::device, "what Cycles computes on").only({Purpose::bake, Purpose::validate}),

      reference("footprint", &Reference::footprint,
                "what a texel averages over; auto: as the Blender compared with"),
      reference("error", &Reference::error,
                "trace until the standard error of each object's texels is that share of its mean")
          .range(0, 100)
          .unit("percent")
          .empty_means("off; --samples decides"),
      reference("sh", &Reference::sh, "add spherical harmonics of the incoming light, to that order")
          .range(0, 3)
          .empty_means("none")
          .only({Purpose::reference}),
      reference("model", &Reference::model,
                "true is the truth; flat-normal-map makes the errors of the published recipe")
          .only({Purpose::reference}),
      reference("faults", &Reference::faults,
                "flat-normal-map: which of tilt-clamp, bump-shadowing, self-reflection, below-horizon, "
                "no-diffuse; or none")
          .empty_means("all that the Blender version has")
          .only({Purpose::reference}),
      reference("blender_version", &Reference::blender_version,
                "whose footprint, faults and light units, as 3.4.1 or 4.3")
          .empty_means("the Blender that wrote the scene's data")
          .only({Purpose::reference}),

      output("dir", &Output::dir, "folder for lightmaps and manifest.json; made when missing")
          .without_effect(),
      output("layout", &Output::layout, "one EXR with layers for each object, or one EXR for each basis")
          .only({Purpose::bake, Purpose::reference}),
      output("depth", &Output::depth, "half (16 bits) or float (32 bits) for each channel")
          .only({Purpose::bake, Purpose::reference}),
      output("frames", &Output::frames, "add the world-space tangent and normal as layers")
          .only({Purpose::bake, Purpose::reference}),
      output("normalize", &Output::normalize,
             "flat scales the maps so that a flat normal decodes to the flat bake")
          .only({Purpose::bake, Purpose::reference}),
      output("dilate", &Object::dilate, "grow charts into the gaps around them")
          .range(0, 1024)
          .unit("texels"),
      output("repair", &Output::repair, "replace fireflies, NaN and Inf by their neighbours")
          .only({Purpose::bake, Purpose::reference}),
      output("stderr", &Output::standard_errors,
             "layers with the standard error of every texel: with --depth float, never, always")
          .only({Purpose::bake}),
      output("save_scene", &Output::save_scene,
             "save a copy of the scene with the unwrapped UVs: when there are any, never, always")
          .only({Purpose::bake, Purpose::reference}),
      output("keep_temporary", &Output::keep_temporary, "keep what Blender was given and returned")
          .without_effect(),

      run("blender", &Run::blender, "Blender to use: a path or a name in PATH")
          .program()
          .empty_means("PATH and the usual places"),
      run("scripts", &Run::scripts, "folder with the Blender scripts, for development")
          .empty_means("those inside the program"),
      run("jobs", &Run::jobs, "Blender processes at a time")
          .range(0, 1024)
          .empty_means("automatic")
          .only({Purpose::bake, Purpose::validate})
          .without_effect(),
      run("threads", &Run::threads, "threads of each Blender, and of the tracer")
          .range(0, 1024)
          .empty_means("all cores, shared among the jobs")
          .without_effect(),
      run("timeout", &Run::timeout, "end a Blender that makes no progress for so long")
          .range(1, 604'800)
          .unit("seconds")
          .without_effect(),
      run("launch_timeout", &Run::launch_timeout, "end a Blender that takes so long, progress or not")
          .range(0, 31'536'000)
          .unit("seconds")
          .empty_means("no limit")
          .without_effect(),
      run("memory_max", &Run::memory_max, "end a Blender that uses more memory")
          .range(0, 16'777'216)
          .unit("MiB")
          .empty_means("no limit")
          .without_effect(),
      run("sandbox", &Run::sandbox,
          "run Blender without network, home folder and other files (bubblewrap), for scenes of strangers"),
      run("sandbox_read", &Run::sandbox_read,
          "folders beside the scene's that a sandboxed Blender may read: libraries, pictures")
          .empty_means("the scene's alone"),
      run("time", &Run::time, "bake the best that fits: 90s, 10m, 2h; samples are then the most")
          .empty_means("as long as it takes")
          .only({Purpose::bake}),
      run("retries", &Run::retries, "times that a failed launch is tried again")
          .range(0, 100)
          .only({Purpose::bake, Purpose::validate})
          .without_effect(),
      run("cache", &Run::cache, "folder for results that later runs need not make again; none keeps nothing")
          .no_path(no_cache)
          .empty_means("$XDG_CACHE_HOME/rnmbake, else ~/.cache/rnmbake")
          .without_effect(),
      run("cache_limit", &Run::cache_limit, "what was not used for longest goes when the cache is larger")
          .range(0, 1'073'741'824)
          .unit("MiB")
          .empty_means("no limit")
          .without_effect(),
      run("lock_wait", &Run::lock_wait, "wait so long for another run that writes to the same folder")
          .range(0, 31'536'000)
          .unit("seconds")
          .without_effect(),
  };
}

}  // namespace rnmbake
