#include "scene/effects.hpp"

#include "base/error.hpp"

#include <sstream>

namespace triptych {

std::string effects_text(Effects effects) {
  if (effects == Effects::all()) return "all";
  std::string text;
  for (const Effect effect : all_effects) {
    if (!effects.has(effect)) continue;
    if (!text.empty()) text += ",";
    text += effect_name(effect);
  }
  return text.empty() ? "none" : text;
}

Effects parse_effects(const std::string& text, const std::string& place) {
  if (text == "all") return Effects::all();
  if (text == "none") return Effects::none();
  Effects effects = Effects::none();
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    bool found = false;
    for (const Effect effect : all_effects) {
      if (word != effect_name(effect)) continue;
      effects.add(effect);
      found = true;
    }
    if (!found) fail(place, "\"{}\" is no effect: all, none, or of vertex-colours and transparency", word);
  }
  if (effects == Effects::none()) fail(place, "no effect is named: \"none\" says so");
  return effects;
}

}  // namespace triptych
