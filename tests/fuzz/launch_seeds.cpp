// launch_seeds FOLDER: results, progress and surveys of launches from which fuzzing starts.
#include "base/files.h"
#include "scene/diffuse_scene_parts.h"
#include "scene/test_exchange.h"

#include <cstdio>
#include <filesystem>

int main(int argc, char** argv) {
  using namespace rnmbake;
  if (argc != 2) {
    std::fprintf(stderr, "usage: launch_seeds FOLDER\n");
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  write_atomically(folder / "ok", R"(r{"nonce": "n", "ok": {"survey": "survey.json", "blend": null}})");
  write_atomically(folder / "refused",
                   R"(r{"nonce": "n", "refused": {"code": 3, "message": "no faces", "object": "Cube"}})");
  write_atomically(folder / "failed",
                   R"(r{"nonce": "n", "failed": {"message": "x", "traceback": "line 1\n"}})");
  write_atomically(
      folder / "progress",
      "p{\"phase\": \"bake\", \"what\": \"Cube\", \"done\": 1, \"total\": 2.5}\n{\"phase\": 3}\n");
  for (const bool exported : {false, true}) {
    std::string data;
    nlohmann::json content = store_diffuse_scene(everything(), data);
    content["data"] = "survey.bin";
    content["data_bytes"] = data.size();
    if (!exported) content.erase("exchange");
    std::string seed = exported ? "e" : "s";
    seed += content.dump();
    seed += '\0';
    write_atomically(folder / (exported ? "exported" : "survey"), seed + data);
  }
  return 0;
}
