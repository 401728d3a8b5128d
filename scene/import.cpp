#include "scene/import.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "scene/import_file.hpp"

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

const Format& format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  std::string known;
  for (const Format& format : formats) {
    if (extension == format.extension) return format;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", format.extension);
  }
  fail(file.string(), "is of a format that is not known by its name; known are {}", known);
}

}  // namespace

Model import_model(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) fail("import", "no model file was named");
  for (const auto& file : files) format_of(file);  // before the first long read
  Model model;
  model.materials.emplace_back();
  Progress progress("import", files.size());
  for (const auto& file : files) {
    FileImport target(file, model);
    format_of(file).import(target);
    target.finish();
    progress.advance();
  }
  return model;
}

}  // namespace triptych
