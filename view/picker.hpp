// What is under the cursor, by a ray through the drawables that are shown.
#pragma once

#include "scene/frame_state.hpp"
#include "view/placed_chunk.hpp"

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace triptych {

/// A place on a drawable.
struct Picked {
  DrawableId drawable = no_id;
  uint32_t placement = 0;  ///< counted from the drawable's first one
  uint32_t triangle = 0;   ///< of the chunk that it places
  glm::dvec3 point{0};     ///< model space
  glm::dvec3 normal{0};    ///< of the surface there, towards the eye; length 1
};

/// What lies at a place of the window: from + t · way, t >= near. t is the depth along the line of sight.
struct EyeRay {
  glm::dvec3 from{0}, way{0};
  double near = 0;
};
/// x, y: pixels from the window's left and top, whose middles are at halves.
EyeRay eye_ray(const View& view, double x, double y);

/// Keeps the chunks that rays met last. For one thread; the pack must outlive it.
class Picker {
 public:
  explicit Picker(const Pack& pack) : pack_(pack), chunks_(pack) {}

  /// The nearest triangle behind the near plane at a place of the window (eye_ray()). What is hidden or cut
  /// away is not met; where a section shows a cut surface, the place is there, and the triangle the back
  /// behind it. Nullopt where there is background. Error for a damaged chunk.
  std::optional<Picked> at(const FrameState& frame, std::span<const DrawableId> shown, double x, double y);
  /// The nearest triangle at full detail of all that is not hidden or cut away, from + t · way with t >=
  /// least.
  std::optional<Picked> along(const FrameState& frame, const glm::dvec3& from, const glm::dvec3& way,
                              double least);
  /// What is so deep at a place of the window, model space.
  static glm::dvec3 place_at(const View& view, double x, double y, double depth);
  ChunkShelf& chunks() { return chunks_; }

 private:
  /// drawable_of(scene node): what it shows; no_id of those that are to be looked into.
  template <typename DrawableOf>
  std::optional<Picked> nearest(PlacedRay ray, const FrameState& frame, const DrawableOf& drawable_of);

  const Pack& pack_;
  ChunkShelf chunks_;
};

}  // namespace triptych
