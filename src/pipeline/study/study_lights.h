// pipeline/study/study_lights.h - the lights that encodings are studied on: random hemispheres, surfaces in
// the light of a probe, and texels of bakes.
#pragma once

#include "encoding/distant_light.h"
#include "pipeline/study/encoding_study.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

namespace rnmbake {

/// `count` random hemispheres (encoding/random_light.h), each scaled to a flat E/pi of 1, at 256 normals
/// spread over the hemisphere. Fed with every direction that an encoding asks for. The same for the same
/// seed.
[[nodiscard]] EncodingStudy study_random(std::size_t count, std::uint64_t seed);

/// `count` surfaces turned at random in that light, each of which blocks what is behind it; tested as
/// study_random(). They count by their light's energy.
[[nodiscard]] EncodingStudy study_probe(const DistantLight& light, std::size_t count, std::uint64_t seed,
                                        const std::function<void(double)>& progress = {});

/// Covered texels of lightmaps that were baked for more directions than the encodings are fed with: the
/// others are where they are tested. Throws as open_lightmaps(), and Error(unsupported), naming the remedy,
/// where there are no others or a lightmap was converted.
[[nodiscard]] EncodingStudy study_lightmaps(const std::filesystem::path& path,
                                            const std::function<void(double)>& progress = {});

}  // namespace rnmbake
