#include "measure/accuracy/accuracy_pictures.hpp"

#include "base/file.hpp"
#include "render/png_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/core.h>
#include <set>

namespace triptych {

using nlohmann::json;

namespace {

constexpr int patch_side = 48, enlarged = 4;

/// White where they agree, darker the more they differ: four times the difference.
std::vector<uint8_t> difference_picture(const std::vector<uint8_t>& one, const std::vector<uint8_t>& other) {
  std::vector<uint8_t> picture(one.size(), 255);
  for (size_t pixel = 0; pixel + 3 < one.size(); pixel += 4) {
    int most = 0;
    for (size_t channel = 0; channel < 3; ++channel)
      most = std::max(most, std::abs(int{one[pixel + channel]} - int{other[pixel + channel]}));
    std::fill_n(picture.begin() + static_cast<std::ptrdiff_t>(pixel), 3,
                static_cast<uint8_t>(255 - std::min(4 * most, 255)));
  }
  return picture;
}

/// The patch's surroundings, each pixel as a square.
struct Crop {
  explicit Crop(const WorstPatch& patch)
      : width(std::min(patch_side, patch.width)), height(std::min(patch_side, patch.height)) {
    left = std::clamp((patch.left + patch.right - width) / 2, 0, patch.width - width);
    bottom = std::clamp((patch.bottom + patch.top - height) / 2, 0, patch.height - height);
  }
  std::vector<uint8_t> of(const std::vector<uint8_t>& picture, int picture_width) const {
    std::vector<uint8_t> crop;
    for (int y = 0; y < height * enlarged; ++y) {
      for (int x = 0; x < width * enlarged; ++x) {
        const auto row = static_cast<size_t>(bottom + y / enlarged);
        const auto column = static_cast<size_t>(left + x / enlarged);
        const size_t at = 4 * (row * static_cast<size_t>(picture_width) + column);
        for (size_t channel = 0; channel < 4; ++channel) crop.push_back(picture[at + channel]);
      }
    }
    return crop;
  }
  int width, height, left = 0, bottom = 0;
};

class Writer {
 public:
  explicit Writer(const std::filesystem::path& folder) : folder_(folder) { make_folder(folder / "pictures"); }

  std::string write(const std::string& name, int width, int height, const std::vector<uint8_t>& colors) {
    const std::string file = "pictures/" + name + ".png";
    write_png(folder_ / file, width, height, colors);
    return file;
  }

 private:
  std::filesystem::path folder_;
};

json patch_json(Writer& writer, const std::string& kind, size_t row, const WorstPatch& patch) {
  const Crop crop(patch);
  const auto save = [&](const char* which, const std::vector<uint8_t>& picture) {
    return writer.write(fmt::format("{}-{}-{}", kind, row, which), crop.width * enlarged,
                        crop.height * enlarged, crop.of(picture, patch.width));
  };
  return {{"kind", kind},
          {"row", row},
          {"frame", patch.frame},
          {"pixels", patch.pixels},
          {"x", (patch.left + patch.right) / 2},
          {"y", patch.height - 1 - (patch.bottom + patch.top) / 2},
          {"reference", save("reference", patch.reference)},
          {"shown", save("shown", patch.shown)},
          {"difference", save("difference", difference_picture(patch.reference, patch.shown))}};
}

}  // namespace

json write_accuracy_pictures(const AccuracyResult& result, const std::filesystem::path& folder) {
  Writer writer(folder);
  json strip = json::array(), patches = json::array();
  for (const AccuracyPicture& picture : result.pictures) {
    const std::string name =
        picture.pixel_error > 0 ? fmt::format("{:g}px", picture.pixel_error) : std::string("full-detail");
    json item = {{"pixel_error", picture.pixel_error},
                 {"frame", picture.frame},
                 {"file", writer.write(name, picture.width, picture.height, picture.colors)}};
    if (picture.pixel_error > 0)
      item["difference"] = writer.write(name + "-difference", picture.width, picture.height,
                                        difference_picture(result.pictures.front().colors, picture.colors));
    strip.push_back(item);
  }
  std::set<const PictureTally*> seen;
  for (size_t row = 0; row < result.rows.size(); ++row) {
    const PictureTally& pictures = *result.rows[row].pictures;
    if (!seen.insert(&pictures).second) continue;
    if (pictures.hole.pixels > 0) patches.push_back(patch_json(writer, "hole", row, pictures.hole));
    if (pictures.swap.pixels > 0) patches.push_back(patch_json(writer, "swap", row, pictures.swap));
    if (pictures.deviation_patch.pixels > 0)
      patches.push_back(patch_json(writer, "deviation", row, pictures.deviation_patch));
  }
  return {{"strip", strip}, {"patches", patches}};
}

}  // namespace triptych
