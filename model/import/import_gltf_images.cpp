// The images of a glTF file: beside it, in a data URI, or in a buffer view.
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "model/import/import_gltf.hpp"

#include <nlohmann/json.hpp>

namespace triptych {

namespace {

constexpr size_t shown_letters = 80;

std::string shown(const std::string& text) { return one_line(text.substr(0, shown_letters)); }

}  // namespace

std::vector<GltfImage> find_gltf_images(const std::string& json) {
  std::vector<GltfImage> images;
  const auto list = nlohmann::json::parse(json, nullptr, false);
  if (!list.is_array()) return images;
  for (const auto& entry : list) {
    GltfImage& image = images.emplace_back();
    if (!entry.is_object()) continue;
    if (const auto name = entry.find("name"); name != entry.end() && name->is_string())
      image.name = name->get<std::string>();
    if (const auto uri = entry.find("uri"); uri != entry.end() && uri->is_string())
      image.uri = std::make_shared<const std::string>(uri->get<std::string>());
    if (const auto view = entry.find("bufferView"); view != entry.end() && view->is_number_unsigned())
      image.view = view->get<int64_t>();
  }
  return images;
}

uint32_t GltfImages::image(int64_t index) {
  if (index < 0 || static_cast<size_t>(index) >= gltf_.images.size()) {
    skip(fmt::format("a texture names image {} of {}", index, gltf_.images.size()));
    return no_id;
  }
  std::optional<uint32_t>& known = known_[static_cast<size_t>(index)];
  if (known) return *known;
  known = no_id;
  try {
    known = target_.add_image(open(static_cast<size_t>(index)));
  } catch (const Error& error) {
    skip(error.what());
  }
  return *known;
}

/// One that cannot be had: counted, with what is wrong with the first.
void GltfImages::skip(const std::string& what) {
  if (first_missing_.empty())
    first_missing_ =
        fmt::format("images cannot be read, and what they are on is drawn without, the first: {}", what);
  target_.warn(first_missing_);
}

ModelImage GltfImages::open(size_t index) {
  const GltfImage& image = gltf_.images[index];
  const bool in_file = image.uri && !is_data_uri(*image.uri);
  const std::string name = in_file ? *image.uri : image.name;
  const std::string own =
      name.empty() ? fmt::format("image {}", index) : fmt::format("image {} ({})", index, shown(name));
  const std::string place = fmt::format("{}: {}", target_.place(), own);
  if (in_file) {
    const GltfBuffer file = gltf_file_beside(target_, *image.uri, 0, own);
    if (file.source->has_file()) target_.also_reads(file.source->name());
    return {place, [source = file.source] { return read_gltf_bytes({source, 0, source->size()}); }};
  }
  if (image.uri) return {place, [uri = image.uri, place] { return bytes_of_data_uri(*uri, place); }};
  if (image.view < 0) fail(own, "has neither an URI nor a buffer view");
  return {place, [bytes = gltf_view_bytes(gltf_, image.view, own)] { return read_gltf_bytes(bytes); }};
}

}  // namespace triptych
