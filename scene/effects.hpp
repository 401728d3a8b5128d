// What a model may call for beyond opaque surfaces of one colour each.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// Whether this program can draw effects at all (the CMake option TRIPTYCH_EFFECTS): otherwise it draws every
/// pack as with none, and what draws them is left out of it.
#ifdef TRIPTYCH_WITHOUT_EFFECTS
inline constexpr bool draws_effects = false;
#else
inline constexpr bool draws_effects = true;
#endif

/// That can be switched off from frame to frame.
enum class Effect : uint8_t {
  vertex_colors,
  transparency,
  smooth_normals,
  textures,
  emission,
  motion,
  baked_light,
  ambient,
  sky
};
inline constexpr std::array all_effects = {
    Effect::vertex_colors, Effect::transparency, Effect::smooth_normals, Effect::textures, Effect::emission,
    Effect::motion,        Effect::baked_light,  Effect::ambient,        Effect::sky};

/// As flags and reports name it.
constexpr std::string_view effect_name(Effect effect) {
  constexpr std::array<std::string_view, all_effects.size()> names = {
      "vertex-colours",   "transparency", "smooth-normals",    "textures", "emission",
      "moving-instances", "baked-light",  "ambient-occlusion", "sky"};
  return names[static_cast<size_t>(effect)];
}

/// What Skeleton::effects calls it.
std::string effect_name_in_pack(Effect effect);

/// What Skeleton::effects calls it where chunks of coarse levels have the shading normals of the surfaces
/// that they stand for: part of those levels, and so never switched off.
inline constexpr const char* level_normals_effect = "normals of levels";

/// Whether any chunk of a pack with these Skeleton::effects has shading normals.
bool has_normals(const std::vector<std::string>& effects_in_pack);

/// Whether a pack with these Skeleton::effects calls for the effect.
bool calls_for(const std::vector<std::string>& effects_in_pack, Effect effect);

/// Whether chunks of a pack with these Skeleton::effects have baked light: irradiance, openness, or both.
bool has_baked_light(const std::vector<std::string>& effects_in_pack);

/// A set of them.
class Effects {
 public:
  static constexpr Effects all() { return Effects((1u << all_effects.size()) - 1); }
  static constexpr Effects none() { return Effects(0); }
  /// Whether `bits` names no others.
  static constexpr bool known(uint32_t bits) { return bits >> all_effects.size() == 0; }
  constexpr explicit Effects(uint32_t bits) : bits_(bits) {}

  /// Whether to draw it: it is one of them, and this program can.
  constexpr bool has(Effect effect) const { return draws_effects && names(effect); }
  /// Whether it is one of them.
  constexpr bool names(Effect effect) const { return (bits_ & bit(effect)) != 0; }
  constexpr void add(Effect effect) { bits_ |= bit(effect); }
  constexpr uint32_t bits() const { return bits_; }
  bool operator==(const Effects&) const = default;

 private:
  static constexpr uint32_t bit(Effect effect) { return 1u << static_cast<uint32_t>(effect); }
  uint32_t bits_;
};

/// "all", "none", or their names with commas between them.
std::string effects_text(Effects effects);
/// The reverse. Error (place) for a word that names none.
Effects parse_effects(const std::string& text, const std::string& place);

}  // namespace triptych
