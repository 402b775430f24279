#include "pipeline/study/encoding_study.h"

#include "base/error.h"
#include "base/text_table.h"
#include "encoding/codecs/describe_codec.h"
#include "encoding/codecs/make_codec.h"
#include "encoding/direction_sets.h"
#include "encoding/random_light.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

namespace rnmbake {
namespace {

std::vector<BasisSet> candidate_sets() {
  std::vector<BasisSet> sets{flat_and_rnm()};
  for (const char* name : {"l1", "h6", "sg", "sh3"}) sets.push_back(direction_set(name).value());
  return sets;
}

std::string percent(double share) {
  return fmt::format("{:.1f}", 100 * share);
}

TextTable table_of(const std::vector<EncodingErrors>& errors) {
  TextTable table;
  TextTable::Row header{"encoding", "bakes", "bytes"};
  for (const double limit : tilt_limits) header.push_back(fmt::format("<= {:g}", limit));
  header.emplace_back("flat bias");
  table.add(std::move(header));
  for (const EncodingErrors& one : errors) {
    if (!one.unfit.empty()) continue;
    TextTable::Row row{one.label, std::to_string(one.bakes), std::to_string(one.bytes)};
    for (const double rms : one.rms) row.push_back(percent(rms));
    row.push_back(fmt::format("{:+.1f}", 100 * one.flat_bias));
    table.add(std::move(row));
  }
  return table;
}

struct StudiedCodec {
  EncodingErrors errors;  // what they are of; the figures are 0
  std::unique_ptr<const Codec> codec;
  std::vector<std::size_t> feeds;  // [directions of the codec] -> directions of the study

  [[nodiscard]] std::vector<Vec3> encoded(std::span<const Vec3> at_fed) const {
    std::vector<Vec3> layers(codec->layers().size()), irradiance;
    irradiance.reserve(feeds.size());
    for (const std::size_t place : feeds) irradiance.push_back(at_fed[place]);
    (void)codec->encode(irradiance, layers);
    return layers;
  }

  /// Takes the first of the sets, small ones first, that `fed` holds and the codec can be made from.
  void feed(const BasisSet& fed) {
    for (const BasisSet& set : candidate_sets()) {
      std::vector<std::size_t> places;
      for (const BasisDirection& basis : set.directions)
        if (const auto place = place_of(fed, basis)) places.push_back(*place);
      if (places.size() < set.directions.size()) continue;
      try {
        codec = make_codec(errors.codec, set);
      } catch (const Error& error) {
        errors.unfit = error.what();
        continue;
      }
      errors.unfit.clear();
      feeds = std::move(places);
      errors.bakes = feeds.size();
      errors.bytes = stored_bytes(errors.codec, codec->layers().size());
      return;
    }
  }
};

/// The narrowest of tilt_limits that holds the normal.
std::size_t band_of(const Vec3& normal) {
  const double degrees = std::acos(std::clamp(double(normal.z), -1.0, 1.0)) * 180 / pi;
  const auto* limit = std::ranges::find_if(tilt_limits, [&](double most) { return degrees <= most + 1e-3; });
  return static_cast<std::size_t>(limit - tilt_limits.begin());
}

double sum_of(const Vec3& colour) {
  return double(colour.x) + colour.y + colour.z;
}

}  // namespace

struct EncodingStudy::Setup {
  std::vector<StudiedCodec> codecs;
  std::vector<Vec3> normals;
  std::vector<std::size_t> bands;  // [normals]; tilt_limits.size(): steeper than all
  std::size_t flat = 0;            // place among the directions
};

EncodingStudy::EncodingStudy(const BasisSet& fed, const std::vector<Vec3>& normals) {
  auto setup = std::make_shared<Setup>();
  for (const CodecOptions& options : encodings_to_study()) {
    StudiedCodec& studied = setup->codecs.emplace_back();
    studied.errors.label = label_of(options);
    studied.errors.codec = options;
    studied.feed(fed);
  }
  setup->normals = normals;
  for (const Vec3& normal : normals) setup->bands.push_back(band_of(normal));
  setup->flat = needed_direction(fed, flat_direction(), "flat");
  sums_.resize(setup->codecs.size());
  setup_ = std::move(setup);
}

EncodingStudy EncodingStudy::another() const {
  EncodingStudy empty = *this;
  empty.sums_.assign(sums_.size(), {});
  empty.flat_squares_ = empty.flat_sum_ = 0;
  empty.lights_ = 0;
  return empty;
}

void EncodingStudy::add_codec(std::size_t codec, std::span<const Vec3> at_fed,
                              std::span<const Vec3> at_normals) {
  const StudiedCodec& studied = setup_->codecs[codec];
  if (!studied.codec) return;
  Sums& sums = sums_[codec];
  const std::vector<Vec3> layers = studied.encoded(at_fed);
  for (std::size_t i = 0; i < at_normals.size(); ++i) {
    const Vec3 error = studied.codec->decode(layers, setup_->normals[i]) - at_normals[i];
    if (setup_->bands[i] == tilt_limits.size()) continue;
    sums.squares[setup_->bands[i]] += double(error.dot(error));
    sums.errors[setup_->bands[i]] += sum_of(error);
  }
  sums.flat_error += sum_of(studied.codec->decode(layers, Vec3(0, 0, 1)) - at_fed[setup_->flat]);
}

void EncodingStudy::add(std::span<const Vec3> at_fed, std::span<const Vec3> at_normals) {
  for (std::size_t codec = 0; codec < sums_.size(); ++codec) add_codec(codec, at_fed, at_normals);
  const Vec3& flat = at_fed[setup_->flat];
  flat_squares_ += double(flat.dot(flat));
  flat_sum_ += sum_of(flat);
  ++lights_;
}

void EncodingStudy::merge(const EncodingStudy& other) {
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    for (std::size_t band = 0; band < tilt_limits.size(); ++band) {
      sums_[i].squares[band] += other.sums_[i].squares[band];
      sums_[i].errors[band] += other.sums_[i].errors[band];
    }
    sums_[i].flat_error += other.sums_[i].flat_error;
  }
  flat_squares_ += other.flat_squares_;
  flat_sum_ += other.flat_sum_;
  lights_ += other.lights_;
}

