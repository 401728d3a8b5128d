#include "samples/services/runs.hpp"

#include "samples/placing.hpp"
#include "samples/services/duct_parts.hpp"
#include "samples/services/fixture_parts.hpp"
#include "samples/services/hospital_plan.hpp"
#include "samples/services/pipe_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace triptych {
namespace {

using Vec = glm::dvec3;

/// What a run is made of; places are given as transforms of the parts.
struct RunKind {
  double piece = 3, bend = 0;  ///< a piece's greatest length; the radius of a bend
  std::function<void(const glm::dmat4&, double length)> straight;
  std::function<void(const glm::dmat4&)> turn, joint;
  std::function<void(const glm::dmat4&, double below_slab)> hanger;
};

int millimetres(double length) { return static_cast<int>(std::lround(length * 1000)); }

void lay_straight(const RunKind& kind, const Vec& from, const Vec& direction, double length,
                  const Hanging& hanging) {
  constexpr double least = 0.02;
  if (length < least) return;
  for (double at = 0; at < length - least; at += kind.piece) {
    const double piece = std::min(kind.piece, length - at);
    kind.straight(laid(from + at * direction, direction), piece);
    if (at > 0 && kind.joint) kind.joint(laid(from + at * direction, direction));
  }
  if (hanging.spacing <= 0 || std::abs(direction.y) > 0.5 || !kind.hanger || length < 0.4) return;
  const int count = std::max(1, static_cast<int>(std::ceil(length / hanging.spacing)));
  for (int i = 0; i < count; ++i) {
    const Vec at = from + direction * (length * (i + 0.5) / count);
    kind.hanger(laid(at, direction), hospital::slab_underside - at.y);
  }
}

void lay(const RunKind& kind, const Route& route, const Hanging& hanging) {
  double used = 0;  // of the straight stretch, by the bend before it
  for (size_t i = 0; i + 1 < route.size(); ++i) {
    const double whole = glm::distance(route[i], route[i + 1]);
    const Vec direction = (route[i + 1] - route[i]) / whole;
    const bool turns = i + 2 < route.size();
    const double bend = turns ? kind.bend : 0;
    lay_straight(kind, route[i] + used * direction, direction, whole - used - bend, hanging);
    if (turns) kind.turn(placed_along(route[i + 1], direction, glm::normalize(route[i + 2] - route[i + 1])));
    used = bend;
  }
}

}  // namespace

glm::dmat4 laid(const Vec& from, const Vec& direction) {
  return placed_along(from, direction, std::abs(direction.y) > 0.5 ? Vec(1, 0, 0) : Vec(0, 1, 0));
}

void lay_pipe(const Placer& placer, const PipeSystem& system, const Route& route, const Hanging& hanging) {
  const double d = system.diameter;
  const Vec colour = system.colour;
  const auto named = [&](const char* part) {
    return fmt::format("{} {} d{}", system.name, part, millimetres(d));
  };
  RunKind kind;
  kind.piece = system.piece;
  kind.bend = pipe_elbow_radius(d);
  kind.straight = [&](const glm::dmat4& at, double length) {
    placer.put(
        fmt::format("{} {}", named("pipe"), millimetres(length)), [=] { return pipe(colour, d, length); },
        at);
    if (system.insulated && length > 0.2)
      placer.put(
          fmt::format("insulation d{} {}", millimetres(d), millimetres(length)),
          [=] { return pipe_insulation(d, length); }, at);
  };
  kind.turn = [&](const glm::dmat4& at) {
    placer.put(
        named("elbow"), [=] { return pipe_elbow(colour, d); }, at);
  };
  kind.joint = [&](const glm::dmat4& at) {
    placer.put(
        named("joint"), [=] { return pipe_joint(colour, d); }, at);
  };
  kind.hanger = [&](const glm::dmat4& at, double rod) {
    placer.put(
        fmt::format("pipe clamp d{} {}", millimetres(d), millimetres(rod)),
        [=] { return pipe_clamp(d, rod); }, at);
  };
  lay(kind, route, hanging);
}

void lay_round_duct(const Placer& placer, const DuctSystem& system, double diameter, const Route& route,
                    const Hanging& hanging) {
  const Vec colour = system.colour;
  const auto named = [&](const char* part) {
    return fmt::format("{} round {} d{}", system.name, part, millimetres(diameter));
  };
  RunKind kind;
  kind.piece = 1.5;
  kind.bend = round_bend_radius(diameter);
  kind.straight = [&](const glm::dmat4& at, double length) {
    placer.put(
        fmt::format("{} {}", named("duct"), millimetres(length)),
        [=] { return round_duct(colour, diameter, length); }, at);
  };
  kind.turn = [&](const glm::dmat4& at) {
    placer.put(
        named("bend"), [=] { return round_bend(colour, diameter); }, at);
  };
  kind.joint = [&](const glm::dmat4& at) {
    placer.put(
        named("coupling"), [=] { return round_coupling(colour, diameter); }, at);
  };
  kind.hanger = [&](const glm::dmat4& at, double rod) {
    placer.put(
        fmt::format("duct strap d{} {}", millimetres(diameter), millimetres(rod)),
        [=] { return duct_strap(diameter, rod); }, at);
  };
  lay(kind, route, hanging);
}

void lay_duct(const Placer& placer, const DuctSystem& system, double width, double height, const Route& route,
              const Hanging& hanging, bool insulated) {
  const Vec colour = system.colour;
  const auto named = [&](const char* part) {
    return fmt::format("{} {} {}x{}", system.name, part, millimetres(width), millimetres(height));
  };
  RunKind kind;
  kind.piece = 1.5;
  kind.bend = rectangular_bend_radius(width);
  kind.straight = [&](const glm::dmat4& at, double length) {
    placer.put(
        fmt::format("{} {}", named("duct"), millimetres(length)),
        [=] { return rectangular_duct(colour, width, height, length); }, at);
    if (insulated && length > 0.3)
      placer.put(
          fmt::format("duct insulation {}x{} {}", millimetres(width), millimetres(height),
                      millimetres(length)),
          [=] { return duct_insulation(width, height, length); }, at);
  };
  kind.turn = [&](const glm::dmat4& at) {
    placer.put(
        named("bend"), [=] { return rectangular_bend(colour, width, height); }, at);
  };
  kind.hanger = [&](const glm::dmat4& at, double rod) {
    glm::dmat4 below = at;
    below[3].y -= height / 2;
    const double rods = rod + height / 2;
    placer.put(
        fmt::format("duct hanger {} {}", millimetres(width), millimetres(rods)),
        [=] { return duct_hanger(width, rods); }, below);
  };
  lay(kind, route, hanging);
}

void lay_tray(const Placer& placer, const std::string& name, double width, int cables, const Route& route) {
  RunKind kind;
  kind.piece = 3;
  kind.bend = cable_tray_bend_radius(width);
  kind.straight = [&](const glm::dmat4& at, double length) {
    placer.put(
        fmt::format("{} {} {}", name, millimetres(width), millimetres(length)),
        [=] { return cable_tray(width, length, cables); }, at);
  };
  kind.turn = [&](const glm::dmat4& at) {
    // The bend's sides stand along -z of the part.
    glm::dmat4 turned = at;
    if (at[2].y > 0) turned = placed_along(at[3], -glm::dvec3(at[1]), -glm::dvec3(at[0]));
    placer.put(
        fmt::format("{} bend {}", name, millimetres(width)), [=] { return cable_tray_bend(width); }, turned);
  };
  lay(kind, route, {});
}

}  // namespace triptych
