#include "shaders/dialect.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>
#include <vector>

namespace rnmbake {
namespace {

/// The defines of rnmbake_types.glsl.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> hlsl_words{{
    {"vec2", "float2"},
    {"vec3", "float3"},
    {"vec4", "float4"},
    {"mix", "lerp"},
}};

std::string sampler(const std::string& name, Dialect dialect) {
  return dialect == Dialect::hlsl ? "Texture2D " + name + ", SamplerState " + name + "_sampler"
                                  : "sampler2D " + name;
}

std::string argument(const std::string& name, Dialect dialect) {
  return dialect == Dialect::hlsl ? name + ", " + name + "_sampler" : name;
}

std::string sample(const std::string& name, const std::string& uv, Dialect dialect) {
  if (dialect == Dialect::hlsl) return name + ".SampleLevel(" + name + "_sampler, " + uv + ", 0.0)";
  if (dialect == Dialect::hlsl9) return "tex2Dlod(" + name + ", float4(" + uv + ", 0.0, 0.0))";
  return "textureLod(" + name + ", " + uv + ", 0.0)";
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Walks over the text and writes it anew.
class Rewriter {
 public:
  Rewriter(std::string_view text, Dialect dialect) : text_(text), dialect_(dialect) {}

  std::string run() {
    while (place_ < text_.size()) step();
    return std::move(out_);
  }

 private:
  void step() {
    if (text_.substr(place_).starts_with("//")) {
      out_ += take_until(text_.find('\n', place_));
    } else if (is_word(text_[place_])) {
      const auto end = std::find_if_not(text_.begin() + place_, text_.end(), is_word);
      out_ += rewritten(take_until(static_cast<std::size_t>(end - text_.begin())));
    } else {
      out_ += text_[place_++];
    }
  }

  std::string_view take_until(std::size_t end) {
    const std::string_view taken = text_.substr(place_, end - place_);
    place_ += taken.size();
    return taken;
  }

  std::string rewritten(std::string_view word) {
    if (word == "RNM_SAMPLER2D") return sampler(arguments().at(0), dialect_);
    if (word == "RNM_ARGUMENT") return argument(arguments().at(0), dialect_);
    if (word == "RNM_SAMPLE") {
      const auto given = arguments();
      return sample(given.at(0), given.at(1), dialect_);
    }
    if (dialect_ == Dialect::glsl) return std::string(word);
    const auto known = std::ranges::find(hlsl_words, word, [](const auto& pair) { return pair.first; });
    return std::string(known == hlsl_words.end() ? word : known->second);
  }

  /// Of a macro whose name was just taken: what stands between its brackets, split at commas, rewritten.
  std::vector<std::string> arguments() {
    std::vector<std::string> given;
    std::size_t begin = place_ + 1;
    for (int depth = 0; place_ < text_.size(); ++place_) {
      const char c = text_[place_];
      if (c == '(') ++depth;
      if (c == ')') --depth;
      if (depth > 1 || (depth == 1 && c != ',')) continue;
      std::string_view one = text_.substr(begin, place_ - begin);
      while (one.starts_with(' ')) one.remove_prefix(1);
      given.push_back(in_dialect(one, dialect_));
      begin = place_ + 1;
      if (depth == 0) break;
    }
    ++place_;
    return given;
  }

  std::string_view text_;
  Dialect dialect_;
  std::size_t place_ = 0;
  std::string out_;
};

}  // namespace

std::string in_dialect(std::string_view text, Dialect dialect) {
  return Rewriter(text, dialect).run();
}

}  // namespace rnmbake
