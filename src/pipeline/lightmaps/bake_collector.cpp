#include "pipeline/lightmaps/bake_collector.h"

#include "bake/assemble.h"
#include "base/error.h"
#include "base/log.h"

#include <utility>

namespace rnmbake {

DeliveryDesk::DeliveryDesk(const BakeContext& context, const OutputSettings& output,
                           std::vector<DeliveryNote> notes)
    : context_(context),
      output_(output),
      notes_(std::move(notes)),
      shelves_(notes_.size()),
      deliveries_(notes_.size()) {
  for (const Unit& unit : context.plan.units) ++shelves_[unit.target].missing;
}

void DeliveryDesk::take(const Dispatch& dispatch, const DispatchLayout& layout,
                        std::vector<FloatImage> pictures) {
  std::vector<std::pair<std::size_t, Shelf>> complete;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const std::size_t tile = layout.tiles[i];
      const std::size_t target = context_.plan.tiles[tile].target;
      if (!deliveries_[target]) shelves_[target].pictures[tile] = std::move(pictures[i]);
    }
    for (const std::size_t unit : dispatch.units) {
      const std::size_t target = context_.plan.units[unit].target;
      if (--shelves_[target].missing == 0 && !deliveries_[target])
        complete.emplace_back(target, std::exchange(shelves_[target], {}));
    }
  }
  for (auto& [target, shelf] : complete) {
    Delivery delivery = finish(target, std::move(shelf));
    const std::lock_guard lock(mutex_);
    deliveries_[target] = std::move(delivery);
  }
}

void DeliveryDesk::give_up(std::size_t target, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (deliveries_[target]) return;
  deliveries_[target] = NotDelivered{reason};
  shelves_[target].pictures.clear();
  log::error("{}: {}", context_.targets[target].key, reason);
}

bool DeliveryDesk::is_settled(std::size_t target) const {
  const std::lock_guard lock(mutex_);
  return deliveries_[target].has_value();
}

Delivery DeliveryDesk::finish(std::size_t target_index, Shelf&& shelf) const {
  const Target& target = context_.targets[target_index];
  const DeliveryNote& note = notes_[target_index];
  std::vector<const Tile*> tiles;
  std::vector<FloatImage> pictures;
  for (auto& [tile, picture] : shelf.pictures) {
    tiles.push_back(&context_.plan.tiles[tile]);
    pictures.push_back(std::move(picture));
  }
  try {
    const TargetBakes bakes =
        assemble(target, tiles, pictures, context_.bases, note.surface.get(), output_.frames);
    return deliver_lightmap(bakes, note, output_);
  } catch (const Error& error) {
    if (error.code() == ExitCode::io) throw;  // the next target would meet the same disk
    log::error("{}", error.what());
    return NotDelivered{error.what()};
  }
}

}  // namespace rnmbake
