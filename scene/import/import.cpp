#include "scene/import/import.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/rounding.hpp"
#include "scene/import/import_file.hpp"
#include "scene/import/mesh_stream_positions.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace triptych {

namespace {

struct Format {
  const char* extension;
  void (*import)(FileImport&);
};

constexpr std::array formats = {Format{".gltf", import_gltf}, Format{".glb", import_gltf},
                                Format{".obj", import_obj}, Format{".ply", import_ply},
                                Format{".stl", import_stl}};

/// What Assimp's readers claim and hold models. Pure motion, and what has a reader of ours, is left out; a
/// test asks triptych-import for the same list.
constexpr std::array converted = {
    ".3d",     ".3ds",   ".3mf",  ".ac",      ".ac3d", ".acc", ".amf",  ".ase",  ".ask", ".assbin",
    ".b3d",    ".blend", ".bsp",  ".cob",     ".dae",  ".dxf", ".enff", ".fbx",  ".hmp", ".ifc",
    ".ifczip", ".iqm",   ".irr",  ".irrmesh", ".lwo",  ".lws", ".lxo",  ".md2",  ".md3", ".md5mesh",
    ".mdc",    ".mdl",   ".mesh", ".ms3d",    ".ndo",  ".nff", ".off",  ".ogex", ".pk3", ".pmx",
    ".prj",    ".q3o",   ".q3s",  ".raw",     ".scn",  ".sib", ".smd",  ".step", ".stp", ".ter",
    ".uc",     ".x",     ".x3d",  ".x3db",    ".xgl",  ".zae", ".zgl"};

void (*importer_of(const std::filesystem::path& file))(FileImport&) {
  std::string extension = file.extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const Format& format : formats) {
    if (extension == format.extension) return format.import;
  }
  if (std::find(converted.begin(), converted.end(), extension) != converted.end()) return import_other;
  std::string own;
  for (const Format& format : formats) own += fmt::format("{}{}", own.empty() ? "" : ", ", format.extension);
  fail(file.string(),
       "is of a format that is not known by its name; known are {}, and those of Assimp: "
       "`triptych build --help` lists them",
       own);
}

}  // namespace

std::vector<std::string> known_extensions() {
  std::vector<std::string> known;
  for (const Format& format : formats) known.emplace_back(format.extension);
  known.insert(known.end(), converted.begin(), converted.end());
  return known;
}

namespace {

Model import(const std::vector<std::filesystem::path>& files, const ImportOptions& options) {
  if (files.empty()) fail("import", "no model file was named");
  for (const auto& file : files) importer_of(file);  // before the first long read
  PositionCache::limit_all(options.position_cache_bytes);
  Model model;
  model.materials.emplace_back();
  Progress progress("import", files.size());
  for (const auto& file : files) {
    FileImport target(file, model, options);
    importer_of(file)(target);
    target.finish();
    progress.advance();
  }
  return model;
}

}  // namespace

Model import_model(const std::vector<std::filesystem::path>& files, const ImportOptions& options) {
  return round_to_nearest([&] { return import(files, options); });
}

}  // namespace triptych
