#include "preprocess/textures/make_textures.hpp"

#include "base/content_key.hpp"
#include "base/error.hpp"
#include "base/hashing.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "preprocess/textures/image.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace triptych {

namespace {

/// A texture that is made, and not yet written.
struct Made {
  Texture texture;
  std::vector<std::vector<std::byte>> levels;
  uint8_t least_alpha = 255;
  ContentKey key;
  std::string fault;  ///< why there is none
  bool is_smaller = false;
};

/// For each image the least cut-off of materials that cut it out; 0: none does.
std::vector<uint8_t> cutoffs_of(const Model& model) {
  std::vector<uint8_t> cutoffs(model.images.size(), 0);
  for (const Material& material : model.materials) {
    if (material.texture == no_id || !(material.cutoff > 0)) continue;
    uint8_t& known = cutoffs[material.texture];
    const auto own = static_cast<uint8_t>(std::clamp(std::ceil(material.cutoff * 255), 1.0f, 255.0f));
    known = known == 0 ? own : std::min(known, own);
  }
  return cutoffs;
}

/// The image with its alpha. key: of its content.
Image read(const ModelImage& source, uint8_t cutoff, ContentKey& content) {
  ContentKeyWriter key;
  const auto decoded = [&](const ModelImage& one) {
    const std::vector<std::byte> bytes = one.read();
    key.write_all(std::span<const std::byte>(bytes));
    return decode_image(bytes, one.place);
  };
  Image image;
  if (source.read) image = decoded(source);
  key.write(cutoff);
  if (source.alpha) {
    const bool has_color = !image.texels.empty();
    key.write(has_color);
    set_alpha(image, decoded(*source.alpha));
  }
  content = key.key();
  return image;
}

Made make(const ModelImage& source, uint8_t cutoff) {
  Made made;
  try {
    Image image = read(source, cutoff, made.key);
    while (std::max(image.width, image.height) > max_built_side) {
      image = half_of(image);
      made.is_smaller = true;
    }
    made.texture = {image.width, image.height, {}};
    for (const Texel& texel : image.texels) made.least_alpha = std::min(made.least_alpha, texel[3]);
    const bool has_holes = made.least_alpha < cutoff;
    const Image finest = has_holes ? image : Image();
    for (uint32_t level = 0; level < texture_levels(made.texture.width, made.texture.height); ++level) {
      if (level > 0) image = half_of(image);
      if (level == 0 || !has_holes) {
        made.levels.push_back(encode_texels(image));
        continue;
      }
      Image kept = image;
      keep_covered(kept, finest, cutoff);
      made.levels.push_back(encode_texels(kept));
    }
  } catch (const Error& error) {
    made.fault = error.what();
  }
  return made;
}

}  // namespace

Textures make_textures(const Model& model, SpoolFile& file) {
  Textures result;
  result.of_images.resize(model.images.size());
  std::vector<uint8_t> used(model.images.size(), 0);
  for (const Material& material : model.materials) {
    for (const uint32_t image : {material.texture, material.emission_texture})
      if (image != no_id) used[image] = 1;
  }
  std::vector<uint32_t> images;
  for (uint32_t i = 0; i < used.size(); ++i)
    if (used[i]) images.push_back(i);
  if (images.empty()) return result;
  const std::vector<uint8_t> cutoffs = cutoffs_of(model);
  std::map<ContentKey, uint32_t> known;
  size_t faults = 0, smaller = 0;
  std::string first_fault;
  Progress progress("textures", images.size());
  const size_t at_once = thread_count();
  for (size_t first = 0; first < images.size(); first += at_once) {
    std::vector<Made> made(std::min(at_once, images.size() - first));
    parallel_for(made.size(), [&](size_t i) {
      made[i] = make(model.images[images[first + i]], cutoffs[images[first + i]]);
      progress.advance();
    });
    for (size_t i = 0; i < made.size(); ++i) {
      Made& own = made[i];
      if (!own.fault.empty()) {
        if (faults++ == 0) first_fault = own.fault;
        continue;
      }
      smaller += own.is_smaller;
      const auto [found, added] = known.try_emplace(own.key, static_cast<uint32_t>(result.textures.size()));
      result.of_images[images[first + i]] = {found->second, own.least_alpha};
      if (!added) continue;
      for (const std::vector<std::byte>& level : own.levels) {
        const SpoolPlace place = file.append(level);
        own.texture.levels.push_back({place.offset, place.size, hash_bytes(level)});
      }
      result.textures.push_back(std::move(own.texture));
    }
  }
  if (faults > 0)
    result.warnings.push_back(
        fmt::format("{} images cannot be read, and what they are on is drawn without, the first: {}", faults,
                    first_fault));
  if (smaller > 0)
    result.warnings.push_back(fmt::format(
        "{} images are more than {} texels wide or high, and are made smaller", smaller, max_built_side));
  return result;
}

}  // namespace triptych