Vec3 EncodingStudy::decoded(std::size_t encoding, std::span<const Vec3> at_fed, const Vec3& normal) const {
  const StudiedCodec& studied = setup_->codecs[encoding];
  return studied.codec ? studied.codec->decode(studied.encoded(at_fed), normal) : Vec3(0);
}

std::vector<EncodingErrors> EncodingStudy::errors() const {
  std::vector<EncodingErrors> all;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    EncodingErrors& errors = all.emplace_back(setup_->codecs[i].errors);
    if (!errors.unfit.empty() || !(flat_squares_ > 0)) continue;
    double squares = 0, sum = 0, normals = 0;
    for (std::size_t band = 0; band < tilt_limits.size(); ++band) {
      squares += sums_[i].squares[band];
      sum += sums_[i].errors[band];
      normals += double(std::ranges::count(setup_->bands, band));
      if (normals == 0) continue;
      errors.rms[band] = std::sqrt(squares / (normals * flat_squares_));
      errors.bias[band] = sum / (normals * flat_sum_);
    }
    errors.flat_bias = sums_[i].flat_error / flat_sum_;
  }
  return all;
}

std::vector<CodecOptions> encodings_to_study() {
  std::vector<CodecOptions> all;
  for (const std::string& name : codec_names()) {
    all.push_back({name});
    if (!holds_four_numbers(name)) continue;
    for (const double range : {2.0, 4.0}) all.push_back({name, range, 8, false});
    all.push_back({name, 2, 8, true});
  }
  return all;
}

std::string study_table(const std::vector<EncodingErrors>& errors) {
  std::ostringstream out;
  table_of(errors).write(out);
  return out.str();
}

std::string study_markdown(const std::vector<EncodingErrors>& errors) {
  std::ostringstream out;
  table_of(errors).write_markdown(out);
  return out.str();
}

nlohmann::json study_json(const std::vector<EncodingErrors>& errors, std::size_t lights) {
  auto list = nlohmann::json::array();
  for (const EncodingErrors& one : errors) {
    nlohmann::json entry{{"encoding", one.codec.name},
                         {"range", one.codec.range},
                         {"bits", one.codec.bits},
                         {"mono", one.codec.mono},
                         {"label", one.label}};
    if (one.unfit.empty()) {
      entry["bakes"] = one.bakes;
      entry["bytes"] = one.bytes;
      entry["rms"] = one.rms;
      entry["bias"] = one.bias;
      entry["flat_bias"] = one.flat_bias;
    } else {
      entry["unfit"] = one.unfit;
    }
    list.push_back(std::move(entry));
  }
  return {{"lights", lights}, {"tilt_limits", tilt_limits}, {"encodings", list}};
}

}  // namespace rnmbake
