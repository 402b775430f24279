#include "config/project_file.h"

#include "base/error.h"
#include "base/names.h"
#include "base/read_file.h"
#include "config/parse_toml.h"
#include "config/value.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace rnmbake {

namespace {

constexpr std::string_view override_table = "override", scenes_table = "scenes";

/// What every step needs to name a place in the file.
struct Reader {
  std::filesystem::path file;

  [[nodiscard]] std::string where(const toml::source_region& source) const {
    return fmt::format("{}:{}", file.string(), source.begin.line);
  }
  [[nodiscard]] std::string where(const toml::node& node) const { return where(node.source()); }
  [[nodiscard]] std::string where(const toml::key& key) const { return where(key.source()); }

  [[nodiscard]] std::string from_here(const std::string& path) const {
    const std::filesystem::path relative(path);
    if (path.empty() || relative.is_absolute()) return path;
    return (file.parent_path() / relative).lexically_normal().string();
  }
};

template <typename T>
std::optional<SettingValue> as(const toml::node& node) {
  if (const auto value = node.value_exact<T>()) return SettingValue(*value);
  return std::nullopt;
}

std::optional<SettingValue> text_list(const toml::node& node) {
  if (const auto one = node.value_exact<std::string>()) return std::vector<std::string>{*one};
  if (!node.is_array()) return std::nullopt;
  std::vector<std::string> list;
  for (const toml::node& item : *node.as_array()) {
    const auto text = item.value_exact<std::string>();
    if (!text) return std::nullopt;
    list.push_back(*text);
  }
  return list;
}

std::optional<SettingValue> value_of(SettingKind kind, const toml::node& node) {
  switch (kind) {
    case SettingKind::boolean:
      return as<bool>(node);
    case SettingKind::integer:
      return as<std::int64_t>(node);
    case SettingKind::real:
      if (const auto whole = node.value_exact<std::int64_t>()) return static_cast<double>(*whole);
      return as<double>(node);
    case SettingKind::text_list:
    case SettingKind::path_list:
      return text_list(node);
    case SettingKind::text:
    case SettingKind::choice:
    case SettingKind::path:
    case SettingKind::program:
      break;
  }
  return as<std::string>(node);
}

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

SettingOverride read_value(const Reader& reader, const Setting& setting, const toml::node& node) {
  const std::string where = reader.where(node);
  auto value = value_of(setting.kind, node);
  if (!value) {
    fail(ExitCode::usage, "{}: '{}' is {}; give {}", where, setting.key, type_name(node), accepted(setting));
  }
  *value = checked(setting, std::move(*value), where);
  if (setting.kind == SettingKind::path && std::get<std::string>(*value) != setting.no_path)
    *value = reader.from_here(std::get<std::string>(*value));
  if (setting.kind == SettingKind::path_list) {
    for (std::string& path : std::get<std::vector<std::string>>(*value)) path = reader.from_here(path);
  }
  if (setting.kind == SettingKind::program) {
    const std::string& program = std::get<std::string>(*value);
    if (program.find('/') != std::string::npos) *value = reader.from_here(program);
  }
  return {&setting, std::move(*value), SettingSource::project, where};
}

template <typename Belongs>
std::vector<std::string> keys_where(Belongs belongs) {
  std::vector<std::string> keys;
  for (const Setting& setting : settings()) {
    if (belongs(setting)) keys.emplace_back(setting.key);
  }
  return keys;
}

void read_table(const Reader& reader, std::string_view name, const toml::table& table, ProjectFile& project) {
  for (const auto& [key, node] : table) {
    const Setting* setting = find_setting(key.str());
    if (setting != nullptr && setting->table == name) {
      project.values.push_back(read_value(reader, *setting, node));
      continue;
    }
    if (setting != nullptr) {
      fail(ExitCode::usage, "{}: '{}' does not belong in [{}]; move it to [{}]", reader.where(key), key.str(),
           name, setting->table);
    }
    const auto keys = keys_where([&](const Setting& s) { return s.table == name; });
    fail(ExitCode::usage, "{}: unknown key '{}' in [{}]{}", reader.where(key), key.str(), name,
         did_you_mean(key.str(), keys));
  }
}

std::vector<std::string> override_patterns(const Reader& reader, const toml::table& table) {
  const toml::node* node = table.get("objects");
  if (node == nullptr) {
    fail(ExitCode::usage, "{}: [[override]] names no objects; add objects = \"floor*\"", reader.where(table));
  }
  const auto list = text_list(*node);
  if (!list || std::get<std::vector<std::string>>(*list).empty()) {
    fail(ExitCode::usage, "{}: 'objects' is {}; give a name or a list of names", reader.where(*node),
         node->is_array() ? "not a list of names" : type_name(*node));
  }
  return std::get<std::vector<std::string>>(*list);
}

ObjectOverride read_override(const Reader& reader, const toml::table& table) {
  ObjectOverride one{override_patterns(reader, table), reader.where(table), {}};
  for (const auto& [key, node] : table) {
    if (key.str() == "objects") continue;
    const Setting* setting = find_setting(key.str());
    if (setting == nullptr) {
      auto keys = keys_where([](const Setting& s) { return s.per_object; });
      keys.emplace_back("objects");
      fail(ExitCode::usage, "{}: unknown key '{}' in [[override]]{}", reader.where(key), key.str(),
           did_you_mean(key.str(), keys));
    }
    if (!setting->per_object) {
      fail(ExitCode::usage, "{}: '{}' holds for the whole bake; move it to [{}]", reader.where(key),
           key.str(), setting->table);
    }
    one.values.push_back(read_value(reader, *setting, node));
  }
  return one;
}

/// `written`: as it stands between the brackets.
const toml::array& list_of_tables(const Reader& reader, const toml::node& node, std::string_view name,
                                  std::string_view written) {
  const toml::array* list = node.as_array();
  if (list == nullptr || !list->is_homogeneous<toml::table>())
    fail(ExitCode::usage, "{}: '{}' is a list of tables; write [[{}]]", reader.where(node), name, written);
  return *list;
}

std::vector<ObjectOverride> read_overrides(const Reader& reader, const toml::node& node,
                                           std::string_view written) {
  std::vector<ObjectOverride> overrides;
  for (const toml::node& one : list_of_tables(reader, node, override_table, written))
    overrides.push_back(read_override(reader, *one.as_table()));
  return overrides;
}

ProjectScene read_scene(const Reader& reader, const toml::table& table) {
  ProjectScene scene;
  for (const auto& [key, node] : table) {
    if (key.str() == override_table) {
      scene.overrides = read_overrides(reader, node, "scenes.override");
      continue;
    }
    const Setting* setting = find_setting(key.str());
    if (setting == nullptr) {
      auto keys = keys_where([](const Setting&) { return true; });
      keys.emplace_back(override_table);
      fail(ExitCode::usage, "{}: unknown key '{}' in [[scenes]]{}", reader.where(key), key.str(),
           did_you_mean(key.str(), keys));
    }
    scene.values.push_back(read_value(reader, *setting, node));
    if (setting->key == "file") scene.file = std::get<std::string>(scene.values.back().value);
  }
  if (scene.file.empty())
    fail(ExitCode::usage, "{}: [[scenes]] names no scene; add file = \"hall.blend\"", reader.where(table));
  return scene;
}

void read_scenes(const Reader& reader, const toml::node& node, ProjectFile& project) {
  for (const toml::node& one : list_of_tables(reader, node, scenes_table, scenes_table))
    project.scenes.push_back(read_scene(reader, *one.as_table()));
}

void refuse_two_lists(const ProjectFile& project) {
  if (project.scenes.empty()) return;
  for (const SettingOverride& value : project.values) {
    if (value.setting->key == "file")
      fail(ExitCode::usage, "{}: [scene] names a file beside [[scenes]]; make it a [[scenes]] of its own",
           value.where);
  }
}

[[noreturn]] void unknown_at_top(const Reader& reader, const toml::key& key, bool is_table) {
  if (const Setting* setting = find_setting(key.str()); setting != nullptr && !is_table) {
    fail(ExitCode::usage, "{}: '{}' stands outside of any table; move it to [{}]", reader.where(key),
         key.str(), setting->table);
  }
  std::vector<std::string> names{std::string(override_table), std::string(scenes_table)};
  for (const SettingTable& table : setting_tables()) names.emplace_back(table.name);
  fail(ExitCode::usage, "{}: unknown {} '{}'{}", reader.where(key), is_table ? "table" : "key", key.str(),
       did_you_mean(key.str(), names));
}

bool is_setting_table(std::string_view name) {
  for (const SettingTable& table : setting_tables()) {
    if (table.name == name) return true;
  }
  return false;
}

}  // namespace

