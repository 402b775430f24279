// pipeline/validate/validate_scope.h - differences of bake and reference in scope, not by error: light that
// one cannot follow, the limit of bounces.
#pragma once

#include "report/comparison.h"
#include "scene/diffuse_scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// "light 'Lamp': node tree": light that Cycles' bakes of the lambert scene have and the tracer has not. It
/// may reach any object.
[[nodiscard]] std::vector<std::string> not_followed(const DiffuseScene& scene);

/// The same as lines for a report.
[[nodiscard]] std::vector<std::string> scope_notes(const DiffuseScene& scene);

/// Whether more than a ten-thousandth of the light of a closed room of the scene's brightest surface is left
/// after so many bounces.
[[nodiscard]] bool bounces_matter(const DiffuseScene& scene, int bounces);

/// Loss by the limit of bounces, from folders with the truth traced with and without it.
[[nodiscard]] BounceLimit bounce_limit(int bounces, const std::filesystem::path& with,
                                       const std::filesystem::path& without);

}  // namespace rnmbake
