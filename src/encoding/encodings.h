// encoding/encodings.h - the encodings whose layers a lightmap may hold, one row each.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

namespace rnmbake {

/// Each layer holds R, G and B. What the numbers mean stands in the encoding's own header of this folder.
struct Encoding {
  std::string_view name;
  std::span<const std::string_view> layers;  // in the order of the encoding's own formulas
};

inline constexpr std::array<std::string_view, 1> flat_layers{"flat"};
inline constexpr std::array<std::string_view, 3> rnm_layers{"rnm0", "rnm1", "rnm2"};
inline constexpr std::array<std::string_view, 9> sh_layers{"sh0", "sh1", "sh2", "sh3", "sh4",
                                                           "sh5", "sh6", "sh7", "sh8"};

inline constexpr std::array<std::string_view, 4> l1_layers{"l0", "l1x", "l1y", "l1z"};
inline constexpr std::array<std::string_view, 4> packed_l1_layers{"l0", "t1x", "t1y", "t1z"};
inline constexpr std::array<std::string_view, 2> mono_l1_layers{"l0", "dir"};
inline constexpr std::array<std::string_view, 3> ahd_layers{"ambient", "directional", "direction"};
inline constexpr std::array<std::string_view, 3> dominant_layers{"colour", "direction", "directionality"};
inline constexpr std::array<std::string_view, 4> h4_layers{"h0", "h1", "h2", "h3"};
inline constexpr std::array<std::string_view, 6> h6_layers{"h0", "h1", "h2", "h3", "h4", "h5"};
inline constexpr std::array<std::string_view, 6> sg_layers{"sg0", "sg1", "sg2", "sg3", "sg4", "sg5"};

inline constexpr Encoding flat_encoding{"flat", flat_layers};  // E/pi of the surface's own normal
inline constexpr Encoding rnm_encoding{"rnm", rnm_layers};     // encoding/rnm.h; McTaggart (2004)
inline constexpr Encoding sh_encoding{"sh", sh_layers};        // encoding/sh.h; Ramamoorthi, Hanrahan (2001)
inline constexpr Encoding l1_encoding{"l1", l1_layers};        // a and v: encoding/sh2.h, zh3.h, geomerics.h
inline constexpr Encoding packed_l1_encoding{"l1-packed", packed_l1_layers};  // encoding/refit/packing.h
inline constexpr Encoding mono_l1_encoding{"l1-mono", mono_l1_layers};

inline constexpr Encoding ahd_encoding{"ahd", ahd_layers};                 // encoding/ahd.h
inline constexpr Encoding dominant_encoding{"dominant", dominant_layers};  // encoding/unity_dominant.h
inline constexpr Encoding h4_encoding{"h4", h4_layers};                    // encoding/hbasis.h
inline constexpr Encoding h6_encoding{"h6", h6_layers};                    // the same
inline constexpr Encoding sg_encoding{"sg", sg_layers};                    // encoding/sg.h

inline constexpr std::array<Encoding, 11> encodings{
    flat_encoding, rnm_encoding,      sh_encoding, l1_encoding, packed_l1_encoding, mono_l1_encoding,
    ahd_encoding,  dominant_encoding, h4_encoding, h6_encoding, sg_encoding};

/// The layer of this name is one of the encoding's.
[[nodiscard]] inline bool holds_layer(const Encoding& encoding, std::string_view name) {
  return std::ranges::find(encoding.layers, name) != encoding.layers.end();
}

/// Name of a basis' layer within one EXR file: the flat bake is the plain layer, which every viewer shows.
[[nodiscard]] inline std::string exr_layer(std::string_view basis) {
  return basis == flat_layers.front() ? std::string() : std::string(basis);
}

/// Name of the basis, or of the other layer, that an EXR layer holds.
[[nodiscard]] inline std::string name_of_exr_layer(std::string_view layer) {
  return std::string(layer.empty() ? flat_layers.front() : layer);
}

}  // namespace rnmbake