ProjectFile parse_project(std::string_view text, const std::filesystem::path& file) {
  const Reader reader{file};
  ProjectFile project{file, {}, {}, {}};
  const toml::table root = parse_toml(text, file.string(), ExitCode::usage);
  for (const auto& [key, node] : root) {
    if (key.str() == override_table) {
      project.overrides = read_overrides(reader, node, override_table);
    } else if (key.str() == scenes_table) {
      read_scenes(reader, node, project);
    } else if (key.str() == "scene" && node.is_array()) {
      fail(ExitCode::usage,
           "{}: a list of scenes is written [[scenes]]; [scene] is what holds for all of them",
           reader.where(key));
    } else if (is_setting_table(key.str())) {
      if (!node.is_table()) {
        fail(ExitCode::usage, "{}: '{}' is {}; write a table: [{}]", reader.where(key), key.str(),
             type_name(node), key.str());
      }
      read_table(reader, key.str(), *node.as_table(), project);
    } else {
      unknown_at_top(reader, key, node.is_table() || node.is_array_of_tables());
    }
  }
  refuse_two_lists(project);
  return project;
}

ProjectFile ProjectFile::of_scene(const ProjectScene& scene) const {
  ProjectFile one{file, values, overrides, {scene}};
  const auto sets = [&](std::string_view key) {
    return std::ranges::any_of(scene.values, [&](const SettingOverride& v) { return v.setting->key == key; });
  };
  if (sets("resolution") && !sets("texels_per_unit"))  // as an [[override]] that does
    std::erase_if(one.values, [](const SettingOverride& v) { return v.setting->key == "texels_per_unit"; });
  const bool has_others = scenes.size() > 1;
  for (SettingOverride& value : one.values) value.is_shared = has_others;
  for (ObjectOverride& shared : one.overrides) shared.is_shared = has_others;
  one.values.insert(one.values.end(), scene.values.begin(), scene.values.end());
  one.overrides.insert(one.overrides.end(), scene.overrides.begin(), scene.overrides.end());
  return one;
}

ProjectFile read_project(const std::filesystem::path& file) {
  return parse_project(read_text(file, largest_toml), file);
}

}  // namespace rnmbake
