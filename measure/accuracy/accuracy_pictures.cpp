#include "measure/accuracy/accuracy_pictures.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "render/png_file.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/core.h>
#include <regex>
#include <tuple>
#include <utility>
#include <vector>

namespace triptych {

using nlohmann::json;

namespace {

constexpr int patch_side = 48, enlarged = 4;
constexpr std::array<uint8_t, 4> frame_color = {255, 0, 255, 255};
constexpr const char* folder_name = "pictures";

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
  /// Its pixels, each one once.
  std::vector<uint8_t> plain(const std::vector<uint8_t>& picture, int picture_width) const {
    std::vector<uint8_t> crop;
    for (int y = bottom; y < bottom + height; ++y) {
      const auto begin = picture.begin() + 4 * (std::ptrdiff_t{y} * picture_width + left);
      crop.insert(crop.end(), begin, begin + std::ptrdiff_t{4} * width);
    }
    return crop;
  }
  /// Its pixels enlarged, and a frame around the patch as far as that lies within.
  std::vector<uint8_t> of(const std::vector<uint8_t>& picture, const WorstPatch& patch) const {
    std::vector<uint8_t> crop;
    for (int y = 0; y < height * enlarged; ++y) {
      for (int x = 0; x < width * enlarged; ++x) {
        const auto row = static_cast<size_t>(bottom + y / enlarged);
        const auto column = static_cast<size_t>(left + x / enlarged);
        const size_t at = 4 * (row * static_cast<size_t>(patch.width) + column);
        for (size_t channel = 0; channel < 4; ++channel) crop.push_back(picture[at + channel]);
      }
    }
    const int begin = (patch.left - left) * enlarged - 1, end = (patch.right - left) * enlarged,
              low = (patch.bottom - bottom) * enlarged - 1, high = (patch.top - bottom) * enlarged;
    for (int x = begin; x <= end; ++x) mark(crop, x, low), mark(crop, x, high);
    for (int y = low; y <= high; ++y) mark(crop, begin, y), mark(crop, end, y);
    return crop;
  }
  void mark(std::vector<uint8_t>& crop, int x, int y) const {
    if (x < 0 || y < 0 || x >= width * enlarged || y >= height * enlarged) return;
    const auto at = 4 * (static_cast<std::ptrdiff_t>(y) * width * enlarged + x);
    std::copy(frame_color.begin(), frame_color.end(), crop.begin() + at);
  }
  int width, height, left = 0, bottom = 0;
};

/// Pictures of an earlier run: by their names, whatever else lies there.
void remove_earlier(const std::filesystem::path& folder) {
  static const std::regex names(
      "(full-detail|[0-9.e+-]+px(-difference)?|(hole|swap|deviation)-[0-9]+-(reference|shown|difference))\\."
      "png");
  std::vector<std::filesystem::path> earlier;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && std::regex_match(entry.path().filename().string(), names))
      earlier.push_back(entry.path());
  }
  for (const std::filesystem::path& file : earlier) {
    std::error_code error;
    if (!std::filesystem::remove(file, error) && error)
      fail(file.string(), "is a picture of an earlier run and cannot be removed: {}", error.message());
  }
}

class Writer {
 public:
  explicit Writer(const std::filesystem::path& folder) : folder_(folder) {
    make_folder(folder / folder_name);
    remove_earlier(folder / folder_name);
  }

  std::string write(const std::string& name, int width, int height, const std::vector<uint8_t>& colors) {
    const std::string file = fmt::format("{}/{}.png", folder_name, name);
    write_png(folder_ / file, width, height, colors);
    return file;
  }

 private:
  std::filesystem::path folder_;
};

/// The worst place of one kind, and the rows whose pictures look like that there.
struct SharedPatch {
  std::string kind;
  const WorstPatch& patch;
  Crop crop;
  std::vector<uint8_t> reference, shown;
  std::vector<size_t> rows{};

  bool is_same(const SharedPatch& other) const {
    const auto key = [](const SharedPatch& one) {
      const WorstPatch& p = one.patch;
      return std::tie(one.kind, p.frame, p.left, p.bottom, p.right, p.top, p.width, p.height, p.pixels);
    };
    return key(*this) == key(other) && reference == other.reference && shown == other.shown;
  }
};

/// Each different one once, in the order of the rows.
std::vector<SharedPatch> shared_patches(const AccuracyResult& result) {
  std::vector<SharedPatch> found;
  for (size_t row = 0; row < result.rows.size(); ++row) {
    const PictureTally& pictures = *result.rows[row].pictures;
    for (const auto& [kind, patch] : {std::pair("hole", &pictures.hole),
                                      {"swap", &pictures.swap},
                                      {"deviation", &pictures.deviation_patch}}) {
      if (patch->pixels == 0) continue;
      const Crop crop(*patch);
      SharedPatch next{kind, *patch, crop, crop.plain(patch->reference, patch->width),
                       crop.plain(patch->shown, patch->width)};
      const auto same =
          std::find_if(found.begin(), found.end(), [&](const SharedPatch& one) { return one.is_same(next); });
      if (same == found.end()) {
        next.rows.push_back(row);
        found.push_back(std::move(next));
      } else {
        same->rows.push_back(row);
      }
    }
  }
  return found;
}

json patch_json(Writer& writer, const SharedPatch& shared) {
  const WorstPatch& patch = shared.patch;
  const auto save = [&](const char* which, const std::vector<uint8_t>& picture) {
    return writer.write(fmt::format("{}-{}-{}", shared.kind, shared.rows.front(), which),
                        shared.crop.width * enlarged, shared.crop.height * enlarged,
                        shared.crop.of(picture, patch));
  };
  return {{"kind", shared.kind},
          {"row", shared.rows.front()},
          {"rows", shared.rows},
          {"frame", patch.frame},
          {"pixels", patch.pixels},
          {"x", (patch.left + patch.right) / 2},
          {"y", patch.height - 1 - (patch.bottom + patch.top) / 2},
          {"enlarged", enlarged},
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
  for (const SharedPatch& shared : shared_patches(result)) patches.push_back(patch_json(writer, shared));
  return {{"strip", strip}, {"patches", patches}};
}

}  // namespace triptych
