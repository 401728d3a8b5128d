// What is under the cursor, by a ray through the drawables that are shown.
#pragma once

#include "scene/camera.hpp"
#include "scene/chunk.hpp"
#include "scene/pack.hpp"
#include "scene/section.hpp"

#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <tsl/robin_map.h>
#include <vector>

namespace triptych {

/// A place on a drawable.
struct Picked {
  DrawableId drawable = no_id;
  uint32_t placement = 0;  ///< counted from the drawable's first one
  uint32_t triangle = 0;   ///< of the chunk that it places
  glm::dvec3 point{0};     ///< model space
  glm::dvec3 normal{0};    ///< of the surface there, towards the eye; length 1
};

/// Keeps the chunks that rays met last. For one thread; the pack must outlive it.
class Picker {
 public:
  explicit Picker(const Pack& pack) : pack_(pack) {}

  /// The nearest triangle behind the near plane at a place of the window: pixels from its left and top, whose
  /// middles are at halves, of what a section keeps; where that shows a cut surface, the place is there, and
  /// the triangle the back behind it. Nullopt where there is background. Error for a damaged chunk.
  std::optional<Picked> at(const View& view, std::span<const DrawableId> shown, double x, double y,
                           const Section& section = {});
  /// What is so deep at a place of the window, model space.
  static glm::dvec3 place_at(const View& view, double x, double y, double depth);

 private:
  struct Ray {
    glm::dvec3 from, way;                                  ///< way: its part along the line of sight is 1
    double near;                                           ///< the first that counts, in lengths of `way`
    double far = std::numeric_limits<double>::infinity();  ///< the last one
    std::optional<SectionPlane> entered = std::nullopt;    ///< the side at which it comes into a section
  };
  static void cut(Ray& ray, const Section& section);
  static Ray ray(const View& view, double x, double y);
  void meet(const Ray& ray, DrawableId drawable, uint32_t placement, double& nearest,
            std::optional<Picked>& found);
  const Chunk& chunk(uint32_t number);

  const Pack& pack_;
  tsl::robin_map<uint32_t, std::shared_ptr<const Chunk>> chunks_;
  uint64_t kept_triangles_ = 0;
};

}  // namespace triptych
