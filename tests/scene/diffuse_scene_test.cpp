#include "scene/diffuse_scene.h"

#include "base/error.h"
#include "base/files.h"
#include "scene/test_exchange.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t header_bytes = 32, checksum_bytes = 8;

std::vector<char> bytes_of(const DiffuseScene& scene) {
  const std::string bytes = diffuse_scene_bytes(scene);
  return {bytes.begin(), bytes.end()};
}

/// The parts of a file, to be changed and put together again.
struct Parts {
  json content;
  std::string data;

  explicit Parts(const std::vector<char>& file) {
    std::uint64_t text_bytes = 0, data_bytes = 0;
    std::memcpy(&text_bytes, &file[16], 8);
    std::memcpy(&data_bytes, &file[24], 8);
    content =
        json::parse(file.begin() + header_bytes, file.begin() + header_bytes + std::ptrdiff_t(text_bytes));
    data.assign(&file[header_bytes + text_bytes], data_bytes);
  }

  [[nodiscard]] std::vector<char> file() const {
    const std::string text = content.dump();
    const std::uint64_t sizes[] = {text.size(), data.size()};
    std::string bytes("rnmscene\2\0\0\0\0\0\0\0", 16);
    bytes.append(reinterpret_cast<const char*>(sizes), 16);
    bytes += text + data + std::string(checksum_bytes, '\0');
    return {bytes.begin(), bytes.end()};
  }

  json& own() { return content["exchange"]; }
  void put(std::size_t offset, float value) { std::memcpy(&data[offset], &value, sizeof(value)); }
};

/// What is said of a file that was changed in one place.
std::string refusal(const std::function<void(Parts&)>& change, ExitCode code = ExitCode::invalid_input) {
  Parts parts(bytes_of(everything()));
  change(parts);
  try {
    (void)parse_diffuse_scene(parts.file(), "scene.rnmscene");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(std::string(error.what()).rfind("scene.rnmscene: ", 0), 0U) << error.what();
    return error.what();
  }
  return "it was read";
}

#define EXPECT_SAYS(text, ...)                             \
  do {                                                     \
    const std::string said = refusal(__VA_ARGS__);         \
    EXPECT_NE(said.find(text), std::string::npos) << said; \
  } while (false)

TEST(DiffuseScene, ComesBackAsItWasWritten) {
  const DiffuseScene before = everything();
  const DiffuseScene after = parse_diffuse_scene(bytes_of(before), "memory");
  EXPECT_EQ(diffuse_scene_bytes(after), diffuse_scene_bytes(before)) << "the same scene gives the same bytes";

  ASSERT_EQ(after.survey.objects.size(), 2U);
  EXPECT_EQ(after.survey.objects[0].key, "Wall/柱");
  EXPECT_EQ(after.survey.objects[0].to_world, before.survey.objects[0].to_world);
  EXPECT_EQ(after.survey.meshes[0].positions, before.survey.meshes[0].positions);
  EXPECT_EQ(after.survey.meshes[0].uv_layers[1].uv, square_uv());
  ASSERT_EQ(after.survey.probe_places.size(), 1U);
  EXPECT_EQ(after.survey.probe_places[0].name, "volume");
  EXPECT_EQ(after.survey.probe_places[0].counts, (std::array{4, 3, 2}));
  EXPECT_EQ(after.survey.probe_places[0].to_world, before.survey.probe_places[0].to_world);
  EXPECT_EQ(after.survey.lights[0].sizes, before.survey.lights[0].sizes);
  EXPECT_EQ(after.survey.materials.at("brick").outside_model, std::vector<std::string>{"glossy"});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(after.pictures[i].width, before.pictures[i].width);
    EXPECT_EQ(after.pictures[i].texels, before.pictures[i].texels) << before.pictures[i].name;
  }
  EXPECT_EQ(after.picture_uvs, before.picture_uvs);
  EXPECT_EQ(after.normal_maps[0].uv_layer, "UVMap");
  EXPECT_EQ(after.normal_maps[0].strength, 0.5F);
  EXPECT_EQ(after.materials[0].emission_picture, 1);
  EXPECT_EQ(after.materials[1].emission, Vec3(4, 2, 1));
  EXPECT_EQ(after.materials[0].transmittance_picture, 0);
  EXPECT_EQ(after.materials[1].transmittance, Vec3(0.25F, 0.5F, 0.75F));
  EXPECT_EQ(after.object_materials, before.object_materials);
  EXPECT_TRUE(after.takes_part(0));
  EXPECT_FALSE(after.takes_part(1));
  EXPECT_EQ(after.world.picture, 2);
  ASSERT_TRUE(after.camera);
  EXPECT_EQ(after.camera->to_world, before.camera->to_world);
  EXPECT_EQ(after.camera->shift_x, 0.125);
  EXPECT_EQ(after.outside[0].what, before.outside[0].what);
  EXPECT_EQ(after.outside[0].untraced, before.outside[0].untraced);
  EXPECT_EQ(after.survey.lights[0].max_bounces, before.survey.lights[0].max_bounces);
}

