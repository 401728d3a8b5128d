// What lies under and around the cursor at full detail, whatever level of it is shown.
#pragma once

#include "scene/frame_state.hpp"
#include "view/picker.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// A triangle of a leaf's finest drawable, model space.
struct NearFacet {
  std::array<glm::dvec3, 3> corners;
  DrawableId drawable = no_id;
  uint32_t placement = 0, triangle = 0;
};

/// Where points of model space are in a picture.
class PictureSpace {
 public:
  explicit PictureSpace(const View& view);
  /// Right, up and backward from the eye, model units.
  glm::dvec3 from_eye(const glm::dvec3& point) const { return rotation_ * (point - view_.camera.eye); }
  /// Pixels from left and top, of a point as from_eye() has it; of perspective cameras one before the eye.
  glm::dvec2 pixel(const glm::dvec3& from_eye) const;
  /// Model units a pixel at that depth.
  double units_a_pixel(double depth) const;
  const View& view() const { return view_; }
  glm::dvec3 sight() const;  ///< of length 1

 private:
  View view_;
  glm::dmat3 rotation_;
};

class NearCursor {
 public:
  /// Finds the leaves of shown drawables whose boxes come within so many pixels of a place of the window, and
  /// what is under it there. Error for a damaged chunk.
  NearCursor(const Skeleton& skeleton, ChunkShelf& chunks, const FrameState& frame,
             std::span<const DrawableId> shown, const glm::dvec2& cursor, double pixels);

  /// The nearest triangle of finest drawables that the section keeps; nullopt where there is background.
  const std::optional<Picked>& hit() const { return hit_; }
  /// The step of the model's lattice: corners that are nearer to each other are one.
  double weld() const { return skeleton_.lattice().step; }
  /// The triangles of leaves no further away than the hit that come within the pixels. Empty where there are
  /// more than `most`: they are smaller than anybody could mean.
  std::vector<NearFacet> facets(size_t most) const;
  /// Whether nothing lies between the eye and a point within the pixels, and the section keeps it.
  bool sees(const glm::dvec3& point) const;
  const PictureSpace& space() const { return space_; }
  const glm::dvec2& cursor() const { return cursor_; }

 private:
  struct Place {
    double entry;  ///< the depth at which the rays around the cursor may meet its box
    DrawableId drawable;
    uint32_t placement;
  };
  /// The depth at which rays within so many pixels of the cursor may meet a box; infinite where they do not.
  double entry(const Box& box, double pixels, double deepest) const;
  /// Placements of leaves below those drawables that such rays may meet no deeper than that, by entry.
  std::vector<Place> collect(std::span<const DrawableId> shown, double pixels, double deepest) const;
  std::optional<Picked> nearest(std::span<const Place> places, const EyeRay& ray, double most) const;
  void add_facets(const Place& place, std::vector<NearFacet>& facets) const;
  const Placement& placement_of(const Place& place) const;

  const Skeleton& skeleton_;
  ChunkShelf& chunks_;
  SectionSides section_;
  std::shared_ptr<const HiddenObjects> hidden_;  ///< null where nothing is
  std::shared_ptr<const Poses> poses_;           ///< null where nothing moves
  PictureSpace space_;
  glm::dvec2 cursor_;
  double pixels_;
  EyeRay ray_;
  glm::dvec3 sight_;
  std::vector<Place> places_;  ///< within the pixels; none where there are too many
  std::optional<Picked> hit_;
  double hit_depth_;  ///< infinite where there is none
};

}  // namespace triptych
