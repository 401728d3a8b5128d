#include "preprocess/flat_colors.hpp"

namespace triptych {

void FlatColorSearch::add(const CornerColors& corners, uint32_t material) {
  if (!colors_) return;
  const std::optional<DisplayColor> flat = tint_.flat(corners, material);
  if (flat) colors_->insert(*flat);
  if (!flat || colors_->size() > max_flat_colors) colors_.reset();
}

}  // namespace triptych
