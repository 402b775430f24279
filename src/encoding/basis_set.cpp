#include "encoding/basis_set.h"

#include "base/error.h"
#include "base/text.h"
#include "encoding/encodings.h"
#include "encoding/rnm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rnmbake {
namespace {

constexpr float tolerance = 1e-3F;

bool is_near(const Vec3& a, const Vec3& b) {
  return (a - b).length() < tolerance;
}

void check_name(const BasisSet& set, std::size_t at) {
  const std::string& name = set.directions[at].name;
  if (!is_file_safe(name)) {
    fail(ExitCode::invalid_input,
         "{}: basis name '{}' cannot be used in file and layer names; use 1 to 64 of a-z A-Z 0-9 _ -",
         set.name, name);
  }
  for (const char* reserved : {"coverage", "tangent", "normal", "validity"}) {
    if (lower_case(name) == reserved) {
      fail(ExitCode::invalid_input,
           "{}: basis name '{}' is taken by a layer of every lightmap; choose another", set.name, name);
    }
  }
  if (holds_layer(sh_encoding, lower_case(name)) || lower_case(name).ends_with("_stderr")) {
    fail(ExitCode::invalid_input, "{}: basis name '{}' is taken by a layer of references; choose another",
         set.name, name);
  }
  // Files of two names that differ only in case would overwrite each other on some systems.
  for (std::size_t other = 0; other < at; ++other) {
    if (lower_case(set.directions[other].name) == lower_case(name)) {
      fail(ExitCode::invalid_input,
           "{}: basis names '{}' and '{}' are the same (case does not count); rename one", set.name,
           set.directions[other].name, name);
    }
  }
}

void check_direction(const BasisSet& set, const BasisDirection& basis) {
  const auto& [name, v] = basis;
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
    fail(ExitCode::invalid_input, "{}: direction of basis '{}' is not finite; give three finite numbers",
         set.name, name);
  }
  if (is_near(v, Vec3(0.904534F, 0, 0.426401F))) {
    fail(ExitCode::invalid_input,
         "{}: '{}' is the misprinted Half-Life 2 basis: dot with rnm1 is {:.3f}; correct is (0.816497, 0, "
         "0.577350)",
         set.name, name, v.dot(rnm_basis()[1]));
  }
  const float length = v.length();
  if (std::abs(length - 1) > tolerance) {
    fail(ExitCode::invalid_input, "{}: direction of basis '{}' has length {:.6f}; scale it to length 1",
         set.name, name, length);
  }
  if (lower_case(name) == "flat" && (name != "flat" || !is_near(v, flat_direction().direction))) {
    fail(ExitCode::invalid_input, "{}: the name '{}' is kept for 'flat' = (0, 0, 1); rename this direction",
         set.name, name);
  }
}

}  // namespace

BasisSet rnm_set() {
  const auto basis = rnm_basis();
  BasisSet set{std::string(rnm_encoding.name), {}};
  for (std::size_t i = 0; i < basis.size(); ++i)
    set.directions.push_back({std::string(rnm_layers[i]), basis[i]});
  return set;
}

BasisDirection flat_direction() {
  return {std::string(flat_layers.front()), Vec3(0, 0, 1)};
}

BasisSet flat_and_rnm() {
  BasisSet set = rnm_set();
  set.directions.insert(set.directions.begin(), flat_direction());
  return set;
}

std::optional<std::size_t> place_of(const BasisSet& set, const BasisDirection& wanted) {
  const auto found = std::ranges::find_if(set.directions, [&](const BasisDirection& basis) {
    return basis.name == wanted.name && is_near(basis.direction, wanted.direction);
  });
  if (found == set.directions.end()) return std::nullopt;
  return static_cast<std::size_t>(found - set.directions.begin());
}

bool holds_rnm(const BasisSet& set) {
  return std::ranges::all_of(rnm_set().directions,
                             [&](const BasisDirection& wanted) { return place_of(set, wanted).has_value(); });
}

bool is_file_safe(std::string_view name) {
  const auto is_safe = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= 64 && std::ranges::all_of(name, is_safe);
}

std::vector<std::string> check_basis(const BasisSet& set) {
  if (set.directions.empty())
    fail(ExitCode::invalid_input, "{}: the basis is empty; give at least one direction", set.name);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < set.directions.size(); ++i) {
    check_name(set, i);
    check_direction(set, set.directions[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const auto &a = set.directions[j], &b = set.directions[i];
      // Half a degree: no decode can tell the two maps apart.
      if (a.direction.dot(b.direction) > 0.99996F) {
        warnings.push_back(fmt::format("{}: basis '{}' and '{}' point the same way within half a degree",
                                       set.name, a.name, b.name));
      }
    }
  }
  return warnings;
}

}  // namespace rnmbake
