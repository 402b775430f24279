#include "cli/inspect_write.h"

#include "base/object_notes.h"
#include "base/text.h"
#include "base/text_table.h"
#include "scene/lighting.h"

#include <map>
#include <ostream>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

using nlohmann::json;

std::string layer_names(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const UvLayer& layer : mesh.uv_layers) names.push_back(layer.name);
  return names.empty() ? "-" : fmt::format("{}", fmt::join(names, ", "));
}

TextTable::Row row_of(const InspectedObject& object) {
  TextTable::Row row{object.object->key, object.object->type, std::to_string(object.mesh->triangles()),
                     layer_names(*object.mesh)};
  if (!object.not_baked.empty()) {
    row.insert(row.end(), {"-", "-", "-", "not baked: " + object.not_baked});
    return row;
  }
  const std::string size = fmt::format("{0} x {0}", object.resolution);
  row.push_back(object.lightmap_layer.empty() ? "(unwrap)" : object.lightmap_layer);
  row.push_back(object.parts == 1 ? size : counted(object.parts, "part"));
  row.push_back(object.uv ? fmt::format("{:.3g}", object.uv->density.median) : "-");
  row.push_back(fmt::format("{}", fmt::join(object.problems, "; ")));
  return row;
}

/// Instances of one object by one instancer that are alike become one row; so do those that are not selected.
std::vector<TextTable::Row> grouped_rows(const std::vector<InspectedObject>& objects) {
  struct Group {
    TextTable::Row row;
    std::size_t count = 0;
  };
  std::vector<Group> groups;
  std::map<TextTable::Row, std::size_t> known;
  for (const InspectedObject& object : objects) {
    if (object.not_baked == not_selected) continue;
    const TextTable::Row row = row_of(object);
    TextTable::Row alike = row;
    const SceneObject& it = *object.object;
    if (!it.instancer.empty()) alike.front() = it.instancer + "/" + it.name + "#*";
    const auto [entry, is_new] = known.try_emplace(alike, groups.size());
    if (is_new) groups.push_back({row, 0});
    Group& group = groups[entry->second];
    if (++group.count == 2) group.row = alike;
  }
  std::vector<TextTable::Row> rows;
  for (Group& group : groups) {
    if (group.count > 1) group.row.front() += fmt::format(" ({})", group.count);
    rows.push_back(std::move(group.row));
  }
  return rows;
}

void write_not_selected(const std::vector<InspectedObject>& objects, std::ostream& out) {
  std::vector<std::string> keys;
  for (const InspectedObject& object : objects) {
    if (object.not_baked == not_selected) keys.push_back(object.object->key);
  }
  if (!keys.empty())
    out << '\n' << printable(fmt::format("not selected ({}): {}", keys.size(), first_names(keys, 8))) << '\n';
}

void write_lights(const SceneSurvey& survey, std::ostream& out) {
  for (const LightInfo& light : survey.lights) {
    std::string line = fmt::format("light     {} ({}, {:g})", light.name, light.type, light.energy);
    if (!light.outside_model.empty()) line += fmt::format(": {}", fmt::join(light.outside_model, ", "));
    out << printable(line) << '\n';
  }
  out << fmt::format("world     {}", survey.world);
  if (survey.world != "none") out << fmt::format(" ({:g})", survey.world_strength);
  out << '\n';
  if (!may_be_lit(survey)) out << "nothing lights this scene: bake needs --allow-dark\n";
}

json uv_json(const UvReport& uv) {
  return {
      {"charts", uv.charts},
      {"mirrored_charts", uv.mirrored_charts},
      {"covered_texels", uv.covered_texels},
      {"overlap_texels", uv.overlap_texels},
      {"outside_texels", uv.outside_texels},
      {"udim_triangles", uv.tile_triangles},
      {"outside_corners", uv.outside_corners},
      {"degenerate_uv_triangles", uv.degenerate_uv},
      {"degenerate_triangles", uv.degenerate_world},
      {"doubled_triangles", uv.doubled},
      {"uv_area", uv.uv_area},
      {"world_area", uv.world_area},
      {"texels_per_unit", {{"min", uv.density.min}, {"median", uv.density.median}, {"max", uv.density.max}}}};
}

json object_json(const InspectedObject& object) {
  json layers = json::array();
  for (const UvLayer& layer : object.mesh->uv_layers) layers.push_back(layer.name);
  json result{{"key", object.object->key},
              {"name", object.object->name},
              {"instancer", object.object->instancer},
              {"type", object.object->type},
              {"triangles", object.mesh->triangles()},
              {"uv_layers", layers},
              {"material_slots", object.object->slots},
              {"baked", object.not_baked.empty()},
              {"problems", object.problems}};
  if (!object.not_baked.empty()) {
    result["not_baked"] = object.not_baked;
    return result;
  }
  result["lightmap_layer"] = object.lightmap_layer.empty() ? json() : json(object.lightmap_layer);
  result["tangent_layer"] = object.tangent_layer.empty() ? json() : json(object.tangent_layer);
  result["resolution"] = object.resolution;
  result["parts"] = object.parts;
  result["uv"] = object.uv ? uv_json(*object.uv) : json();
  return result;
}

json light_json(const LightInfo& light) {
  return {{"name", light.name},
          {"type", light.type},
          {"energy", light.energy},
          {"color", light.color},
          {"outside_model", light.outside_model}};
}

}  // namespace

void write_inspection(const SceneSurvey& survey, const Inspection& inspection, std::ostream& out) {
  TextTable table;
  table.add({"OBJECT", "TYPE", "TRIANGLES", "UV LAYERS", "LIGHTMAP", "SIZE", "TEXELS/UNIT", "PROBLEMS"});
  for (TextTable::Row& row : grouped_rows(inspection.objects)) table.add(std::move(row));
  table.write(out);
  write_not_selected(inspection.objects, out);
  out << '\n';
  write_lights(survey, out);
  for (const MaterialInfo* material : inspection.outside_model) {
    out << printable(fmt::format("material  {}: beyond diffuse and emission: {}", material->name,
                                 fmt::join(material->outside_model, ", ")))
        << '\n';
  }
}

nlohmann::json inspection_json(const SceneSurvey& survey, const Inspection& inspection) {
  json result{
      {"schema_version", 1},
      {"scene", survey.scene_file},
      {"blender", survey.blender_version},
      {"objects", json::array()},
      {"lights", json::array()},
      {"materials", json::array()},
      {"world", {{"kind", survey.world}, {"strength", survey.world_strength}, {"color", survey.world_color}}},
      {"warnings", survey.warnings}};
  for (const InspectedObject& object : inspection.objects) result["objects"].push_back(object_json(object));
  for (const LightInfo& light : survey.lights) result["lights"].push_back(light_json(light));
  for (const auto& [name, material] : survey.materials) {
    result["materials"].push_back({{"name", name},
                                   {"normal_mapped", material.normal_mapped},
                                   {"emissive", material.emissive},
                                   {"outside_model", material.outside_model}});
  }
  return result;
}

}  // namespace rnmbake
