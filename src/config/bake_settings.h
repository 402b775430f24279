// config/bake_settings.h - everything that a user can set, as plain structs with the defaults inside.
// Names, ranges and help of each setting stand in config/settings_table.cpp; one line there for each field.
#pragma once

#include "base/numeric/stored_values.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// What an [[override]] may set for some objects only. Where UVs, pixels and light of one target come from.
struct ObjectSettings {
  enum class Unwrap { when_needed, never, always };
  enum class Horizon { identity, clamp };
  enum class Split { none, material, loose };

  std::string uv;  // lightmap UV layer; "": found by its name, else unwrapped
  Unwrap unwrap = Unwrap::when_needed;
  int unwrap_margin = 4;                           // texels between charts
  std::string tangent_uv;                          // "": the active-render layer
  bool flip_green = false;                         // normal maps with Y down
  int resolution = 256;                            // texels along a side, unless texels_per_unit is set
  double texels_per_unit = 0;                      // 0: use resolution
  int min_resolution = 16, max_resolution = 2048;  // limits of what texels_per_unit gives
  Horizon horizon = Horizon::identity;             // corners whose basis normal lies under their face
  Split split = Split::none;
  int samples = 256;
  double noise = 0;  // percent of a target's mean; 0: `samples` decide
  int seed = 0;
  double clamp = 0;  // radiance; 0: off
  int dilate = 4;    // texels; [output] in the project file
};

struct SceneSettings {
  enum class Materials { full, lambert };

  std::filesystem::path file;     // .blend, .glb, .gltf; "" when only a project's settings were asked for
  std::string scene, view_layer;  // names in the file; "": those that the file was saved with
  int frame = -1;                 // -1: the one that the file was saved at
  std::vector<std::string> objects{"*"};
  std::vector<std::string> exclude;
  bool allow_scripts = false;
  bool allow_dark = false;  // nothing in the scene gives light
  double sky = 0;           // radiance from everywhere, in place of the scene's world; 0: its own
  std::string sun;          // a lamp beside the scene's own: config/sun.h; "": none
  Materials materials = Materials::full;
};

struct BakingSettings {
  enum class Engine { cycles, embree };
  enum class Recipe { automatic, receiver, gather, flat_normal_map };
  enum class Dispatch { automatic, basis, object, scene };
  enum class Device { cpu, cuda, optix, hip, metal, oneapi };
  enum class DirectionSet { rnm, l1, h6, sg, sh3, study };

  /// Names out of flat, rnm0, rnm1, rnm2, or out of the basis file or set. Resolved, it is empty only where
  /// one of these is chosen and all of its vectors are wanted.
  std::vector<std::string> bases;
  std::filesystem::path basis;                 // file with a list of unit vectors; "": basis_set
  DirectionSet basis_set = DirectionSet::rnm;  // encoding/direction_sets.h
  Engine engine = Engine::cycles;
  Recipe recipe = Recipe::receiver;
  bool correct_bump = false;  // flat_normal_map only
  Dispatch dispatch = Dispatch::automatic;
  int atlas_limit = 16777216;  // pixels of one bake call
  int memory_limit = 0;        // MiB; 0: from the machine
  int bounces = 32;
  Device device = Device::cpu;
};

/// The traced reference, beside what it shares with a bake.
struct ReferenceSettings {
  enum class Footprint { automatic, centre, half, full };
  enum class Model { truth, flat_normal_map };

  Footprint footprint = Footprint::automatic;
  double error = 0;  // percent of a target's mean; 0: off
  int sh = 0;        // order of the spherical harmonics; 0: none
  Model model = Model::truth;
  std::vector<std::string> faults;  // flat_normal_map: names; none: all that the version has
  std::string blender_version;      // "3.4.1"; "": the one that wrote the scene's data
};

struct OutputSettings {
  enum class Layout { layers, files };
  enum class SaveScene { when_unwrapped, never, always };
  enum class StandardErrors { when_float, never, always };

  std::filesystem::path dir;  // "": not given; `bake` needs it, `inspect` does not
  Layout layout = Layout::layers;
  Depth depth = Depth::half;
  bool frames = false;
  Normalize normalize = Normalize::none;
  bool repair = false;
  StandardErrors standard_errors = StandardErrors::when_float;  // of a bake, as layers
  SaveScene save_scene = SaveScene::when_unwrapped;
  bool keep_temporary = false;
};

/// In the place of a path: no folder at all.
inline constexpr const char* no_cache = "none";

struct RunSettings {
  std::string blender;            // path, or a name to look up in PATH; "": search
  std::filesystem::path scripts;  // "": those inside the binary
  int jobs = 0;                   // Blenders at a time; 0: chosen from cores and memory
  int threads = 0;                // for each Blender; 0: all cores shared among the jobs
  int timeout = 600;              // seconds without progress
  int launch_timeout = 0;         // seconds; 0: no limit
  int memory_max = 0;             // MiB of one Blender; 0: no limit
  bool sandbox = false;
  std::vector<std::filesystem::path> sandbox_read;
  int retries = 1;
  std::string time;             // how long a bake may take; "": as long as it needs
  std::filesystem::path cache;  // folder of results that are kept; "": the user's own; no_cache: none
  int cache_limit = 20480;      // MiB; 0: no limit
  int lock_wait = 0;            // seconds, for another run that writes to the same folder
};

struct BakeSettings {
  SceneSettings scene;
  BakingSettings bake;
  ReferenceSettings reference;
  ObjectSettings object;  // what holds where no override matches
  OutputSettings output;
  RunSettings run;
};

}  // namespace rnmbake
