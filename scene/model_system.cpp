#include "scene/model_system.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace triptych {

namespace {
constexpr std::array<std::pair<const char*, double>, 5> units = {
    {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}};
}  // namespace

ModelSystem model_system(const PackOptions& options) {
  ModelSystem system;
  if (const auto up = options.find("model-up"); up != options.end()) system.z_up = up->second == "z";
  const auto unit = options.find("model-unit");
  if (unit == options.end()) return system;
  const auto known = std::find_if(units.begin(), units.end(),
                                  [&](const auto& candidate) { return candidate.first == unit->second; });
  if (known == units.end()) return system;
  system.unit = known->first;
  system.metres = known->second;
  return system;
}

void say_system(const ModelSystem& system, PackOptions& options) {
  options["model-up"] = system.z_up ? "z" : "y";
  options["model-unit"] = system.unit;
}

}  // namespace triptych
