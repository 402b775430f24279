#include "pipeline/decode/decode_rows.h"

#include <cassert>
#include <utility>

namespace rnmbake {

NormalRows::NormalRows(const std::filesystem::path& file)
    : rows_(file), header_(rows_.header()), source_(vector_source(header_, file.string())) {
  if (source_.is_signed || rows_.facts().is_integer) return;
  LayerRows first_pass(file);
  each_band(height(), [&](int begin, int end) {
    source_.is_signed = source_.is_signed || has_negative(pixels(first_pass, begin, end), source_);
  });
}

FloatImage NormalRows::pixels(LayerRows& rows, int begin, int end) const {
  auto layers = rows.read(begin, end).layers;
  return std::move(layers[static_cast<std::size_t>(source_.layer - header_.layers.data())].pixels);
}

FloatImage NormalRows::read(int begin, int end) {
  return normals_of(pixels(rows_, begin, end), source_);
}

void decode_rows(LayerRows& lightmap, const LightmapMetadata& metadata, const Vec3& normal, Green green,
                 DecodeVariant variant, const TakeRows& take) {
  each_band(lightmap.facts().height, [&](int begin, int end) {
    take(begin, end, decode(lightmap_of(lightmap.read(begin, end), metadata), normal, green, variant));
  });
}

void decode_rows(LayerRows& lightmap, const LightmapMetadata& metadata, NormalRows& normals, Green green,
                 DecodeVariant variant, const TakeRows& take) {
  assert(normals.width() == lightmap.facts().width && normals.height() == lightmap.facts().height);
  each_band(lightmap.facts().height, [&](int begin, int end) {
    const NormalPicture picture{normals.read(begin, end), green};
    take(begin, end, decode(lightmap_of(lightmap.read(begin, end), metadata), picture, variant));
  });
}

}  // namespace rnmbake
