// probes/formats/makers.h - one function for each format, and what they share.
#pragma once

#include "probes/formats/format_file.h"
#include "probes/probe_volume.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

[[nodiscard]] std::vector<FormatFile> bevy_files(std::span<const ProbeVolume> volumes);
[[nodiscard]] std::vector<FormatFile> cpp_files(std::span<const ProbeVolume> volumes);
[[nodiscard]] std::vector<FormatFile> gltf_files(std::span<const ProbeVolume> volumes);
[[nodiscard]] std::vector<FormatFile> godot_files(std::span<const ProbeVolume> volumes);
[[nodiscard]] std::vector<FormatFile> threejs_files(std::span<const ProbeVolume> volumes);
[[nodiscard]] std::vector<FormatFile> unity_files(std::span<const ProbeVolume> volumes);
[[nodiscard]] std::vector<FormatFile> vrc_files(std::span<const ProbeVolume> volumes);

/// A file of src/probes/formats/shipped/, which travels inside the binary.
[[nodiscard]] FormatFile shipped_file(const std::string& name);

/// File stems of the volumes, no two alike; "probes" for a volume without a name.
[[nodiscard]] std::vector<std::string> volume_stems(std::span<const ProbeVolume> volumes);

/// Little endian, as every format has it.
void append_half(std::string& bytes, float value);  // beyond 65504: 65504
void append_float(std::string& bytes, float value);
void append_double(std::string& bytes, double value);
void append_u16(std::string& bytes, std::uint16_t value);
void append_u32(std::string& bytes, std::uint32_t value);
void append_u64(std::string& bytes, std::uint64_t value);

/// A number as a float, as short as it can be without a loss, with a point or an exponent.
[[nodiscard]] std::string decimal(double value);

/// A quoted string of Rust, C#, JSON and YAML.
[[nodiscard]] std::string string_literal(std::string_view text);

}  // namespace rnmbake
