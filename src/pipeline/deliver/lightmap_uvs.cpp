#include "pipeline/deliver/lightmap_uvs.h"

#include "base/read_file.h"
#include "pipeline/scene/launch_answer.h"
#include "pipeline/scene/scene_survey.h"
#include "scene/blob.h"

#include <cstddef>
#include <utility>

namespace rnmbake {

std::vector<std::vector<Vec2>> lightmap_uvs(BlenderSession& session,
                                            const std::vector<std::string>& objects) {
  Launch launch =
      launch_on(session, "lightmap_uvs_entry.py", "lightmap-uvs", BlendPath(session.settings().scene.file));
  launch.request["objects"] = objects;
  const std::filesystem::path folder = launch.folder;
  const nlohmann::json answer = session.run(std::move(launch));
  const std::string data = read_data(answered_file(answer, "file", folder));
  Blob blob(data.data(), data.size());
  std::vector<std::vector<Vec2>> uvs;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::size_t corners = 3 * count_of(answer.at("triangles").at(i), "triangles");
    uvs.push_back(blob.cut<Vec2>({{"uvs", offset}}, "uvs", corners,
                                 [&] { return "the lightmap UVs of '" + objects[i] + "': "; }));
    offset += corners * sizeof(Vec2);
  }
  return uvs;
}

}  // namespace rnmbake
