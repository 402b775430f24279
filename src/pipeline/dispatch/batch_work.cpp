#include "pipeline/dispatch/batch_work.h"

#include "base/files.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rnmbake {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

// Samples of the first round, and limits of how many times as many there are after the next one.
constexpr int first_round = 32;
constexpr double least_growth = 1.5, most_growth = 4;

/// Part of the time that is left in which a round is to end: it must not take longer than it may.
constexpr double share_of_time = 0.9;

}  // namespace

BatchWork::BatchWork(const Plan& plan, Batch batch, BakeRequest request, fs::path folder, const Rules& rules,
                     const EarlierPictures& earlier, const PassCache& cache)
    : plan_(plan),
      batch_(std::move(batch)),
      request_(std::move(request)),
      folder_(std::move(folder)),
      rules_(rules),
      cache_(cache),
      started_(rules.clock->now()) {
  const CyclesSettings& cycles = plan_.tasks[batch_.tasks.front()].cycles;
  seed_ = cycles.seed;
  wanted_ = cycles.samples;
  noise_ = cycles.noise;
  rules_.whole |= cycles.mirrors;  // few samples each: what is cut are their batches
  if (cache_.is_on()) key_ = cache_.key_of(request_, folder_);
  texels_ = double(texels_of(plan_, layout().rects));
  for (const std::size_t rect : layout().rects) {
    const auto found = earlier.find(rect);
    pictures_.push_back(found != earlier.end() ? found->second : BakedPicture{});
  }
  HalfSamples done{0, 0};
  for (const BakedPicture& picture : pictures_) {
    for (const std::size_t half : {0U, 1U}) done[half] = std::max(done[half], picture.samples[half]);
  }
  plan_passes(done);
  told_ = texels_ * wanted_ - earlier_;
}

json BatchWork::launch_request() const {
  json request = request_.json;
  request["by_rounds"] = by_rounds();
  request["left_out"] = is_complete() ? std::vector<std::size_t>{} : left_out_[next_];
  request["passes"] = json::array();
  for (std::size_t i = next_; i < passes_.size(); ++i) {
    if (i > next_ && cache_.has(key_of(i))) continue;
    request["passes"].push_back(pass_request(passes_[i], i, layout(), seed_));
  }
  return request;
}

void BatchWork::take_kept() {
  while (!is_complete()) {
    auto pictures = find_kept();
    if (!pictures) return;
    kept_ += texels_ * passes_[next_].count;
    add(next_, std::move(*pictures));
  }
}

/// The next pass, of its own or cut out of a whole's.
std::optional<std::vector<BakedPicture>> BatchWork::find_kept() const {
  for (const WholeBatch& whole : rules_.wholes) {
    const ResultKey key = PassCache::key_of(whole.request, passes_[next_], seed_, left_out_[next_]);
    auto all = cache_.has(key) ? cache_.find(key, whole.rects.size()) : std::nullopt;
    if (!all) continue;
    std::vector<BakedPicture> own;
    for (const std::size_t rect : layout().rects) {
      const auto place = std::ranges::find(whole.rects, rect) - whole.rects.begin();
      own.push_back(std::move((*all)[std::size_t(place)]));
    }
    return own;
  }
  return cache_.find(key_of(next_), pictures_.size());
}

void BatchWork::take_finished(bool keep_files) {
  while (!is_complete()) {
    const std::size_t before = next_, planned = passes_.size();
    const std::vector<std::string> files = pass_files(next_, layout());
    if (fs::exists(folder_ / files.back())) {
      take_baked();
      for (const std::string& file : files) {
        if (!keep_files) fs::remove(folder_ / file);
      }
    } else if (cache_.has(key_of(next_))) {
      take_kept();  // the launch was told to leave it out
    }
    if (next_ == before) return;
    if (by_rounds() && next_ >= planned) answer(planned);
  }
}

/// The next pass, whose files are there.
void BatchWork::take_baked() {
  std::vector<FloatImage> rects = read_rects(layout(), plan_, folder_, next_);
  const SamplePass pass = passes_[next_];
  std::vector<BakedPicture> pictures(rects.size());
  for (std::size_t i = 0; i < rects.size(); ++i) pictures[i].add(pass.half, std::move(rects[i]), pass.count);
  cache_.keep(key_of(next_), pictures);
  add(next_, std::move(pictures));
}

EarlierPictures BatchWork::so_far() const {
  EarlierPictures earlier;
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    if (pictures_[i].all_samples() > 0) earlier[layout().rects[i]] = pictures_[i];
  }
  return earlier;
}

std::vector<SamplePass> BatchWork::passes_left() const {
  return {passes_.begin() + std::ptrdiff_t(next_), passes_.end()};
}

std::vector<ResultKey> BatchWork::used_keys() const {
  std::vector<ResultKey> keys;
  for (std::size_t i = 0; i < next_ && cache_.is_on(); ++i) keys.push_back(key_of(i));
  return keys;
}

double BatchWork::take_less_work() {
  const double now = work();
  return std::exchange(told_, now) - now;
}

double BatchWork::work_of(std::size_t first, std::size_t last) const {
  double samples = 0;
  for (std::size_t i = first; i < last; ++i) samples += passes_[i].count;
  return samples * texels_;
}

HalfSamples BatchWork::shared_out(int samples) const {
  return rules_.halves ? in_halves(samples) : HalfSamples{samples, 0};
}

