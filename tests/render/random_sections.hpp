// Random sections, and what cut surfaces look like, for tests of both.
#pragma once

#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"
#include "visibility/shading.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <utility>

namespace triptych {

inline Section random_section(const Box& box, scenes::Random& random) {
  const auto inside = [&] { return box.lo + (box.hi - box.lo) * random.vector(-0.1, 1.1); };
  Section section;
  for (uint32_t planes = random.index(random.index(4) == 0 ? 7 : 3); planes > 0; --planes) {
    glm::dvec3 normal = random.vector(-1, 1) + glm::dvec3(0, 0, 1e-3);
    if (random.index(3) == 0) {
      normal = {0, 0, 0};
      normal[static_cast<int>(random.index(3))] = random.index(2) == 0 ? 1 : -1;
    }
    const glm::dvec3 at = random.index(4) == 0 ? glm::floor(inside()) : inside();
    section.add_plane({glm::normalize(normal), glm::dot(glm::normalize(normal), at)}, "test");
  }
  if (section.keeps_all() || random.index(3) == 0) {
    const glm::dvec3 a = inside(), b = inside();
    section.set_box({glm::min(a, b), glm::max(a, b)}, "test");
  }
  return section;
}

/// Culled pictures under random sections, against those of the whole cut; how many drawables were drawn, of
/// how many in the cuts.
inline std::pair<size_t, size_t> compare_under_sections(const Pack& pack, size_t states) {
  const Skeleton& skeleton = pack.skeleton();
  const Box box = skeleton.lattice().box(skeleton.scene_nodes.front().box);
  constexpr int width = 72, height = 56;
  Rig rig(pack, width, height);
  scenes::Random random(17);
  const std::vector<View> views = scenes::random_views(skeleton, width, height, states, 23);
  size_t drawn = 0, cut = 0;
  Section section;
  for (size_t i = 0; i < states; ++i) {
    // Some frames keep the section, or the view, of the one before.
    if (i % 4 != 1) section = random_section(box, random);
    FrameState state{views[i % 4 == 2 ? i - 1 : i], scenes::pixel_error(i)};
    state.section = section;
    if (i % 10 == 0) state.samples = 4;
    state.edges = i % 6 == 0;
    const Rig::Frame frame = rig.draw({static_cast<uint32_t>(i), state});
    EXPECT_EQ(frame.differing_pixels, 0u) << "frame " << i;
    drawn += frame.record.visible.size();
    cut += frame.record.cut_drawables;
  }
  return {drawn, cut};
}

/// What the material of a palette's entry shows on a face with this normal (eye space).
inline glm::ivec3 lit(const Pack& pack, size_t color, const glm::dvec3& normal, const FrameState& state,
                      double tone) {
  const FrameView view(pack.skeleton(), state);
  const double light = ambient_light +
                       diffuse_light * std::abs(glm::dot(normal, glm::dvec3(light_direction(view)))) +
                       head_light * std::abs(normal.z);
  const auto& base = pack.skeleton().palette[color];
  return glm::ivec3(glm::round(glm::dvec3(base[0], base[1], base[2]) * light * tone));
}

inline bool alike(const glm::ivec3& a, const glm::ivec3& b) {
  const glm::ivec3 apart = glm::abs(a - b);
  return apart.x <= 1 && apart.y <= 1 && apart.z <= 1;
}

}  // namespace triptych