TEST(DiffuseScene, LightMayBeNegative) {
  DiffuseScene scene = everything();
  scene.materials[1].emission = Vec3(-2, 0, 1);
  scene.pictures[2].texels[0] = Vec3(-0.1F, 0, 0);
  scene.world.radiance = Vec3(0, -1, 0);
  const DiffuseScene after = parse_diffuse_scene(bytes_of(scene), "memory");
  EXPECT_EQ(after.materials[1].emission, Vec3(-2, 0, 1));
  EXPECT_EQ(after.pictures[2].texels[0], Vec3(-0.1F, 0, 0));
  EXPECT_EQ(after.world.radiance, Vec3(0, -1, 0));
}

TEST(DiffuseScene, KeepsPicturesInTheSmallestFormThatLosesNothing) {
  const Parts parts(bytes_of(everything()));
  const json& pictures = parts.content.at("exchange").at("pictures");
  EXPECT_EQ(pictures[0].at("form"), "u8");
  EXPECT_EQ(pictures[1].at("form"), "f16");
  EXPECT_EQ(pictures[2].at("form"), "f32");
}

TEST(DiffuseScene, LooksUpTheLastSlotForThosePastIt) {
  const DiffuseScene scene = everything();
  EXPECT_EQ(scene.material(0, 0).name, "brick");
  EXPECT_EQ(scene.material(0, 7).name, "lamp");
}

TEST(DiffuseScene, ReadsFilesAndFindsEveryDamage) {
  const TempFolder folder;
  const fs::path file = folder.path() / "room.rnmscene";
  write_diffuse_scene(file, everything());
  EXPECT_EQ(diffuse_scene_bytes(read_diffuse_scene(file)), diffuse_scene_bytes(everything()));

  const std::string whole = read_text(file);
  const auto refused = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      (void)read_diffuse_scene(file);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("room.rnmscene"), std::string::npos) << error.what();
      return std::string(error.what());
    }
    return std::string("it was read");
  };
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 50)
    EXPECT_NE(refused(whole.substr(0, size)), "it was read") << size;
  EXPECT_NE(refused(whole.substr(0, whole.size() - 1)).find("cut off"), std::string::npos);
  EXPECT_NE(refused(whole + "x"), "it was read");
  for (std::size_t place = 0; place < whole.size(); place += 1 + place / 50) {
    std::string bent = whole;
    bent[place] = char(bent[place] ^ 0x10);
    EXPECT_NE(refused(bent), "it was read") << place;
  }
  std::string rotten = whole;
  rotten[whole.size() - 100] ^= 1;
  EXPECT_NE(refused(rotten).find("checksum"), std::string::npos);
  std::string other = whole;
  other[8] = 3;
  EXPECT_NE(refused(other).find("format 3"), std::string::npos);
  EXPECT_NE(refused("not a scene at all, but long enough for a header").find("not a scene"),
            std::string::npos);
}

TEST(DiffuseScene, SaysThatAFileIsNotThere) {
  try {
    (void)read_diffuse_scene("/nowhere/room.rnmscene");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
  }
}

