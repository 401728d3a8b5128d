#include "raster/resolve.hpp"

#include "raster/edge_marker.hpp"
#include "raster/sky_fill.hpp"

#include <algorithm>
#include <bit>
#include <optional>

namespace triptych {

namespace {

/// Resolves the rows of one band, from bottom to top.
class BandResolver {
 public:
  BandResolver(const SamplePlanes& planes, const FrameView& view, std::span<const TransparentLayers> layers,
               const TriangleShader& shader, int32_t last_row, ShadingCounts& counts)
      : planes_(planes),
        counts_(counts),
        over_(layers, shader, last_row, counts),
        width_(static_cast<size_t>(planes.front().width())),
        shared_(share_slots(planes)),
        rows_(planes.size() * width_),
        sums_(width_ * sizeof(Rgba)) {
    for (size_t i = 0; i < (shared_ ? 1 : planes.size()); ++i)
      recent_.emplace_back(planes[i].table(), shader);
    sky_ = sky_shown(view);
    if (!view.state.edges) return;
    rule_.emplace(view);
    const auto places = sample_places(view.state.samples);
    for (size_t i = 0; i < planes.size(); ++i) edges_.emplace_back(planes[i], view, *rule_, places[i]);
  }

  void count() {
    for (const KeptShades& shades : recent_) counts_.smooth_triangles += shades.smooth_triangles();
  }

  [[gnu::noinline]] void make(int32_t y, Rgba* picture_row) {
    uint32_t kinds = 0;
    for (size_t i = 0; i < planes_.size(); ++i) {
      shade_row(planes_[i].depths(y), planes_[i].slots(y), recent(i), row(i));
      if (sky_) fill_sky(*sky_, planes_[i].depths(y), y, row(i), counts_);
      kinds |= recent(i).varying_kinds();
    }
    for_each_kind(kinds, [&](ShadeKind kind) { shade_varying(y, kind); });
    for (size_t i = 0; i < edges_.size(); ++i) edges_[i].draw(y, row(i));
    for (size_t i = 0; i < planes_.size(); ++i) over_.blend(i, y, row(i));
    average(picture_row);
  }

 private:
  KeptShades& recent(size_t plane) { return recent_[shared_ ? 0 : plane]; }
  Rgba* row(size_t plane) { return rows_.data() + plane * width_; }

  /// Once a pixel and triangle.
  void shade_varying(int32_t y, ShadeKind kind) {
    VaryingPixels tally(counts_, kind);
    for (size_t x = 0; x < width_; ++x) {
      for (size_t i = 0; i < planes_.size(); ++i) {
        const uint32_t slot = planes_[i].slots(y)[x];
        if (planes_[i].depths(y)[x] == 0 || !recent(i).varies(slot, kind)) continue;
        const Rgba* const known = shared_ ? shaded_before(x, y, i, slot) : nullptr;
        row(i)[x] = known != nullptr ? *known : recent(i).of(slot, static_cast<int32_t>(x), y);
        tally.add(recent(i).kinds(slot));
      }
    }
  }
  const Rgba* shaded_before(size_t x, int32_t y, size_t plane, uint32_t slot) {
    for (size_t i = plane; i > 0; --i) {
      if (planes_[i - 1].depths(y)[x] != 0 && planes_[i - 1].slots(y)[x] == slot) return row(i - 1) + x;
    }
    return nullptr;
  }

  void average(Rgba* picture_row) {
    const size_t bytes = sums_.size();
    const auto half = static_cast<uint16_t>(planes_.size() / 2);
    const int shift = std::countr_zero(planes_.size());
    std::fill(sums_.begin(), sums_.end(), half);
    for (size_t i = 0; i < planes_.size(); ++i) {
      const uint8_t* const from = row(i)->data();
      for (size_t k = 0; k < bytes; ++k) sums_[k] = static_cast<uint16_t>(sums_[k] + from[k]);
    }
    uint8_t* const to = picture_row->data();
    for (size_t k = 0; k < bytes; ++k) to[k] = static_cast<uint8_t>(sums_[k] >> shift);
  }

  const SamplePlanes& planes_;
  ShadingCounts& counts_;
  BandBlenders over_;
  size_t width_;
  bool shared_;
  std::deque<KeptShades> recent_;
  std::vector<Rgba> rows_;  ///< of each plane one
  std::vector<uint16_t> sums_;
  std::optional<SkyLook> sky_;
  std::optional<EdgeRule> rule_;
  std::vector<EdgeMarker> edges_;
};

}  // namespace

[[gnu::noinline]] void resolve(const SamplePlanes& planes, const FrameView& view,
                               const TextureLevels& textures, std::span<const TransparentLayers> layers,
                               std::span<Rgba> picture, ShadingCounts& counts) {
  const TriangleShader shader(view, textures);
  planes.front().for_each_band(true, [&](int32_t first, int32_t last) {
    BandResolver band(planes, view, layers, shader, last, counts);
    for (int32_t y = first; y <= last; ++y)
      band.make(y, picture.data() + static_cast<size_t>(y) * static_cast<size_t>(planes.front().width()));
    band.count();
  });
}

}  // namespace triptych
