#include "raster/shade.hpp"

#include "raster/corner_colors.hpp"
#include "raster/instruction_set.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

uint8_t to_byte(float channel) { return static_cast<uint8_t>(std::rint(channel * 255.0f)); }

class Shader {
 public:
  explicit Shader(const FrameView& view)
      : palette_(view.skeleton->palette),
        light_(light_direction(view)),
        stage_(view),
        width_(view.view().width),
        height_(view.view().height) {}

  /// Of a triangle whose chunk has no colours of its own.
  Rgba operator()(const SlotTable::Triangle& shown) const {
    const float lit = light_on(shown);
    Rgba color{0, 0, 0, 255};
    const std::array<uint8_t, 4>& base = palette_[shown.range->chunk->color[shown.triangle]];
    for (size_t i = 0; i < 3; ++i) color[i] = to_byte(static_cast<float>(base[i]) / 255.0f * lit);
    return color;
  }
  static bool varies(const SlotTable::Triangle& shown) { return !shown.range->chunk->vertex_color.empty(); }
  InterpolatedColors varying(const SlotTable::Triangle& shown) const {
    return interpolate_colors(stage_, width_, height_, shown, light_on(shown));
  }

 private:
  float light_on(const SlotTable::Triangle& shown) const {
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
    return light_of(glm::cross(scaled(edge(chunk.corner[1][shown.triangle])),
                               scaled(edge(chunk.corner[2][shown.triangle]))));
  }
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
  VertexStage stage_;
  int width_, height_;
};

/// The colours of triangles that were shaded a short while ago: most show in the row above, too.
class RecentColors {
 public:
  RecentColors(const VisibilityBuffer& buffer, const Shader& shader) : buffer_(buffer), shader_(shader) {
    // No slot that is looked for in an entry has this number.
    for (uint32_t i = 0; i < count; ++i) entries_[i].slot = i + 1;
  }
  /// Of a triangle whose colours vary no colour, and any_varies() is true from then on.
  Rgba of(uint32_t slot) { return entry(slot).color; }
  bool any_varies() const { return any_varies_; }
  void begin_row() { any_varies_ = false; }

  /// Whether the colours of the slot's triangle vary, and what they are at a pixel.
  bool varies(uint32_t slot) { return entry(slot).varies; }
  Rgba of(uint32_t slot, int32_t x, int32_t y) {
    Varying& varying = varying_[slot % varying_count];
    if (!varying_is_set_[slot % varying_count] || varying.slot != slot) {
      varying_is_set_[slot % varying_count] = true;
      varying = {slot, shader_.varying(buffer_.find(slot))};
    }
    float color[3];
    varying.colors.at(x, y, color);
    return {to_byte(color[0]), to_byte(color[1]), to_byte(color[2]), 255};
  }

 private:
  static constexpr uint32_t count = 1024, varying_count = 256;
  struct Entry {
    uint32_t slot;
    Rgba color;
    bool varies;
  };
  struct Varying {
    uint32_t slot;
    InterpolatedColors colors;
  };
  const Entry& entry(uint32_t slot) {
    Entry& entry = entries_[slot % count];
    if (entry.slot != slot) {
      const SlotTable::Triangle shown = buffer_.find(slot);
      const bool varies = Shader::varies(shown);
      entry = {slot, varies ? Rgba{} : shader_(shown), varies};
    }
    any_varies_ |= entry.varies;
    return entry;
  }
  const VisibilityBuffer& buffer_;
  const Shader& shader_;
  std::array<Entry, count> entries_;
  std::array<Varying, varying_count> varying_;  // unused, and so not touched, in pictures without any
  std::bitset<varying_count> varying_is_set_;
  bool any_varies_ = false;
};

[[gnu::noinline]] void shade_row(std::span<const uint32_t> depths, std::span<const uint32_t> slots,
                                 RecentColors& recent, Rgba* row) {
  recent.begin_row();
  if (const RasterKernels* const kernels = raster_kernels(instruction_set())) {
    const SlotColors colors{.background = std::bit_cast<uint32_t>(background_bytes),
                            .context = &recent,
                            .of_slot = [](void* context, uint32_t slot) {
                              return std::bit_cast<uint32_t>(static_cast<RecentColors*>(context)->of(slot));
                            }};
    kernels->color_row(colors, depths.data(), slots.data(), static_cast<int32_t>(depths.size()), row);
  } else {
    for (size_t x = 0; x < depths.size(); ++x)
      row[x] = depths[x] == 0 ? background_bytes : recent.of(slots[x]);
  }
}

/// The pixels of a row whose colours vary over their triangle.
[[gnu::noinline]] void shade_varying(std::span<const uint32_t> depths, std::span<const uint32_t> slots,
                                     int32_t y, RecentColors& recent, Rgba* row) {
  for (size_t x = 0; x < depths.size(); ++x) {
    if (depths[x] != 0 && recent.varies(slots[x])) row[x] = recent.of(slots[x], static_cast<int32_t>(x), y);
  }
}

}  // namespace

[[gnu::noinline]] void shade(const VisibilityBuffer& buffer, const FrameView& view, std::span<Rgba> picture) {
  const Shader shader(view);
  buffer.for_each_band(true, [&](int32_t first, int32_t last) {
    RecentColors colors(buffer, shader);
    for (int32_t y = first; y <= last; ++y) {
      Rgba* const row = picture.data() + static_cast<size_t>(y) * static_cast<size_t>(buffer.width());
      shade_row(buffer.depths(y), buffer.slots(y), colors, row);
      if (colors.any_varies()) shade_varying(buffer.depths(y), buffer.slots(y), y, colors, row);
    }
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
