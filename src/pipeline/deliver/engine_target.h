// pipeline/deliver/engine_target.h - what is particular to an engine: the encodings that it can show,
// how the files of a page look, and what goes with them.
#pragma once

#include "encoding/codec.h"
#include "pipeline/deliver/delivery_files.h"
#include "pipeline/deliver/page_writer.h"
#include "pipeline/deliver/pages.h"

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

class EngineTarget {
 public:
  static constexpr const char* flat =
      PageWriter::flat;  // the encoding without directions, and its only layer

  EngineTarget() = default;
  EngineTarget(const EngineTarget&) = delete;
  EngineTarget& operator=(const EngineTarget&) = delete;
  virtual ~EngineTarget() = default;

  /// As users type it: --engine threejs.
  [[nodiscard]] virtual const char* name() const = 0;

  /// Those that the engine has a decoder for; the first is taken where none is asked for.
  [[nodiscard]] virtual const std::vector<std::string>& encodings() const = 0;

  /// How one of these is packed. `name` is filled in already.
  virtual void pack(CodecOptions& /*codec*/) const {}

  /// Layers along Blender's world axes rather than in tangent space; bakes then need --frames.
  [[nodiscard]] virtual bool in_world() const { return false; }

  /// All pages have the size of the largest.
  [[nodiscard]] virtual bool pages_alike() const { return false; }

  /// Sides of pages are powers of two.
  [[nodiscard]] virtual bool powers_of_two() const { return false; }

  /// Formats of pages that users may choose of, the first where they do not; none where write_page() knows
  /// what the engine reads.
  [[nodiscard]] virtual const std::vector<PageFormat>& formats() const;

  /// Writes one page of an engine without formats(), whose layers are the encoding's in their order, and
  /// returns what the record says of them: the file of each layer, by its name. Unless an engine wants
  /// something else: an EXR of half floats for each, pageN.LAYER.exr.
  [[nodiscard]] virtual nlohmann::ordered_json write_page(DeliveryFiles& files, std::size_t number,
                                                          Page page) const;

  /// Adds loaders, shaders and whatever else the engine reads, and to the record (docs/deliver.md), which is
  /// complete but for the names of files.
  virtual void add_files(DeliveryFiles& /*files*/, nlohmann::ordered_json& /*record*/) const {}
};

}  // namespace rnmbake
