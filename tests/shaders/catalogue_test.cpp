#include "shaders/catalogue.h"

#include "base/error.h"
#include "shaders/dialect.h"
#include "shaders/engines.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::vector<std::string> names_of(const std::vector<const ShaderFile*>& files) {
  std::vector<std::string> names;
  for (const ShaderFile* file : files) names.push_back(file->name);
  return names;
}

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto place = text.find(part); place != std::string::npos; place = text.find(part, place + 1)) ++count;
  return count;
}

TEST(Catalogue, EveryFileSaysWhatItIsFor) {
  EXPECT_GT(shader_files().size(), 10U);
  for (const ShaderFile& file : shader_files()) {
    EXPECT_GT(file.purpose.size(), 20U) << file.name;
    EXPECT_EQ(times(file.text, "#include"), 0U) << file.name;
  }
}

TEST(Catalogue, FilesComeOnceAndAfterWhatTheyNeed) {
  EXPECT_EQ(names_of(with_needs({"ssbump", "rnm"})), (std::vector<std::string>{"rnm", "ssbump"}));
  EXPECT_EQ(with_needs({}).size(), shader_files().size());
}

TEST(Catalogue, EncodingsThatShareAFileAreKnownByTheirOwnNames) {
  EXPECT_EQ(shader_named("h6").name, "hbasis");
  EXPECT_EQ(shader_named("dominant").name, "directions");
  EXPECT_EQ(shader_named("rnm-vrad").name, "rnm");
}

TEST(Catalogue, MistypedNamesGetTheNearest) {
  try {
    (void)shader_named("ssbum");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("did you mean 'ssbump'"), std::string::npos) << error.what();
  }
}

TEST(Dialect, HlslHasItsWordsButInComments) {
  EXPECT_EQ(in_dialect("vec3 mixed = mix(a.vec, vec2(b), 0.5); // vec3, mix\nvec4 x;", Dialect::hlsl),
            "float3 mixed = lerp(a.vec, float2(b), 0.5); // vec3, mix\nfloat4 x;");
  EXPECT_EQ(in_dialect("vec3 a = mix(b, c, 0.5);", Dialect::glsl), "vec3 a = mix(b, c, 0.5);");
}

TEST(Dialect, SamplersAreThoseOfTheLanguage) {
  const std::string text =
      "f(RNM_SAMPLER2D(map), vec2 uv) { g(RNM_ARGUMENT(map), RNM_SAMPLE(map, h(uv, 1) * vec2(1, 2)).x); }";
  EXPECT_EQ(in_dialect(text, Dialect::glsl),
            "f(sampler2D map, vec2 uv) { g(map, textureLod(map, h(uv, 1) * vec2(1, 2), 0.0).x); }");
  EXPECT_EQ(in_dialect(text, Dialect::hlsl),
            "f(Texture2D map, SamplerState map_sampler, float2 uv) { g(map, map_sampler, "
            "map.SampleLevel(map_sampler, h(uv, 1) * float2(1, 2), 0.0).x); }");
  EXPECT_EQ(in_dialect(text, Dialect::hlsl9),
            "f(sampler2D map, float2 uv) { g(map, tex2Dlod(map, float4(h(uv, 1) * float2(1, 2), 0.0, "
            "0.0)).x); }");
}

TEST(Engines, NoMacroOfThePreludeIsLeft) {
  for (const ShaderEngine& engine : shader_engines()) {
    if (engine.dialect == Dialect::wgsl) continue;
    const std::string text = shader_text(engine, {});
    EXPECT_EQ(times(text, "RNM_"), 0U) << engine.name;
    EXPECT_EQ(times(text, "vec3 rnm_decode_squared("), engine.dialect == Dialect::glsl ? 1U : 0U)
        << engine.name;
    EXPECT_EQ(times(text, "float3 rnm_decode_squared("), engine.dialect == Dialect::glsl ? 0U : 1U)
        << engine.name;
  }
}

/// Every function of a WGSL file has its GLSL namesake.
TEST(Engines, WgslHasSomeOfTheFunctions) {
  const ShaderEngine& bevy = engine_named("bevy");
  const std::string text = shader_text(bevy, {}), glsl = shader_text(engine_named("glsl"), {});
  EXPECT_EQ(shaders_of(bevy), (std::vector<std::string>{"rnm", "sh2", "ssbump", "zh3"}));
  EXPECT_GE(times(text, "\nfn "), 12U);
  for (auto place = text.find("\nfn "); place != std::string::npos; place = text.find("\nfn ", place + 1)) {
    const std::string name = text.substr(place + 4, text.find('(', place) - place - 4);
    EXPECT_GE(times(glsl, " " + name + "("), 1U) << name;
  }
  EXPECT_THROW((void)shader_text(bevy, {"sh3"}), Error);
}

TEST(Engines, UnrealGetsAStructWithoutGuards) {
  const std::string text = shader_text(engine_named("unreal"), {"rnm"});
  EXPECT_EQ(times(text, "struct RnmBake"), 1U);
  EXPECT_EQ(times(text, "#"), 0U);
}

}  // namespace
}  // namespace rnmbake