TEST(DiffuseScene, RefusesIndicesThatPointNowhere) {
  EXPECT_SAYS("object 'ghost': material 9 of 2", [](Parts& p) { p.own()["object_looks"][1][0] = 9; });
  EXPECT_SAYS("object 'ghost': it has no material",
              [](Parts& p) { p.own()["object_looks"][1] = json::array(); });
  EXPECT_SAYS("materials for 1 objects", [](Parts& p) { p.own()["object_looks"].erase(1); });
  EXPECT_SAYS("material 'brick': albedo picture 3 of 3",
              [](Parts& p) { p.own()["looks"][0]["albedo_picture"] = 3; });
  EXPECT_SAYS("material 'brick': transmittance picture 3 of 3",
              [](Parts& p) { p.own()["looks"][0]["transmittance_picture"] = 3; });
  EXPECT_SAYS("material 'brick': emission picture 2147483647 of 3",
              [](Parts& p) { p.own()["looks"][0]["emission_picture"] = std::uint64_t{1} << 40; });
  EXPECT_SAYS("no count", [](Parts& p) { p.own()["looks"][0]["emission_picture"] = 1e15; });
  EXPECT_SAYS("material 'brick': picture UVs 1 of 1",
              [](Parts& p) { p.own()["looks"][0]["picture_uv"] = 1; });
  EXPECT_SAYS("material 'brick': its picture has no UVs",
              [](Parts& p) { p.own()["looks"][0]["picture_uv"] = -1; });
  EXPECT_SAYS("material 'brick': normal map 2 of 2", [](Parts& p) { p.own()["looks"][0]["normal_map"] = 2; });
  EXPECT_SAYS("normal map 1: picture -1", [](Parts& p) { p.own()["normal_maps"][1]["picture"] = -1; });
  EXPECT_SAYS("no UV layer 'gone'", [](Parts& p) { p.own()["normal_maps"][0]["uv_layer"] = "gone"; });
  EXPECT_SAYS("world: picture 3 of 3", [](Parts& p) { p.own()["world"]["picture"] = 3; });
  EXPECT_SAYS("there is no object 2", [](Parts& p) { p.own()["unlit"] = {2}; });
  EXPECT_SAYS("object 'ghost': mesh 4", [](Parts& p) { p.content["objects"][1]["mesh"] = 4; });
  EXPECT_SAYS("object 'Wall/柱': 5 picture UVs for 6 corners",
              [](Parts& p) { p.own()["picture_uvs"][0]["count"] = 5; });
  EXPECT_SAYS("no count", [](Parts& p) { p.own()["picture_uvs"][0]["offset"] = -5; });
  EXPECT_SAYS("no count", [](Parts& p) { p.content["meshes"][0]["loops"] = 1.5; });
}

TEST(DiffuseScene, RefusesWhatIsNoNumber) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto offset = [](const json& entry) { return entry.at("offset").get<std::size_t>(); };
  EXPECT_SAYS("picture 'floats': texel (0, 0)",
              [&](Parts& p) { p.put(offset(p.own()["pictures"][2]), nan); });
  EXPECT_SAYS("picture 'floats'", [&](Parts& p) {
    p.put(offset(p.own()["pictures"][2]), std::numeric_limits<float>::infinity());
  });
  EXPECT_SAYS("picture UVs 0", [&](Parts& p) { p.put(offset(p.own()["picture_uvs"][0]), nan); });
  EXPECT_SAYS("object 'Wall/柱': vertex 0",
              [&](Parts& p) { p.put(p.content["meshes"][0]["positions"].get<std::size_t>(), nan); });
  EXPECT_SAYS("UV layer 'Lightmap'",
              [&](Parts& p) { p.put(offset(p.content["meshes"][0]["uv_layers"][1]), nan); });
  EXPECT_SAYS("material 'lamp': its albedo", [](Parts& p) { p.own()["looks"][1]["albedo"] = {2, 0, 0}; });
  EXPECT_SAYS("material 'lamp': its transmittance is not", [](Parts& p) {
    p.own()["looks"][1]["transmittance"] = {0, -0.5, 0};
  });
  EXPECT_SAYS("material 'lamp': its transmittance is not", [](Parts& p) {
    p.own()["looks"][1]["transmittance"] = {0, 1.5, 0};
  });
  EXPECT_SAYS("material 'lamp': its albedo and transmittance together are above 1", [](Parts& p) {
    p.own()["looks"][1]["transmittance"] = {0.5, 0.8, 0};
  });
  EXPECT_SAYS("material 'lamp': its emission", [](Parts& p) {
    p.own()["looks"][1]["emission"] = {1e300, 0, 0};
  });
  EXPECT_SAYS("emission of material 'lamp'", [](Parts& p) { p.own()["looks"][1]["emission"] = {1, 2}; });
  EXPECT_SAYS("world: its radiance", [](Parts& p) { p.own()["world"]["radiance"] = {0, 0, 1e300}; });
  EXPECT_SAYS("camera 'view'", [](Parts& p) { p.own()["camera"]["angle_x"] = 4; });
  EXPECT_SAYS("camera 'view'", [](Parts& p) { p.own()["camera"]["resolution_y"] = 0; });
  EXPECT_SAYS("camera 'view'", [](Parts& p) { p.own()["camera"]["matrix"] = std::vector<int>(16); });
  EXPECT_SAYS("object 'ghost': its matrix has 15",
              [](Parts& p) { p.content["objects"][1]["matrix"].erase(0); });
}

