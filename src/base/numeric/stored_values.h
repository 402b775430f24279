// base/numeric/stored_values.h - how the values of a lightmap are stored.
#pragma once

namespace rnmbake {

enum class Depth { half, full };  // bits of a file's floats: 16 or 32

/// What the maps of the Half-Life 2 basis are scaled to: nothing, or, texel by texel, to a mean that equals
/// the flat map, as Source's vrad does.
enum class Normalize { none, flat };

}  // namespace rnmbake
