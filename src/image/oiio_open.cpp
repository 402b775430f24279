#include "image/oiio_open.h"

#include "base/error.h"
#include "base/read_file.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace rnmbake {
namespace {

constexpr OIIO::imagesize_t most_bytes = 64ULL << 30;  // a header that promises more is taken as damaged

std::optional<Attribute> attribute_of(const OIIO::ParamValue& value) {
  const OIIO::TypeDesc type = value.type();
  if (type == OIIO::TypeDesc::STRING) return Attribute(value.get_string());
  if (type == OIIO::TypeDesc::INT) return Attribute(value.get_int());
  if (type == OIIO::TypeDesc::FLOAT) return Attribute(value.get_float());
  if (type.basetype != OIIO::TypeDesc::FLOAT) return std::nullopt;
  const auto* numbers = static_cast<const float*>(value.data());
  return Attribute(std::vector<float>(numbers, numbers + type.basevalues()));
}

}  // namespace

std::map<std::string, Attribute> attributes_of(const OIIO::ImageSpec& spec) {
  std::map<std::string, Attribute> attributes;
  for (const OIIO::ParamValue& value : spec.extra_attribs) {
    const std::string name = value.name().string();
    if (name.starts_with("oiio:")) continue;  // the library's own remarks, not the file's
    if (auto attribute = attribute_of(value)) attributes[name] = *attribute;
  }
  return attributes;
}

void set_attribute(OIIO::ImageSpec& spec, const std::string& name, const Attribute& value) {
  if (const auto* text = std::get_if<std::string>(&value)) spec.attribute(name, *text);
  if (const auto* whole = std::get_if<int>(&value)) spec.attribute(name, *whole);
  if (const auto* number = std::get_if<float>(&value)) spec.attribute(name, *number);
  if (const auto* list = std::get_if<std::vector<float>>(&value)) {
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, static_cast<int>(list->size())), list->data());
  }
}

void fail_damaged(const std::filesystem::path& file, std::string reason) {
  std::ranges::replace(reason, '\n', ' ');
  fail(ExitCode::invalid_input, "{} is damaged, truncated or not a picture: {}", file.string(),
       reason.empty() ? "no reason given" : reason);
}

std::unique_ptr<OIIO::ImageInput> open_picture(const std::filesystem::path& file) {
  require_regular_file(file);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha",
                   1);  // or the colours of a normal map come multiplied by its alpha
  auto in = OIIO::ImageInput::open(file.string(), &config);
  if (!in) fail_damaged(file, OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.deep) fail(ExitCode::unsupported, "{} is a deep image; flatten it first", file.string());
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 ||
      spec.image_pixels() > most_bytes / sizeof(float) / static_cast<unsigned>(spec.nchannels)) {
    fail_damaged(file, fmt::format("its header promises {}x{}x{} texels of {} channels", spec.width,
                                   spec.height, spec.depth, spec.nchannels));
  }
  return in;
}

}  // namespace rnmbake
