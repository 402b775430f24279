// pipeline/lightmaps/preview_pictures.h - DIR/preview: pictures of lightmaps that are still being baked, to
// look at.
#pragma once

#include "bake/baked_picture.h"
#include "bake/request.h"
#include "pipeline/lightmaps/deliver_lightmap.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <vector>

namespace rnmbake {

/// Thread-safe. What cannot be written is left out, with a warning: nobody needs a preview.
class PreviewPictures {
 public:
  PreviewPictures(const BakeContext& context, const OutputSettings& output,
                  const std::vector<LightmapHeader>& headers);
  /// Removes the folder, unless somebody else has files there.
  ~PreviewPictures();
  PreviewPictures(const PreviewPictures&) = delete;
  PreviewPictures& operator=(const PreviewPictures&) = delete;

  /// Takes the first passes of a batch. Of each target that is complete by them, writes DIR/preview/STEM.png:
  /// the flat map, or else the first, as bright as it is (sRGB, clamped at 1), dilated.
  void take(const BatchLayout& layout, const std::vector<BakedPicture>& pictures);

  /// The target is delivered or given up: removes its picture.
  void finish(std::size_t target);

 private:
  void write(std::size_t target, const std::map<std::size_t, FloatImage>& pictures);
  [[nodiscard]] std::filesystem::path file_of(std::size_t target) const;

  BakeContext context_;
  std::filesystem::path folder_;
  const std::vector<LightmapHeader>& headers_;
  std::mutex mutex_;
  std::vector<std::size_t> rects_;                                     // [targets] how many it has
  std::map<std::size_t, std::map<std::size_t, FloatImage>> pictures_;  // target -> rectangle -> picture
  std::vector<bool> is_finished_;                                      // [targets]
};

}  // namespace rnmbake
