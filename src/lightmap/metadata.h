// lightmap/metadata.h - what a lightmap file says about itself, to and from header attributes.
#pragma once

#include "encoding/basis_set.h"
#include "encoding/codec.h"
#include "image/layered_exr.h"
#include "lightmap/merge.h"

#include <map>
#include <string>
#include <vector>

namespace rnmbake {

/// Direction of growing y in tangent space: up = growing v (Blender, glTF, Unity, Godot), down (Unreal,
/// Source).
enum class Green { y_up, y_down };

[[nodiscard]] const char* name_of(Green green);
[[nodiscard]] const char* name_of(Normalize normalize);

inline constexpr const char* baked_codec = "rnm";  // as a codec: the layers are the bakes
inline constexpr const char* clipped_hemisphere_integral = "clipped hemisphere integral";

/// Everything under the attribute names "rnmbake:..." (docs/lightmap-format.md). The first block decides what
/// the numbers mean and must be there; the second tells where they come from.
struct LightmapMetadata {
  std::string convention = clipped_hemisphere_integral;
  std::string units = "E/pi";
  std::string space = "tangent";
  std::string handedness = "right";  // of the frame before `green` and mirrored charts flip the bitangent
  Green green = Green::y_up;
  Normalize normalize = Normalize::none;
  std::vector<BasisDirection> bases;  // baked directions in layer order, "flat" included
  CodecOptions codec;                 // of a converted lightmap; its `bases` are what it was made from

  std::string engine;     // "cycles", "embree"; "": not said
  std::string recipe;     // "receiver", "flat-normal-map", "traced", "reference"
  std::string horizon;    // how corners whose basis normal falls under their face were treated
  std::string footprint;  // what a texel averages over: "texel centre", "half texel", "texel"
  int samples = 0, bounces = 0, seed = 0;  // bounces -1: no limit
  bool repaired = false;                   // whether some texel is a mean of its neighbours
  std::string rnmbake_version, blender_version;
  std::string object, uv_layer, tangent_uv_layer;

  // Of a reference only.
  std::string model;   // "true", "flat-normal-map"
  std::string faults;  // of the latter, separated by commas; "none"
  float error = 0;     // relative standard error that tracing went on for; 0: `samples` decided

  /// The layers are the bakes of `bases`.
  [[nodiscard]] bool is_baked() const { return convention == clipped_hemisphere_integral; }

  /// The layers are those of `codec`; where neither is true the convention is somebody else's.
  [[nodiscard]] bool is_encoded() const;

  /// Of a lightmap that is converted; the codec "rnm" stands for the bakes themselves.
  void set_codec(const CodecOptions& options);
};

/// True where the header carries the convention's name, i.e. the file calls itself an rnmbake lightmap.
[[nodiscard]] bool has_metadata(const LayeredImage& image);

/// Adds the attributes to the image, replacing those of the same names.
void write_metadata(const LightmapMetadata& metadata, LayeredImage& image);

/// Throws Error(invalid_input), naming `file` and the attribute, where one of the first block is missing, of
/// the wrong type, has a value that does not exist, or contradicts another or the layers (a basis without its
/// vector or layer). An unknown convention, units or space is no error here: see decode_obstacle().
[[nodiscard]] LightmapMetadata read_metadata(const LayeredImage& image, const std::string& file);

}  // namespace rnmbake
