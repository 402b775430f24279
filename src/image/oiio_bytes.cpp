#include "image/oiio_bytes.h"

#include "base/error.h"
#include "base/files.h"

#include <string>
#include <string_view>

#include <OpenImageIO/filesystem.h>

namespace rnmbake {

void write_encoded(const std::filesystem::path& file, const char* format, const OIIO::ImageSpec& spec,
                   const std::function<bool(OIIO::ImageOutput&)>& write_pixels) {
  OIIO::Filesystem::IOVecOutput bytes;
  auto out = OIIO::ImageOutput::create(format);
  if (!out || !out->supports("ioproxy") || !out->set_ioproxy(&bytes)) {
    fail(ExitCode::environment, "cannot write {}: this OpenImageIO has no {} writer; install one that has",
         file.string(), format);
  }
  // The name only tells the writer the format; nothing is opened under it.
  if (!out->open(std::string("memory.") + format, spec) || !write_pixels(*out) || !out->close()) {
    fail(ExitCode::io, "cannot encode {}: {}", file.string(), out->geterror());
  }
  const auto& buffer = bytes.buffer();
  write_atomically(file, std::string_view(reinterpret_cast<const char*>(buffer.data()), buffer.size()));
}

}  // namespace rnmbake
