#include "raster/shade.hpp"

#include "raster/instruction_set.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

uint8_t to_byte(float channel) { return static_cast<uint8_t>(std::rint(channel * 255.0f)); }

class Shader {
 public:
  explicit Shader(const FrameView& view) : palette_(view.skeleton->palette), light_(light_direction(view)) {}

  Rgba operator()(const SlotTable::Triangle& shown) const {
    const RasterChunk& chunk = *shown.range->chunk;
    const uint32_t from = chunk.corner[0][shown.triangle];
    // Differences of lattice points are exact.
    const auto edge = [&](uint32_t to) {
      const auto x = static_cast<float>(chunk.x[to] - chunk.x[from]),
                 y = static_cast<float>(chunk.y[to] - chunk.y[from]),
                 z = static_cast<float>(chunk.z[to] - chunk.z[from]);
      const auto along = [&](const glm::vec4& row) { return (row.x * x + row.y * y) + row.z * z; };
      const PlacedLattice& placed = shown.range->placed;
      return glm::vec3(along(placed.rows[0]), along(placed.rows[1]), along(placed.rows[2]));
    };
    const float lit = light_of(glm::cross(scaled(edge(chunk.corner[1][shown.triangle])),
                                          scaled(edge(chunk.corner[2][shown.triangle]))));
    Rgba color{0, 0, 0, 255};
    const std::array<uint8_t, 4>& base = palette_[chunk.color[shown.triangle]];
    for (size_t i = 0; i < 3; ++i) color[i] = to_byte(static_cast<float>(base[i]) / 255.0f * lit);
    return color;
  }

 private:
  /// So that products neither overflow nor vanish.
  static glm::vec3 scaled(const glm::vec3& v) {
    const float most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return most > 0 ? v / most : v;
  }
  float light_of(const glm::vec3& normal) const {
    const float length = std::sqrt((normal.x * normal.x + normal.y * normal.y) + normal.z * normal.z);
    const float scale = length > 0 ? 1.0f / length : 0.0f;
    const float towards = (normal.x * light_.x + normal.y * light_.y) + normal.z * light_.z;
    return (ambient_light + diffuse_light * std::abs(towards * scale)) +
           head_light * std::abs(normal.z * scale);
  }

  const std::vector<std::array<uint8_t, 4>>& palette_;
  glm::vec3 light_;
};

/// The colours of triangles that were shaded a short while ago: most show in the row above, too.
class RecentColors {
 public:
  RecentColors(const VisibilityBuffer& buffer, const Shader& shader) : buffer_(buffer), shader_(shader) {
    // No slot that is looked for in an entry has this number.
    for (uint32_t i = 0; i < count; ++i) entries_[i].slot = i + 1;
  }
  Rgba of(uint32_t slot) {
    Entry& entry = entries_[slot % count];
    if (entry.slot != slot) entry = {slot, shader_(buffer_.find(slot))};
    return entry.color;
  }

 private:
  static constexpr uint32_t count = 1024;
  struct Entry {
    uint32_t slot;
    Rgba color;
  };
  const VisibilityBuffer& buffer_;
  const Shader& shader_;
  std::array<Entry, count> entries_;
};

[[gnu::noinline]] void shade_row(std::span<const uint32_t> depths, std::span<const uint32_t> slots,
                                 RecentColors& recent, Rgba* row) {
  if (const RasterKernels* const kernels = raster_kernels(instruction_set())) {
    const SlotColors colors{.background = std::bit_cast<uint32_t>(background_bytes),
                            .context = &recent,
                            .of_slot = [](void* context, uint32_t slot) {
                              return std::bit_cast<uint32_t>(static_cast<RecentColors*>(context)->of(slot));
                            }};
    kernels->color_row(colors, depths.data(), slots.data(), static_cast<int32_t>(depths.size()), row);
    return;
  }
  for (size_t x = 0; x < depths.size(); ++x) row[x] = depths[x] == 0 ? background_bytes : recent.of(slots[x]);
}

}  // namespace

[[gnu::noinline]] void shade(const VisibilityBuffer& buffer, const FrameView& view, std::span<Rgba> picture) {
  const Shader shader(view);
  buffer.for_each_band(true, [&](int32_t first, int32_t last) {
    RecentColors colors(buffer, shader);
    for (int32_t y = first; y <= last; ++y)
      shade_row(buffer.depths(y), buffer.slots(y), colors,
                picture.data() + static_cast<size_t>(y) * static_cast<size_t>(buffer.width()));
  });
}

void name_items(const VisibilityBuffer& buffer, std::span<uint32_t> items) {
  size_t i = 0;
  for (int y = 0; y < buffer.height(); ++y) {
    for (int x = 0; x < buffer.width(); ++x, ++i) {
      const auto shown = buffer.triangle(x, y);
      items[i] = shown ? shown->range->rank.id + 1 : 0;
    }
  }
}

}  // namespace triptych
