#include "pipeline/lightmaps/preview_pictures.h"

#include "bake/assemble.h"
#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "image/display_png.h"
#include "lightmap/fill.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace rnmbake {

namespace fs = std::filesystem;

PreviewPictures::PreviewPictures(const BakeContext& context, const OutputSettings& output,
                                 const std::vector<LightmapHeader>& headers)
    : context_(context),
      folder_(output.dir / "preview"),
      headers_(headers),
      rects_(headers.size()),
      is_finished_(headers.size()) {
  for (const BakeTask& task : context.plan.tasks) {
    if (!task.cycles.mirrors) rects_[task.target] += task.rects.size();
  }
}

PreviewPictures::~PreviewPictures() {
  std::error_code ignored;
  for (std::size_t target = 0; target < headers_.size(); ++target) fs::remove(file_of(target), ignored);
  fs::remove(folder_, ignored);  // not where it holds anything
}

fs::path PreviewPictures::file_of(std::size_t target) const {
  return folder_ / (headers_[target].stem + ".png");
}

void PreviewPictures::take(const BatchLayout& layout, const std::vector<BakedPicture>& pictures) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const std::size_t rect = layout.rects[i], target = context_.plan.rects[rect].target;
    if (context_.plan.rects[rect].pass.role == ReceiverPass::Role::mirrors) continue;
    if (!is_finished_[target] && pictures[i].all_samples() > 0) pictures_[target][rect] = pictures[i].mean();
  }
  std::erase_if(pictures_, [&](const auto& one) {
    if (one.second.size() < rects_[one.first]) return false;
    write(one.first, one.second);
    return true;
  });
}

void PreviewPictures::finish(std::size_t target) {
  const std::lock_guard lock(mutex_);
  is_finished_[target] = true;
  pictures_.erase(target);
  std::error_code ignored;
  fs::remove(file_of(target), ignored);
}

void PreviewPictures::write(std::size_t target, const std::map<std::size_t, FloatImage>& pictures) {
  std::vector<const AtlasRect*> rects;
  std::vector<FloatImage> means;
  for (const auto& [rect, picture] : pictures) {
    rects.push_back(&context_.plan.rects[rect]);
    means.push_back(picture);
  }
  try {
    TargetBakes bakes = assemble(context_.targets[target], rects, means, context_.bases,
                                 headers_[target].surface.get(), false);
    const auto flat = std::ranges::find(bakes.bases, "flat", &BasisBake::name);
    FloatImage& shown = (flat == bakes.bases.end() ? bakes.bases.front() : *flat).radiance;
    dilate(shown, bakes.coverage, headers_[target].dilate);
    make_folders(folder_);
    write_display_png(file_of(target), shown, 0);
  } catch (const Error& error) {
    log::warn("{}: no preview: {}", context_.targets[target].key, error.what());
  }
}

}  // namespace rnmbake
