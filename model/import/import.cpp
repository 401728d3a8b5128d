#include "model/import/import.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/rounding.hpp"
#include "base/shortest_names.hpp"
#include "model/import/file_as_object.hpp"
#include "model/import/import_file.hpp"
#include "model/import/mesh_stream_positions.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace triptych {

namespace {

std::vector<std::filesystem::path> nothing_beside(const std::filesystem::path&) { return {}; }

struct Format {
  const char* extension;
  void (*import)(FileImport&);
  std::vector<std::filesystem::path> (*files_beside)(const std::filesystem::path&);
};

constexpr std::array formats = {
    Format{".gltf", import_gltf, files_beside_gltf}, Format{".glb", import_gltf, files_beside_gltf},
    Format{".obj", import_obj, files_beside_obj},    Format{".ply", import_ply, nothing_beside},
    Format{".stl", import_stl, nothing_beside},      Format{".dxf", import_dxf, nothing_beside},
    Format{".3mf", import_3mf, nothing_beside},      Format{".ifc", import_ifc, nothing_beside},
    Format{".ifczip", import_ifc, nothing_beside},   Format{".step", import_step, nothing_beside},
    Format{".stp", import_step, nothing_beside},     Format{".iges", import_step, nothing_beside},
    Format{".igs", import_step, nothing_beside}};

/// The extensions of Assimp's readers that hold models. Formats with only animation, and those with a reader
/// of our own, are left out; a test compares the list with that of triptych-import.
constexpr std::array converted = {
    ".3d",   ".3ds", ".ac",  ".ac3d",    ".acc", ".amf", ".ase",  ".ask",  ".assbin",  ".b3d", ".blend",
    ".bsp",  ".cob", ".dae", ".enff",    ".fbx", ".hmp", ".iqm",  ".irr",  ".irrmesh", ".lwo", ".lws",
    ".lxo",  ".md2", ".md3", ".md5mesh", ".mdc", ".mdl", ".mesh", ".ms3d", ".ndo",     ".nff", ".off",
    ".ogex", ".pk3", ".pmx", ".prj",     ".q3o", ".q3s", ".raw",  ".scn",  ".sib",     ".smd", ".ter",
    ".uc",   ".x",   ".x3d", ".x3db",    ".xgl", ".zae", ".zgl"};

/// The format that the name's extension says.
std::optional<Format> known_format(const std::filesystem::path& name) {
  std::string extension = name.extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const Format& format : formats) {
    if (extension == format.extension) return format;
  }
  if (const auto* other = std::find(converted.begin(), converted.end(), extension); other != converted.end())
    return Format{*other, import_other, nothing_beside};
  return std::nullopt;
}

bool is_model(const std::filesystem::path& name) { return known_format(name).has_value(); }

bool has_own_reader(const std::filesystem::path& name) {
  const auto format = known_format(name);
  return format && format->import != import_other;
}

Format format_of(const std::filesystem::path& file, const std::filesystem::path& name) {
  if (const auto known = known_format(name)) return *known;
  std::string own;
  for (const Format& format : formats) own += fmt::format("{}{}", own.empty() ? "" : ", ", format.extension);
  fail(file.string(),
       "is of a format that is not known by its name; known are {}, and those of Assimp: "
       "`triptych build --help` lists them",
       own);
}

}  // namespace

bool is_model_name(const std::filesystem::path& file) { return is_packed(file) || is_model(file); }

std::vector<std::string> known_extensions() {
  std::vector<std::string> known;
  for (const Format& format : formats) known.emplace_back(format.extension);
  known.insert(known.end(), converted.begin(), converted.end());
  return known;
}

namespace {

Model import(const std::vector<std::filesystem::path>& files, const ImportOptions& options) {
  if (files.empty()) fail("import", "no model file was named");
  std::vector<PackedFile> packed;  // all are looked at before the first long read
  for (const auto& file : files) {
    packed.push_back(is_packed(file) ? find_packed(file, is_model, has_own_reader) : PackedFile{});
    format_of(file, packed.back().name.empty() ? file : packed.back().name);
  }
  PositionCache::limit_all(options.position_cache_bytes);
  Model model;
  model.materials.emplace_back();
  const std::vector<std::string> names = shortest_names(files);
  Progress progress("import", files.size());
  for (size_t i = 0; i < files.size(); ++i) {
    std::optional<FileAsObject> share;  // of several files each is an object
    if (files.size() > 1) share.emplace(names[i], model);
    FileImport target(files[i], model, options);
    if (is_packed(files[i])) {
      unpack(files[i], packed[i], options);
      target.unpacks(std::move(packed[i]));
    }
    format_of(files[i], target.model_name()).import(target);
    target.finish();
    if (share) share->take_all(target.options());
    progress.advance();
  }
  if (options.geo_place) model.geo_place = options.geo_place;
  return model;
}

}  // namespace

Model import_model(const std::vector<std::filesystem::path>& files, const ImportOptions& options) {
  return round_to_nearest([&] { return import(files, options); });
}

std::vector<std::filesystem::path> files_of_models(const std::vector<std::filesystem::path>& models) {
  std::vector<std::filesystem::path> files = models;
  for (const auto& model : models) {
    if (is_packed(model)) continue;
    const auto beside = format_of(model, model).files_beside(model);
    files.insert(files.end(), beside.begin(), beside.end());
  }
  return files;
}

}  // namespace triptych