TEST(DiffuseScene, RefusesSizesThatTheFileDoesNotHold) {
  EXPECT_SAYS("picture 'bytes'", [](Parts& p) { p.own()["pictures"][0]["width"] = 65536; });
  EXPECT_SAYS("picture 'bytes': its size", [](Parts& p) { p.own()["pictures"][0]["width"] = 65537; });
  EXPECT_SAYS("picture 'bytes': its size", [](Parts& p) { p.own()["pictures"][0]["height"] = 0; });
  EXPECT_SAYS("its form is 'f64'", [](Parts& p) { p.own()["pictures"][0]["form"] = "f64"; });
  for (const char* count : {"vertices", "loops", "polygons", "triangles"}) {
    for (const std::uint64_t value :
         {std::uint64_t{1} << 40, std::uint64_t{0x5555555555555556}, ~std::uint64_t{0}})
      EXPECT_SAYS("the data ends within", [&](Parts& p) { p.content["meshes"][0][count] = value; });
  }
  EXPECT_SAYS("the data ends within",
              [](Parts& p) { p.own()["picture_uvs"][0]["offset"] = std::uint64_t{1} << 63; });
  EXPECT_SAYS("the data ends within", [](Parts& p) {  // a thousand times the same bytes would be a bomb
    for (int i = 0; i < 1000; ++i) p.content["meshes"].push_back(p.content["meshes"][0]);
  });
}

TEST(DiffuseScene, RefusesWhatIsMissingOrOfAnotherKind) {
  const Parts whole(bytes_of(everything()));
  for (const auto& [key, value] : whole.content.items()) {
    if (key == "probe_places") continue;  // files of before light probes have none
    EXPECT_NE(refusal([&, &gone = key](Parts& p) { p.content.erase(gone); }), "it was read") << key;
  }
  for (const auto& [key, value] : whole.content.at("exchange").items()) {
    EXPECT_NE(refusal([&, &gone = key](Parts& p) { p.own().erase(gone); }), "it was read") << key;
    EXPECT_NE(refusal([&, &bent = key](Parts& p) { p.own()[bent] = "text"; }), "it was read") << key;
  }
  EXPECT_SAYS(
      "another rnmbake", [](Parts& p) { p.content["format"] = 2; }, ExitCode::unsupported);
}

TEST(DiffuseScene, ReadsVersionOneWithoutTransmittance) {
  Parts parts(bytes_of(everything()));
  for (json& material : parts.own()["looks"]) {
    material.erase("transmittance");
    material.erase("transmittance_picture");
  }
  std::vector<char> file = parts.file();
  file[8] = 1;
  const DiffuseScene scene = parse_diffuse_scene(file, "old");
  for (const SurfaceMaterial& material : scene.materials) EXPECT_FALSE(material.see_through());
  EXPECT_TRUE(everything().materials[1].see_through());
}

TEST(DiffuseScene, BentBytesGiveErrorsAndNothingElse) {
  const std::vector<char> whole = bytes_of(everything());
  std::mt19937 random(7);
  int read = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<char> bent = whole;
    for (int i = 0; i < 3; ++i) bent[header_bytes + random() % (bent.size() - header_bytes)] = char(random());
    try {
      (void)parse_diffuse_scene(bent, "bent");
      ++read;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(read, 0) << "some of the bytes are harmless";
}

TEST(WorldUv, IsItsOwnInverse) {
  for (const Vec3& axis :
       {Vec3(1, 0, 0), Vec3(-1, 0.001F, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0.3F, 0.4F, 0.8F)}) {
    const Vec3 direction = axis.normalized();
    EXPECT_LT((world_direction(world_uv(direction)) - direction).length(), 1e-5F) << axis;
  }
  EXPECT_EQ(world_uv(Vec3(1, 0, 0)), Vec2(0.5F, 0.5F));
  EXPECT_EQ(world_uv(Vec3(0, 1, 0)), Vec2(0.25F, 0.5F));
  EXPECT_EQ(world_uv(Vec3(0, 0, 1)).y, 1);
}

}  // namespace
}  // namespace rnmbake
