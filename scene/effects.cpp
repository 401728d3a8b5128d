#include "scene/effects.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <sstream>

namespace triptych {

namespace {

/// Their names with commas between them.
std::string names_of(Effects effects) {
  std::string names;
  for (const Effect effect : all_effects) {
    if (!effects.names(effect)) continue;
    if (!names.empty()) names += ",";
    names += effect_name(effect);
  }
  return names;
}

}  // namespace

std::string effect_name_in_pack(Effect effect) {
  std::string name(effect_name(effect));
  std::ranges::replace(name, '-', ' ');
  return name;
}

bool has_normals(const std::vector<std::string>& effects_in_pack) {
  return std::ranges::any_of(effects_in_pack, [](const std::string& name) {
    return name == level_normals_effect || name == effect_name_in_pack(Effect::smooth_normals);
  });
}

bool calls_for(const std::vector<std::string>& effects_in_pack, Effect effect) {
  return std::ranges::find(effects_in_pack, effect_name_in_pack(effect)) != effects_in_pack.end();
}

bool has_baked_light(const std::vector<std::string>& effects_in_pack) {
  return calls_for(effects_in_pack, Effect::baked_light) || calls_for(effects_in_pack, Effect::ambient);
}

std::string effects_text(Effects effects) {
  if (effects == Effects::all()) return "all";
  return effects == Effects::none() ? "none" : names_of(effects);
}

Effects parse_effects(const std::string& text, const std::string& place) {
  if (text == "all") return Effects::all();
  if (text == "none") return Effects::none();
  Effects effects = Effects::none();
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto* const found = std::ranges::find(all_effects, word, effect_name);
    if (found == all_effects.end())
      fail(place, "\"{}\" is no effect: all, none, or some of {}", word, names_of(Effects::all()));
    effects.add(*found);
  }
  if (effects == Effects::none()) fail(place, "no effect is named: \"none\" says so");
  return effects;
}

}  // namespace triptych
