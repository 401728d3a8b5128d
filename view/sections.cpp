#include "view/sections.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace triptych {

namespace {

/// Normals that are this near to an axis are meant to be along it: the cosine of five degrees.
constexpr double along_axis_cosine = 0.9962;
constexpr double step_share = 1.0 / 50, least_step = 1.0 / 5000, box_margin = 0.01, box_rounding = 1e-6;
const std::string place = "section";

glm::dvec3 straightened(const glm::dvec3& normal) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(normal[axis]) < along_axis_cosine) continue;
    glm::dvec3 along(0);
    along[axis] = normal[axis] > 0 ? 1 : -1;
    return along;
  }
  return normal;
}

}  // namespace

bool Sections::takes(Command command) {
  return command == Command::begin_section || command == Command::flip_section ||
         command == Command::delete_section || command == Command::push_section ||
         command == Command::pull_section || command == Command::toggle_section_box;
}

std::string Sections::take(Command command, const Scene& scene) {
  const std::span<const SectionPlane> planes = section_.planes();
  if (command == Command::toggle_section_box) {
    toggle_box(scene);
    return {};
  }
  if (command == Command::begin_section) {
    if (planes.size() == Section::max_planes)
      return fmt::format("there are {} planes already", planes.size());
    return scene.under_cursor ? begin(*scene.under_cursor, scene.eye)
                              : "there is nothing under the cursor to cut at";
  }
  if (planes.empty() && section_.box() && command != Command::flip_section) {
    if (command == Command::delete_section) {
      section_.remove_box();
    } else {
      shrink_box(command == Command::push_section ? 1 : -1);
    }
    return {};
  }
  if (planes.empty()) return "there is no section plane; X begins one under the cursor";
  const SectionPlane last = planes.back();
  if (command == Command::flip_section) {
    if (hand_) hand_ = Hand{hand_->at + hand_->steps * hand_->step * last.normal, hand_->step};
    replace_last({-last.normal, -last.offset});
  } else if (command == Command::delete_section) {
    section_.remove_plane(static_cast<uint32_t>(planes.size() - 1));
    hand_.reset();
  } else {
    move(command == Command::push_section ? 1 : -1, scene.eye);
  }
  return {};
}

void Sections::begin_at(const Section& section) {
  section_ = section;
  hand_.reset();
}

/// A little larger than what is in it, so that its faces do not lie in the sides. What is selected since the
/// box was set gets a new one.
void Sections::toggle_box(const Scene& scene) {
  const glm::dvec3 more((scene.box.hi - scene.box.lo) * box_margin + least_step * size_);
  const Box around{scene.box.lo - more, scene.box.hi + more};
  // Files of viewpoints round what they keep.
  const double rounding = box_rounding * size_;
  const auto alike = [&](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::all(glm::lessThanEqual(glm::abs(a - b), glm::dvec3(rounding)));
  };
  const bool same =
      section_.box() && alike(section_.box()->lo, around.lo) && alike(section_.box()->hi, around.hi);
  if (section_.box() && (!scene.is_selected || same)) {
    section_.remove_box();
  } else {
    section_.set_box(around, place);
  }
}

void Sections::shrink_box(double steps) {
  const glm::dvec3 middle = (section_.box()->lo + section_.box()->hi) * 0.5;
  const glm::dvec3 half = (section_.box()->hi - middle) * std::pow(1 - step_share, steps);
  section_.set_box({middle - half, middle + half}, place);
}

/// What the surface hides is kept: the plane is pushed into it from there.
std::string Sections::begin(const Picked& under, const glm::dvec3& eye) {
  const glm::dvec3 normal = glm::dvec3(0) - straightened(under.normal);
  section_.add_plane({normal, glm::dot(normal, under.point)}, place);
  hand_ = hand(under.point, eye);
  return {};
}

void Sections::move(double steps, const glm::dvec3& eye) {
  if (section_.planes().empty()) {
    if (section_.box()) shrink_box(steps);
    return;
  }
  const SectionPlane last = section_.planes().back();
  if (!hand_) hand_ = hand(eye - last.distance(eye) * last.normal, eye);
  hand_->steps += steps;
  replace_last({last.normal, glm::dot(last.normal, hand_->at) + hand_->steps * hand_->step});
}

Sections::Hand Sections::hand(const glm::dvec3& at, const glm::dvec3& eye) const {
  return {at, std::max(step_share * glm::distance(at, eye), least_step * size_)};
}

void Sections::replace_last(const SectionPlane& plane) {
  section_.remove_plane(static_cast<uint32_t>(section_.planes().size() - 1));
  section_.add_plane(plane, place);
}

std::string Sections::words() const {
  const size_t count = section_.planes().size();
  std::string words = count == 0 ? "" : count == 1 ? "1 plane" : fmt::format("{} planes", count);
  if (section_.box()) words += words.empty() ? "a box" : " and a box";
  return words.empty() ? words : "cut by " + words;
}

}  // namespace triptych
