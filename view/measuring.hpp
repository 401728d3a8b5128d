// Measuring in the window: places that a person clicks on, and what is between them, in words and lines.
#pragma once

#include "scene/model_system.hpp"
#include "view/measurement.hpp"
#include "view/overlay.hpp"
#include "view/snap.hpp"

#include <optional>
#include <string>
#include <vector>

namespace triptych {

class Measuring {
 public:
  explicit Measuring(ModelSystem system) : system_(std::move(system)) {}

  bool active() const { return active_; }
  /// From here on clicks place points; a measurement that was being made stays in the picture.
  void begin();
  /// All measurements are gone.
  void end();
  /// All of them, and the one that is being made last.
  std::vector<Measured> all() const;
  /// As if these had been made, and the last one were being made.
  void go_on(std::vector<Measured> measured);
  /// What is under the cursor; the measurement goes on to there. True where that is another place.
  bool hover(std::optional<Snap> snap);
  /// Places the point under the cursor. On the first of three points or more it closes their polygon, and
  /// the next one begins another measurement. Returns what is to be said of it; empty where nothing is under
  /// the cursor. cursor: pixels.
  std::string click(const View& view, const glm::dvec2& cursor);
  /// Takes the last point back; false where there is none.
  bool take_back();

  /// A few words for a title; empty where nothing is measured.
  std::string title() const;
  void draw(Overlay& overlay) const;

  /// The places of the measurement that is being made, model space.
  const std::vector<glm::dvec3>& points() const { return made_.points; }

 private:
  std::string length_text(double model) const;
  std::string area_text(double model) const;
  std::string place_text(const glm::dvec3& model) const;
  std::string way_text(const glm::dvec3& from, const glm::dvec3& to) const;
  /// What it comes to, a line each.
  std::vector<std::string> results(const Measured& made) const;
  void draw(const Measured& made, Overlay& overlay) const;

  ModelSystem system_;
  bool active_ = false;
  std::optional<Snap> under_;
  Measured made_;
  std::vector<Measured> earlier_;
};

}  // namespace triptych