void BatchWork::plan_passes(const HalfSamples& done) {
  reached_ = done;
  earlier_ = texels_ * (done[0] + done[1]);
  if (!rules_.only.empty()) {
    passes_ = rules_.only;
    left_out_.resize(passes_.size());
    wanted_ = done[0] + done[1];
    for (const SamplePass& pass : passes_) wanted_ += pass.count;
  } else if (rules_.whole) {
    passes_ = {{0, 0, wanted_, wanted_}};
    left_out_.resize(1);
  } else if (by_rounds()) {
    plan_round();
  } else {
    passes_ = cut_into_passes(done, shared_out(wanted_), rules_.cost);
    left_out_.resize(passes_.size());
  }
}

/// Plans passes to as many samples as the noisiest targets may need, or as fit into the time; none where all
/// is quiet enough, or time is up. What is quiet enough is left out: all of a target at once, so that no map
/// of it is noisier than another.
void BatchWork::plan_round() {
  std::vector<std::size_t> quiet;
  double least_ratio = 1e9, greatest_ratio = 0;  // of the noise that is left to the noise that is wanted
  if (noise_ > 0) {
    const std::map<std::size_t, double> noise = noise_by_target();
    for (std::size_t i = 0; i < layout().rects.size(); ++i) {
      const double ratio = noise.at(plan_.rects[layout().rects[i]].target) / noise_;
      if (ratio <= 1) quiet.push_back(i);
      if (ratio > 1) least_ratio = std::min(least_ratio, ratio);
      greatest_ratio = std::max(greatest_ratio, ratio);
    }
    if (reached_[1] > 0) expected_ = expected_work(greatest_ratio);
  }
  if (quiet.size() == layout().rects.size()) {
    expected_ = std::max(work_of(0, passes_.size()), 1.0);
    return;
  }
  int samples = noise_ > 0 ? samples_of_round(least_ratio) : wanted_;
  if (rules_.deadline) samples = std::min(samples, samples_in_time());
  HalfSamples wanted = shared_out(std::min(samples, wanted_));
  for (const std::size_t half : {0U, 1U}) wanted[half] = std::max(wanted[half], reached_[half]);
  for (SamplePass& pass : cut_into_passes(reached_, wanted, rules_.cost)) {
    pass.of = shared_out(wanted_)[std::size_t(pass.half)];
    passes_.push_back(pass);
    left_out_.push_back(quiet);
  }
  reached_ = wanted;
}

/// Variance falls as samples grow: as many as the quietest of those that are left needs.
int BatchWork::samples_of_round(double least_ratio) const {
  const double samples = reached_[0] + reached_[1];
  if (samples == 0) return first_round;
  const double growth = std::clamp(1.05 * least_ratio * least_ratio, least_growth, most_growth);
  return static_cast<int>(std::min(std::ceil(samples * growth), 1e9));
}

/// Until the noisiest is quiet enough.
double BatchWork::expected_work(double greatest_ratio) const {
  const double samples = reached_[0] + reached_[1];
  return texels_ * std::min(samples * greatest_ratio * greatest_ratio, double(wanted_)) - earlier_;
}

int BatchWork::samples_in_time() const {
  const int samples = reached_[0] + reached_[1];
  if (passes_.empty()) return samples + first_round;
  const double now = rules_.clock->now(), left = share_of_time * (*rules_.deadline - now);
  const double baked = (work_of(0, passes_.size()) - kept_) / texels_;
  const double seconds_each = baked > 0 ? (now - started_) / baked : rules_.cost.sample_seconds;
  const double more = std::floor(left / std::max(seconds_each, 1e-9));
  if (more * seconds_each < 2 * rules_.cost.fixed_seconds) return samples;  // hardly worth a call
  return samples + static_cast<int>(std::clamp(more, 0.0, std::max(3.0 * samples, 2.0)));
}

std::map<std::size_t, double> BatchWork::noise_by_target() const {
  std::map<std::size_t, double> noisiest;
  std::size_t position = 0;
  for (const std::size_t task : batch_.tasks) {
    NoiseSums noise;
    bool known = true;
    for (const std::size_t rect : plan_.tasks[task].rects) {
      const BakedPicture& picture = pictures_[position++];
      if (plan_.rects[rect].pass.role != ReceiverPass::Role::basis) continue;
      known = known && picture.has_error();
      noise.add(picture);
    }
    double& worst = noisiest[plan_.tasks[task].target];
    worst = std::max(worst, known ? noise.relative() : 1e9);
  }
  return noisiest;
}

ResultKey BatchWork::key_of(std::size_t pass) const {
  return PassCache::key_of(key_, passes_[pass], seed_, left_out_[pass]);
}

void BatchWork::add(std::size_t pass, std::vector<BakedPicture> pictures) {
  const SamplePass samples = passes_[pass];
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (std::ranges::binary_search(left_out_[pass], i)) continue;
    pictures_[i].add(samples.half, std::move(pictures[i].halves[std::size_t(samples.half)]), samples.count);
  }
  ++next_;
  if (by_rounds() && next_ == passes_.size()) plan_round();
}

/// Tells the launch, which has baked all passes that it knew of, how to go on; nothing: it ends.
void BatchWork::answer(std::size_t number) const {
  json more{{"passes", json::array()}, {"left_out", json::array()}};
  if (!is_complete()) more["left_out"] = left_out_[next_];
  for (std::size_t i = next_; i < passes_.size(); ++i)
    more["passes"].push_back(pass_request(passes_[i], i, layout(), seed_));
  write_atomically(folder_ / ("go" + std::to_string(number) + ".json"), more.dump());
}

}  // namespace rnmbake
