#include "samples/building/furniture_catalog.hpp"

#include "base/error.hpp"
#include "samples/building/properties.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

namespace triptych {
namespace {

constexpr double metres_per_centimetre = 0.01;

using Properties = std::map<std::string, std::string>;

class Entry {
 public:
  Entry(const Properties& properties, int number, const std::string& place)
      : properties_(properties), suffix_(fmt::format("#{}", number)), place_(place) {}

  std::optional<std::string> text(const std::string& key) const {
    const auto found = properties_.find(key + suffix_);
    if (found == properties_.end()) return std::nullopt;
    return found->second;
  }

  std::vector<double> numbers(const std::string& key) const {
    std::vector<double> values;
    std::istringstream words(text(key).value_or(""));
    for (std::string word; words >> word;) {
      double value = 0;
      const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
      if (end.ec != std::errc() || end.ptr != word.data() + word.size() || !std::isfinite(value))
        fail(place_, "{}{}: '{}' is not a number", key, suffix_, word);
      values.push_back(value);
    }
    return values;
  }

  double number(const std::string& key, double otherwise) const {
    const auto values = numbers(key);
    return values.empty() ? otherwise : values[0];
  }

 private:
  const Properties& properties_;
  std::string suffix_;
  const std::string& place_;
};

FurniturePiece read_piece(const Entry& entry, const FurnitureCatalogue& catalogue) {
  FurniturePiece piece;
  piece.id = entry.text("id").value_or("");
  piece.name = entry.text("name").value_or("");
  piece.category = entry.text("category").value_or("");
  piece.creator = entry.text("creator").value_or("");
  piece.license = entry.text("license").value_or(catalogue.license);
  piece.model = entry.text("model").value_or("");
  piece.model.erase(0, piece.model.find_first_not_of('/'));
  piece.model_bytes = catalogue.archive->size(piece.model);
  piece.size = glm::dvec3(entry.number("width", 0), entry.number("height", 0), entry.number("depth", 0)) *
               metres_per_centimetre;
  piece.elevation = entry.number("elevation", 0) * metres_per_centimetre;
  piece.top =
      entry.number("dropOnTopElevation", piece.size.y / metres_per_centimetre) * metres_per_centimetre;
  piece.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const auto rotation = entry.numbers("modelRotation");
  if (rotation.size() == 9) std::copy(rotation.begin(), rotation.end(), piece.rotation.begin());
  piece.door_or_window = entry.text("doorOrWindow") == "true";
  return piece;
}

}  // namespace

Furniture load_furniture(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> archives;
  std::error_code error;
  for (std::filesystem::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error))
    if (file->path().extension() == ".sh3f") archives.push_back(file->path());
  if (archives.empty())
    fail(folder.string(), "no furniture catalogues here; install the Debian package sweethome3d-furniture");
  std::sort(archives.begin(), archives.end());

  Furniture furniture;
  for (const auto& path : archives) {
    FurnitureCatalogue catalogue;
    catalogue.archive = std::make_shared<ZipArchive>(path);
    const std::string place = path.string() + "!PluginFurnitureCatalog.properties";
    const auto properties =
        parse_properties(catalogue.archive->read("PluginFurnitureCatalog.properties"), place);
    const auto value = [&](const std::string& key) {
      const auto found = properties.find(key);
      return found == properties.end() ? std::string() : found->second;
    };
    catalogue.name = value("name");
    catalogue.license = value("license");
    for (int number = 1; properties.count(fmt::format("id#{}", number)); ++number) {
      FurniturePiece piece = read_piece(Entry(properties, number, place), catalogue);
      piece.catalogue = furniture.catalogues.size();
      if (piece.model_bytes == 0 || glm::any(glm::lessThanEqual(piece.size, glm::dvec3(0)))) {
        ++furniture.without_model;
        continue;
      }
      furniture.pieces.push_back(std::move(piece));
    }
    furniture.catalogues.push_back(std::move(catalogue));
  }
  return furniture;
}

}  // namespace triptych
