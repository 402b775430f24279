// rnmbake_probes.h - light probes out of a .rnmprobes file, and their light at any place. C++11, no other
// files. World space as Blender's: right-handed, Z up; from_y_up() for engines with glTF's axes.
//
//     rnmbake_probes::Volume volume;
//     std::string problem;
//     if (!volume.load("hall.rnmprobes", &problem)) ...
//     rnmbake_probes::Vector light = volume.irradiance(place, normal);  // E/pi: times albedo
//
// The file, little endian: "RNMPROBE", version 1 (u32), counts of the box (3 u32; 0 for points alone), number
// of probes (u64), the first probe's place (3 doubles), the steps to the next of each axis (9 doubles), then
// for each probe, x fastest: its place (3 floats), validity (float), nine coefficients of radiance as RGB (27
// floats) in the order of Ramamoorthi and Hanrahan: 1, y, z, x, xy, yz, 3z2-1, xz, x2-y2.
#ifndef RNMBAKE_PROBES_H
#define RNMBAKE_PROBES_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace rnmbake_probes {

struct Vector {
  float x, y, z;  // of a colour: red, green, blue
};

/// A place or a normal of an engine with Y up (glTF's axes) along Blender's axes, and back.
inline Vector from_y_up(const Vector& v) {
  return Vector{v.x, -v.z, v.y};
}
inline Vector to_y_up(const Vector& v) {
  return Vector{v.x, v.z, -v.y};
}

struct Probe {
  float place[3];
  float validity;            // share of its rays that met no back face
  float coefficients[9][3];  // of radiance
};

/// E/pi, RGB, at a unit normal. What is negative, which nine coefficients can be, becomes 0.
inline Vector irradiance_of(const float coefficients[9][3], const Vector& n) {
  // The harmonics' norms times the shares of a clamped cosine: 1, 2/3 and 1/4.
  const float basis[9] = {0.28209479f,
                          0.32573501f * n.y,
                          0.32573501f * n.z,
                          0.32573501f * n.x,
                          0.27313711f * n.x * n.y,
                          0.27313711f * n.y * n.z,
                          0.07884789f * (3 * n.z * n.z - 1),
                          0.27313711f * n.x * n.z,
                          0.13656855f * (n.x * n.x - n.y * n.y)};
  float light[3] = {0, 0, 0};
  for (int k = 0; k < 9; ++k)
    for (int c = 0; c < 3; ++c) light[c] += coefficients[k][c] * basis[k];
  for (int c = 0; c < 3; ++c)
    if (light[c] < 0) light[c] = 0;
  return Vector{light[0], light[1], light[2]};
}

