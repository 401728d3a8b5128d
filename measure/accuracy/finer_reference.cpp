#include "measure/accuracy/finer_reference.hpp"

#include "measure/accuracy/cover.hpp"

namespace triptych {

std::span<const FinerReference::Picture> FinerReference::pictures() {
  if (!pictures_.empty()) return pictures_;
  for (const glm::dvec2& shift : pixel_shifts(shifts)) {
    const FrameView view(*reference_.skeleton, shifted(reference_.state, shift), reference_.rules);
    pictures_.push_back({view, draw_(view)});
  }
  return pictures_;
}

}  // namespace triptych
