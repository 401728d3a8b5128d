#include "raster/raster_device.hpp"

#include "base/error.hpp"
#include "raster/raster_target.hpp"

namespace triptych {

namespace {

class RasterDevice final : public Device {
 public:
  RasterDevice(const Skeleton& skeleton, Representation& representation, Residency& residency,
               const RasterOptions& options)
      : scene_(skeleton, representation, residency), options_(options) {}

  std::unique_ptr<FrameTarget> make_target(TargetKind kind, int width, int height) override {
    if (width < 1 || height < 1 || width > max_picture_side || height > max_picture_side) {
      fail("frame target", "{}x{} pixels, where the device cpu draws 1x1 to {}x{}", width, height,
           max_picture_side, max_picture_side);
    }
    return std::make_unique<RasterTarget>(scene_, kind, width, height, options_);
  }
  const DeviceNames& names() const override { return raster_device_names(); }
  void set_geometry_cap(uint64_t bytes) override { scene_.set_geometry_cap(bytes); }
  void set_missing(const MissingChunks& missing) override { scene_.set_missing(missing); }
  GeometryUse geometry_use() const override { return scene_.geometry_use(); }
  bool has_chunk(uint32_t chunk) const override { return scene_.has_chunk(chunk); }
  bool is_damaged(uint32_t chunk) const override { return scene_.is_damaged(chunk); }
  bool order_matters() const override { return false; }

 private:
  RasterScene scene_;
  RasterOptions options_;
};

}  // namespace

const DeviceNames& raster_device_names() {
  // The version is of the pictures: it rises when any pixel comes out differently.
  static const DeviceNames names{"Triptych", "cpu", "3"};
  return names;
}

std::unique_ptr<Device> make_raster_device(const Skeleton& skeleton, Representation& representation,
                                           Residency& residency, const RasterOptions& options) {
  return std::make_unique<RasterDevice>(skeleton, representation, residency, options);
}

}  // namespace triptych
