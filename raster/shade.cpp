#include "raster/shade.hpp"

#include "raster/sky_fill.hpp"

namespace triptych {

namespace {

/// The pixels of a row whose colours vary over their triangle, of one kind.
[[gnu::noinline]] void shade_varying(std::span<const uint32_t> depths, std::span<const uint32_t> slots,
                                     int32_t y, ShadeKind kind, KeptShades& recent, Rgba* row,
                                     ShadingCounts& counts) {
  VaryingPixels tally(counts, kind);
  for (size_t x = 0; x < depths.size(); ++x) {
    if (depths[x] == 0 || !recent.varies(slots[x], kind)) continue;
    row[x] = recent.of(slots[x], static_cast<int32_t>(x), y);
    tally.add(recent.kinds(slots[x]));
  }
}

}  // namespace

[[gnu::noinline]] void shade(const VisibilityBuffer& buffer, const FrameView& view,
                             const TextureLevels& textures, std::span<const TransparentLayers> layers,
                             std::span<Rgba> picture, ShadingCounts& counts) {
  const TriangleShader shader(view, textures);
  const std::optional<SkyLook> sky = sky_shown(view);
  buffer.for_each_band(true, [&](int32_t first, int32_t last) {
    KeptShades colors(buffer.table(), shader);
    BandBlenders over(layers, shader, last, counts);
    for (int32_t y = first; y <= last; ++y) {
      Rgba* const row = picture.data() + static_cast<size_t>(y) * static_cast<size_t>(buffer.width());
      shade_row(buffer.depths(y), buffer.slots(y), colors, row);
      if (sky) fill_sky(*sky, buffer.depths(y), y, row, counts);
      for_each_kind(colors.varying_kinds(), [&](ShadeKind kind) {
        shade_varying(buffer.depths(y), buffer.slots(y), y, kind, colors, row, counts);
      });
      over.blend(0, y, row);
    }
    counts.smooth_triangles += colors.smooth_triangles();
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
