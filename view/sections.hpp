// What a person cuts away, to look inside.
#pragma once

#include "scene/section.hpp"
#include "view/picker.hpp"
#include "view/window.hpp"

#include <optional>
#include <string>

namespace triptych {

/// The section of a view, changed by keys and wheel. Of several planes the last one is in hand, and without
/// planes the box is.
class Sections {
 public:
  /// size: of the model, its diagonal.
  Sections(const Section& section, double size) : section_(section), size_(size) {}

  const Section& section() const { return section_; }

  /// What the commands act on.
  struct Scene {
    glm::dvec3 eye;
    std::optional<Picked> under_cursor;
    Box box;                   ///< of what is selected, or of the model
    bool is_selected = false;  ///< whether it is of what is selected
  };
  static bool takes(Command command);
  /// What there is to say of it; empty: nothing.
  std::string take(Command command, const Scene& scene);
  /// Moves the plane in hand so many steps towards what it keeps: each a fiftieth of its distance from the
  /// eye, which is measured where it was begun, or a 5,000th of the model's size if that is more. Without
  /// planes a box gets smaller, by a fiftieth of its sides a step.
  void move(double steps, const glm::dvec3& eye);
  /// As if that had been cut away at first.
  void begin_at(const Section& section);

  /// "cut by 2 planes and a box", for a title; empty where nothing is cut.
  std::string words() const;

 private:
  /// The plane in hand: where it was begun, and how far it was moved since.
  struct Hand {
    glm::dvec3 at;
    double step;  ///< model units
    double steps = 0;
  };
  Hand hand(const glm::dvec3& at, const glm::dvec3& eye) const;
  void replace_last(const SectionPlane& plane);
  void toggle_box(const Scene& scene);
  void shrink_box(double steps);
  std::string begin(const Picked& under, const glm::dvec3& eye);

  Section section_;
  double size_;
  std::optional<Hand> hand_;
};

}  // namespace triptych
