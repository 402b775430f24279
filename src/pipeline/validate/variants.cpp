#include "pipeline/validate/variants.h"

#include "base/files.h"
#include "pipeline/scene/scene_key.h"

#include <algorithm>
#include <cstdint>

namespace rnmbake {
namespace {

constexpr int traced_for_each_baked = 2;  // paths of the reference for each sample of the bake

/// Unrepaired floats in one file, for comparisons.
OutputSettings plain_output(const OutputSettings& output, const std::filesystem::path& dir) {
  OutputSettings plain;
  plain.dir = dir;
  plain.depth = Depth::full;
  plain.standard_errors = OutputSettings::StandardErrors::never;
  plain.save_scene = OutputSettings::SaveScene::never;
  plain.keep_temporary = output.keep_temporary;
  return plain;
}

ResolvedConfig config_for(const VariantBase& base, const std::filesystem::path& dir) {
  ResolvedConfig config = base.session.config();
  config.globals.output = plain_output(config.globals.output, dir);
  make_folders(dir);
  return config;
}

std::filesystem::path output_of(const VariantBase& base) {
  return base.session.settings().output.dir;
}

/// Keys of their own, for the samples are one sequence; and the lambert scene's content, whose baked colours
/// are not in the digest of the user's scene.
PassCache cache_for(const VariantBase& base, const BlenderSession& session, const BakeVariant& variant) {
  if (base.anew || variant.timed) return {};
  KeyMaker key;
  key.add("scene", scene_key(session, base.exported.diffuse_scene.survey)).add("sequences", std::int64_t{1});
  if (variant.materials == SceneSettings::Materials::lambert) key.add("content", base.exported.content);
  return {base.store, key.make("scene")};
}

}  // namespace

std::filesystem::path half_folder(const VariantBase& base, const BakeVariant& variant, int half) {
  return output_of(base) / variant.folder / std::to_string(half + 1);
}

BakeOutcome bake_half(const VariantBase& base, const TargetList& list, const BakeVariant& variant, int half) {
  ResolvedConfig config = config_for(base, half_folder(base, variant, half));
  config.globals.bake.recipe = variant.recipe;
  config.globals.bake.correct_bump = false;
  config.globals.bake.dispatch = BakingSettings::Dispatch::scene;  // one start of Blender is enough
  config.globals.scene.materials = variant.materials;
  TargetList halved = list;
  for (ObjectSettings& object : halved.settings) {
    object.samples = std::max(1, object.samples / 2);
    object.seed += variant.seed + half;
  }
  BlenderSession session(config, base.session.blender());
  const bool lambert = variant.materials == SceneSettings::Materials::lambert;
  SceneBlends blends = base.exported.blends.value();
  if (!lambert) blends.shown = blends.own;
  DispatchRules rules;
  rules.cache = cache_for(base, session, variant);
  rules.halves = false;  // the other half is a bake of its own
  return run_bake(session, {base.exported.diffuse_scene.survey, halved, base.bases, blends, {}, rules});
}

ReferenceOutcome trace_variant(const VariantBase& base, const TargetList& list, const TraceVariant& variant) {
  const ResolvedConfig config = config_for(base, output_of(base) / variant.folder);
  TargetList more = list;
  for (ObjectSettings& object : more.settings) {
    object.samples *= traced_for_each_baked;
    object.seed += variant.seed;
  }
  const TraceCache kept{&base.store, base.exported.content, base.anew};
  return run_reference({base.scene, more, base.bases, {}, kept}, config.globals, variant.plan, variant.title);
}

}  // namespace rnmbake
