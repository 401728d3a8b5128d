#include "model/import/own_system.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace triptych {

namespace {

/// What a format defines; the others leave both open.
struct Convention {
  const char* extension;
  std::optional<UpAxis> up;
  bool unit;
  UpAxis usual_up = UpAxis::y;  ///< where neither format nor options say it
};
constexpr std::array conventions = {Convention{".gltf", UpAxis::y, true},
                                    Convention{".glb", UpAxis::y, true},
                                    Convention{".dxf", UpAxis::z, false},
                                    Convention{".3mf", UpAxis::z, true},
                                    Convention{".ifc", UpAxis::z, true},
                                    Convention{".ifczip", UpAxis::z, true},
                                    Convention{".step", std::nullopt, true, UpAxis::z},
                                    Convention{".stp", std::nullopt, true, UpAxis::z},
                                    Convention{".iges", std::nullopt, true, UpAxis::z},
                                    Convention{".igs", std::nullopt, true, UpAxis::z},
                                    Convention{".dae", std::nullopt, true},
                                    Convention{".fbx", std::nullopt, true},
                                    Convention{".3ds", UpAxis::z, false}};

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return extension;
}

std::optional<ModelSystem> own_system(const std::filesystem::path& file, const ImportOptions& options) {
  std::string extension = extension_of(file);
  if (extension == ".zip") return std::nullopt;
  if (extension == ".gz") extension = extension_of(file.stem());
  const auto found = std::find_if(conventions.begin(), conventions.end(), [&](const Convention& convention) {
    return extension == convention.extension;
  });
  const Convention convention = found == conventions.end() ? Convention{"", {}, false} : *found;
  static constexpr std::array<const char*, 5> names = {"m", "cm", "mm", "in", "ft"};
  static constexpr std::array<double, 5> metres = {1, 0.01, 0.001, 0.0254, 0.3048};
  const auto unit =
      static_cast<size_t>(convention.unit ? LengthUnit::metre : options.unit.value_or(LengthUnit::metre));
  return ModelSystem{.z_up = convention.up.value_or(options.up.value_or(convention.usual_up)) == UpAxis::z,
                     .metres = metres[unit],
                     .unit = names[unit]};
}

}  // namespace

std::optional<ModelSystem> own_system(const std::vector<std::filesystem::path>& files,
                                      const ImportOptions& options) {
  std::optional<ModelSystem> system;
  for (const auto& file : files) {
    const auto own = own_system(file, options);
    if (!own || (system && *system != *own)) return std::nullopt;
    system = own;
  }
  return system;
}

}  // namespace triptych
