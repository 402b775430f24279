#include "cli/bases/basis_file.h"

#include "base/error.h"
#include "base/log.h"
#include "base/read_file.h"
#include "config/parse_toml.h"
#include "config/recipe_names.h"
#include "encoding/direction_sets.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace rnmbake {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const toml::node& where,
                         const std::string& what) {
  fail(ExitCode::invalid_input, "{}:{}: {}", file.string(), where.source().begin.line, what);
}

void check_keys(const std::filesystem::path& file, const toml::table& table,
                std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : table) {
    if (std::ranges::find(known, key.str()) == known.end()) {
      refuse(file, value,
             fmt::format("unknown key '{}'; a basis file holds [[basis]] tables with name and direction",
                         key.str()));
    }
  }
}

Vec3 direction_of(const std::filesystem::path& file, const toml::table& table) {
  const toml::array* numbers = table["direction"].as_array();
  if (numbers == nullptr || numbers->size() != 3) refuse(file, table, "a basis needs direction = [x, y, z]");
  Vec3 direction;
  for (int axis = 0; axis < 3; ++axis) {
    const auto number = (*numbers)[static_cast<std::size_t>(axis)].value<double>();
    if (!number) refuse(file, *numbers, "direction holds something that is not a number; give [x, y, z]");
    direction[axis] = static_cast<float>(*number);
  }
  return direction;
}

BasisDirection basis_of(const std::filesystem::path& file, const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) refuse(file, node, "each basis must be a [[basis]] table");
  check_keys(file, *table, {"name", "direction"});
  const auto name = (*table)["name"].value<std::string>();
  if (!name) refuse(file, *table, "a basis needs name = \"...\"");
  return {*name, direction_of(file, *table)};
}

BasisSet set_of(BakingSettings::DirectionSet chosen) {
  return chosen == BakingSettings::DirectionSet::rnm ? rnm_set() : direction_set(name_of(chosen)).value();
}

}  // namespace

BasisFile read_basis_file(const std::filesystem::path& file) {
  const toml::table root = parse_toml(read_text(file, largest_toml), file.string(), ExitCode::invalid_input);
  check_keys(file, root, {"basis"});
  BasisFile result{{file.string(), {}}, {}};
  if (const toml::node* list = root.get("basis"); list != nullptr) {
    if (list->as_array() == nullptr)
      refuse(file, *list, "basis must be a list: write [[basis]], not [basis]");
    for (const toml::node& node : *list->as_array()) result.set.directions.push_back(basis_of(file, node));
  }
  result.warnings = check_basis(result.set);
  return result;
}

BasisSet read_basis_set(const std::filesystem::path& file) {
  BasisFile read = read_basis_file(file);
  for (const std::string& warning : read.warnings) log::warn("{}", warning);
  return std::move(read.set);
}

std::vector<BasisDirection> choose_bases(const BakingSettings& settings) {
  const BasisSet set = settings.basis.empty() ? set_of(settings.basis_set) : read_basis_set(settings.basis);
  if (settings.bases.empty()) return set.directions;
  std::vector<BasisDirection> known = set.directions;
  if (std::ranges::count(known, flat_direction().name, &BasisDirection::name) == 0)
    known.push_back(flat_direction());
  std::vector<BasisDirection> chosen;
  for (const std::string& name : settings.bases) {
    const auto found = std::ranges::find(known, name, &BasisDirection::name);
    if (found == known.end()) fail(ExitCode::usage, "no basis '{}' in {}", name, set.name);
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace rnmbake
