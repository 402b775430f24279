#include "pipeline/validate/validate_scope.h"

#include "trace/trace_scenes.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(ValidateScope, ListsWhatTheLambertSceneStillHas) {
  DiffuseScene scene;
  scene.outside = {{"object 'Vase'", {"glossy"}, {}},
                   {"object 'Fence'", {"casts no shadow", "glossy"}, {"casts no shadow"}},
                   {"world", {"volume"}, {"volume"}}};
  EXPECT_EQ(not_followed(scene),
            (std::vector<std::string>{"object 'Fence': casts no shadow", "world: volume"}));
  EXPECT_EQ(scope_notes(scene).size(), 2U);
}

TEST(ValidateScope, BouncesMatterWhereSomethingIsBright) {
  DiffuseScene scene;
  add_object(scene, "grey", {level(1, 0)}, Vec3(0.7F));
  EXPECT_FALSE(bounces_matter(scene, 32));  // 0.7^33 = 8e-6
  EXPECT_TRUE(bounces_matter(scene, 4));
  scene.pictures.push_back({2, 1, {Vec3(0.1F), Vec3(0.2F, 0.95F, 0)}});
  scene.materials[0].albedo_picture = 0;
  EXPECT_TRUE(bounces_matter(scene, 32));
}

}  // namespace
}  // namespace rnmbake
