// image/picture_rows.h - pictures read and written a few rows at a time, so that none has to fit into memory.
#pragma once

#include "image/layered_exr.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

/// How a file stores one value.
enum class Storage : std::uint8_t { u8, u16, half, full };

struct PictureFacts {
  int width = 0, height = 0;
  std::vector<std::string> channels;  // in the file's order; a palette is already looked up
  bool is_integer = false;            // values come as shares of the type's largest
  std::string storage;                // "uint8", "half", ...
  std::map<std::string, Attribute> attributes;
};

/// Any format of OpenImageIO. Values as they are stored, whatever colour space the file claims; colours
/// without their alpha multiplied in.
class PictureReader {
 public:
  /// Throws Error(io) where the file cannot be opened, Error(invalid_input) where it is no sound picture.
  explicit PictureReader(std::filesystem::path file);
  ~PictureReader();
  PictureReader(const PictureReader&) = delete;
  PictureReader& operator=(const PictureReader&) = delete;

  [[nodiscard]] const PictureFacts& facts() const { return facts_; }

  /// `channels` channels from `first` on, interleaved, of rows [begin, end). Fastest from top to bottom.
  /// Throws Error(invalid_input) where the file ends early.
  void read(int begin, int end, int first, int channels, std::span<float> out);

 private:
  struct Input;
  std::filesystem::path file_;
  std::unique_ptr<Input> input_;
  PictureFacts facts_;
};

/// What the writer is told before the first row.
struct PictureForm {
  int width = 0, height = 0;
  std::vector<std::string> channels;  // "R", "G", "B", "A"; one channel: "Y"
  Storage storage = Storage::u8;
  std::map<std::string, Attribute> attributes;
};

/// .png, .tga, .tif or .exr, whole or not at all; values are data, so that no transfer curve is declared and
/// nothing is multiplied by alpha. Integers are clamped and rounded. The attribute "ImageDescription" is kept
/// by all four, others by .png (numbers as text) and .exr only.
class PictureWriter {
 public:
  /// Throws Error(usage) where the file's ending cannot hold the form, Error(io) where it cannot be created.
  PictureWriter(const std::filesystem::path& file, const PictureForm& form);
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Rows [begin, end), from top to bottom without a gap.
  void write(int begin, int end, std::span<const float> values);

  /// After the last row: the file appears under its name.
  void commit();

 private:
  struct Output;
  std::unique_ptr<Output> output_;
};

/// Why a file of this ending cannot hold values stored so; empty where it can. Names the endings that can.
[[nodiscard]] std::string storage_obstacle(const std::filesystem::path& file, Storage storage);

}  // namespace rnmbake
