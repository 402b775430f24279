#include "base/error.h"
#include "base/files.h"
#include "base/text.h"
#include "image/oiio_open.h"
#include "image/picture_rows.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <exception>
#include <optional>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

struct Format {
  std::string_view ending;
  std::array<bool, 4> holds;  // by Storage
};
constexpr std::array formats{
    Format{".png", {true, true, false, false}}, Format{".tga", {true, false, false, false}},
    Format{".tif", {true, true, true, true}}, Format{".tiff", {true, true, true, true}},
    Format{".exr", {false, false, true, true}}};

OIIO::TypeDesc type_of(Storage storage) {
  constexpr std::array types{OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16, OIIO::TypeDesc::HALF,
                             OIIO::TypeDesc::FLOAT};
  return types[static_cast<std::size_t>(storage)];
}

/// Only EXR has numbers among its attributes.
Attribute fitting(const std::string& ending, const Attribute& value) {
  if (ending == ".exr") return value;
  if (const auto* whole = std::get_if<int>(&value)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<float>(&value)) return fmt::format("{}", *number);
  if (const auto* list = std::get_if<std::vector<float>>(&value))
    return fmt::format("{}", fmt::join(*list, ","));
  return value;
}

OIIO::ImageSpec spec_of(const std::string& ending, const PictureForm& form) {
  OIIO::ImageSpec spec(form.width, form.height, static_cast<int>(form.channels.size()),
                       type_of(form.storage));
  spec.channelnames = form.channels;
  spec.alpha_channel = form.channels.size() == 4 && form.channels[3] == "A" ? 3 : -1;
  for (const auto& [name, value] : form.attributes) set_attribute(spec, name, fitting(ending, value));
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("DateTime", "");  // or EXR stores the time of day, and two equal runs would differ
  if (ending == ".exr" || ending.starts_with(".tif")) spec.attribute("compression", "zip");
  spec.attribute("png:compressionLevel", 3);  // data is noisy: more takes longer and saves little
  if (spec.image_bytes(true) > 3'000'000'000ULL) spec.attribute("tiff:bigtiff", 1);
  return spec;
}

/// What the library writes, at the place where it wants it. Libraries in C cannot be thrown through, so the
/// first failure is kept.
class FileProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit FileProxy(AtomicFile& file) : IOProxy("", Write), file_(file) {}
  [[nodiscard]] const char* proxytype() const override { return "rnmbake"; }
  bool seek(int64_t offset) override {
    m_pos = offset;
    return true;
  }
  size_t write(const void* bytes, size_t size) override {
    const size_t written = pwrite(bytes, size, m_pos);
    m_pos += static_cast<int64_t>(written);
    return written;
  }
  size_t pwrite(const void* bytes, size_t size, int64_t offset) override {
    if (failure_) return 0;
    try {
      file_.write_at({static_cast<const char*>(bytes), size}, offset);
    } catch (...) {
      failure_ = std::current_exception();
      return 0;
    }
    size_ = std::max(size_, static_cast<size_t>(offset) + size);
    return size;
  }
  [[nodiscard]] size_t size() const override { return size_; }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  AtomicFile& file_;
  size_t size_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

std::string storage_obstacle(const std::filesystem::path& file, Storage storage) {
  const std::string ending = lower_extension(file);
  const auto* format = std::ranges::find(formats, ending, &Format::ending);
  const auto at = static_cast<std::size_t>(storage);
  if (format != formats.end() && format->holds[at]) return "";
  constexpr std::array words{"8-bit", "16-bit", "half", "float"};
  std::string fit;
  for (const Format& other : formats)
    if (other.holds[at]) fit += fmt::format("{}{}", fit.empty() ? "" : ", ", other.ending);
  if (format == formats.end())
    return fmt::format("the ending '{}' is no format that it writes; use one of {}", ending, fit);
  return fmt::format("{} holds no {} values; use one of {}", ending, words[at], fit);
}

struct PictureWriter::Output {
  Output(const std::filesystem::path& path, const PictureForm& form)
      : name(path.string()), atomic(path), proxy(atomic) {
    const std::string ending = lower_extension(path);
    file = OIIO::ImageOutput::create(ending.substr(1));
    if (!file || !file->supports("ioproxy") || !file->set_ioproxy(&proxy)) {
      fail(ExitCode::environment, "cannot write {}: this OpenImageIO has no {} writer; install one that has",
           name, ending);
    }
    // The name only tells the writer the format; nothing is opened under it.
    check(file->open("memory" + ending, spec_of(ending, form)));
  }
  ~Output() {
    if (file) file->close();  // before the proxy goes
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void check(bool good) const {
    proxy.rethrow();
    if (!good) fail(ExitCode::io, "cannot encode {}: {}", name, file->geterror());
  }

  std::string name;
  AtomicFile atomic;
  FileProxy proxy;
  std::unique_ptr<OIIO::ImageOutput> file;
};

PictureWriter::PictureWriter(const std::filesystem::path& file, const PictureForm& form) {
  const std::string obstacle = storage_obstacle(file, form.storage);
  if (!obstacle.empty()) fail(ExitCode::usage, "cannot write {}: {}", file.string(), obstacle);
  output_ = std::make_unique<Output>(file, form);
}

PictureWriter::~PictureWriter() = default;

void PictureWriter::write(int begin, int end, std::span<const float> values) {
  assert(values.size() % static_cast<std::size_t>(end - begin) == 0);
  output_->check(output_->file->write_scanlines(begin, end, 0, OIIO::TypeDesc::FLOAT, values.data()));
}

void PictureWriter::commit() {
  const bool closed = output_->file->close();
  output_->check(closed);
  output_->file.reset();
  output_->atomic.commit();
}

}  // namespace rnmbake