class Volume {
 public:
  /// False, with a sentence in *problem, where the file cannot be read or is none of these.
  bool load(const std::string& path, std::string* problem = nullptr) {
    std::ifstream file(path.c_str(), std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const char* wrong = !file.is_open() ? "cannot be read" : take(bytes);
    if (wrong && problem) *problem = path + ": " + wrong;
    return !wrong;
  }

  const std::vector<Probe>& probes() const { return probes_; }
  /// Probes along each axis; 0 for points alone.
  const int* counts() const { return counts_; }

  /// Steps from the first probe along each axis of the box; of points alone (0, 0, 0).
  Vector coordinates(const Vector& place) const {
    const double from[3] = {place.x - first_[0], place.y - first_[1], place.z - first_[2]};
    double found[3] = {0, 0, 0};
    if (counts_[0] == 0) return Vector{0, 0, 0};
    double cross[3][3];
    for (int k = 0; k < 3; ++k) {
      const double *a = steps_[(k + 1) % 3], *b = steps_[(k + 2) % 3];
      for (int c = 0; c < 3; ++c)
        cross[k][c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
    }
    const double space = dot(steps_[0], cross[0]);
    for (int k = 0; k < 3; ++k) found[k] = dot(from, cross[k]) / space;
    return Vector{static_cast<float>(found[0]), static_cast<float>(found[1]), static_cast<float>(found[2])};
  }

  /// Within the box that the outermost probes span.
  bool contains(const Vector& place) const {
    if (counts_[0] == 0) return false;
    const Vector vector = coordinates(place);
    const float at[3] = {vector.x, vector.y, vector.z};
    for (int k = 0; k < 3; ++k)
      if (!(at[k] >= 0 && at[k] <= static_cast<float>(counts_[k] - 1))) return false;
    return true;
  }

  /// Nine coefficients of radiance at a place: of the eight probes around it, trilinear; beyond the box those
  /// of its border. Probes whose validity is below `least_validity` count only where no other is around. Of
  /// points alone: the nearest.
  void coefficients(const Vector& place, float found[9][3], float least_validity = 0.75f) const {
    std::memset(found, 0, sizeof(float) * 27);
    if (probes_.empty()) return;
    if (counts_[0] == 0) {
      std::memcpy(found, nearest(place).coefficients, sizeof(float) * 27);
      return;
    }
    const Vector coordinate = coordinates(place);
    const float at[3] = {coordinate.x, coordinate.y, coordinate.z};
    int low[3], high[3];
    float share[3];
    for (int k = 0; k < 3; ++k) {
      const float last = static_cast<float>(counts_[k] - 1);
      const float inside = at[k] > 0 ? (at[k] < last ? at[k] : last) : 0;
      low[k] = static_cast<int>(inside);
      if (low[k] > 0 && low[k] == counts_[k] - 1) --low[k];
      high[k] = low[k] + 1 < counts_[k] ? low[k] + 1 : low[k];
      share[k] = inside - static_cast<float>(low[k]);
    }
    for (int pass = 0; pass < 2; ++pass) {  // the second where all around are buried
      float sum = 0;
      for (int corner = 0; corner < 8; ++corner) {
        float weight = 1;
        std::size_t index = 0, stride = 1;
        for (int k = 0; k < 3; ++k) {
          const bool far = (corner >> k & 1) != 0;
          weight *= far ? share[k] : 1 - share[k];
          index += stride * static_cast<std::size_t>(far ? high[k] : low[k]);
          stride *= static_cast<std::size_t>(counts_[k]);
        }
        const Probe& probe = probes_[index];
        if (weight <= 0 || (pass == 0 && probe.validity < least_validity)) continue;
        sum += weight;
        for (int i = 0; i < 9; ++i)
          for (int c = 0; c < 3; ++c) found[i][c] += weight * probe.coefficients[i][c];
      }
      if (sum <= 0) continue;
      for (int i = 0; i < 9; ++i)
        for (int c = 0; c < 3; ++c) found[i][c] /= sum;
      return;
    }
  }

  /// E/pi, RGB, at a place for a unit normal.
  Vector irradiance(const Vector& place, const Vector& normal, float least_validity = 0.75f) const {
    float found[9][3];
    coefficients(place, found, least_validity);
    return irradiance_of(found, normal);
  }

 private:
  static const std::size_t header_bytes = 8 + 4 + 12 + 8 + 24 + 72, probe_bytes = 4 * 31;

  static double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  static std::uint64_t integer(const char* bytes, int count) {
    std::uint64_t value = 0;
    for (int i = count - 1; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  }

  static float number(const char* bytes) {
    const std::uint32_t bits = static_cast<std::uint32_t>(integer(bytes, 4));
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  static double double_number(const char* bytes) {
    const std::uint64_t bits = integer(bytes, 8);
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  const char* take(const std::vector<char>& bytes) {
    if (bytes.size() < header_bytes || std::memcmp(bytes.data(), "RNMPROBE", 8) != 0)
      return "is no file of light probes";
    const char* at = bytes.data() + 8;
    if (integer(at, 4) != 1) return "has a version that this header does not know";
    std::uint64_t counts[3], in_box = 1;
    for (int k = 0; k < 3; ++k) {
      counts[k] = integer(at + 4 + 4 * k, 4);
      if (counts[k] > 65536) return "is damaged";
      in_box *= counts[k];
    }
    const std::uint64_t size = integer(at + 16, 8);
    if (size != (bytes.size() - header_bytes) / probe_bytes ||
        (bytes.size() - header_bytes) % probe_bytes != 0)
      return "is cut off";
    if (in_box != (counts[0] > 0 ? size : 0)) return "is damaged";
    at += 24;
    for (int k = 0; k < 3; ++k) {
      counts_[k] = static_cast<int>(counts[k]);
      first_[k] = double_number(at + 8 * k);
      for (int c = 0; c < 3; ++c) steps_[k][c] = double_number(at + 24 + 8 * (3 * k + c));
    }
    at += 96;
    probes_.resize(static_cast<std::size_t>(size));
    for (std::size_t i = 0; i < probes_.size(); ++i) {
      float numbers[31];
      for (int k = 0; k < 31; ++k, at += 4) numbers[k] = number(at);
      std::memcpy(probes_[i].place, numbers, sizeof(float) * 3);
      probes_[i].validity = numbers[3];
      std::memcpy(probes_[i].coefficients, numbers + 4, sizeof(float) * 27);
    }
    return nullptr;
  }

  const Probe& nearest(const Vector& place) const {
    const Probe* best = nullptr;
    float least = 0;
    for (std::size_t i = 0; i < probes_.size(); ++i) {
      const float *p = probes_[i].place, x = p[0] - place.x, y = p[1] - place.y, z = p[2] - place.z;
      const float square = x * x + y * y + z * z;
      if (!best || square < least) {
        best = &probes_[i];
        least = square;
      }
    }
    return *best;
  }

  int counts_[3] = {0, 0, 0};
  double first_[3] = {0, 0, 0};
  double steps_[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Probe> probes_;
};

}  // namespace rnmbake_probes

#endif
