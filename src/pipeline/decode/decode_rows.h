// pipeline/decode/decode_rows.h - a lightmap lit a few rows at a time, so that none has to fit into memory.
#pragma once

#include "image/float_image.h"
#include "image/layer_rows.h"
#include "lightmap/decode.h"

#include <filesystem>
#include <functional>

namespace rnmbake {

/// Takes rows [begin, end) of the lit picture, RGB in E/pi, from top to bottom.
using TakeRows = std::function<void(int begin, int end, FloatImage&& lit)>;

/// A normal map, read a few rows at a time: the same vectors as those of normals_of().
class NormalRows {
 public:
  /// Reads a float picture once to see whether it holds vectors. Throws as PictureReader and normals_of().
  explicit NormalRows(const std::filesystem::path& file);

  [[nodiscard]] int width() const { return rows_.facts().width; }
  [[nodiscard]] int height() const { return rows_.facts().height; }
  [[nodiscard]] FloatImage read(int begin, int end);

 private:
  [[nodiscard]] FloatImage pixels(LayerRows& rows, int begin, int end) const;

  LayerRows rows_;
  LayeredImage header_;
  VectorSource source_;  // its layer lies in header_
};

/// The picture that decode() of the whole lightmap returns. Throws as LightmapDecoder and PictureReader.
void decode_rows(LayerRows& lightmap, const LightmapMetadata& metadata, const Vec3& normal, Green green,
                 DecodeVariant variant, const TakeRows& take);

/// The same with a normal map of the lightmap's size, so that no row needs its neighbours.
void decode_rows(LayerRows& lightmap, const LightmapMetadata& metadata, NormalRows& normals, Green green,
                 DecodeVariant variant, const TakeRows& take);

}  // namespace rnmbake
