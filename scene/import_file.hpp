// One model file on its way into a model: what every importer writes into.
#pragma once

#include "scene/model.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace triptych {

/// Coordinates beyond this are treated as not finite: products of three of them would overflow a double.
inline constexpr double largest_coordinate = 1e75;

/// Collects what one file adds to the model, and counts what had to be left out.
class FileImport {
 public:
  FileImport(std::filesystem::path file, Model& model);

  const std::filesystem::path& file() const { return file_; }
  /// The place of errors: the file's name as it was given.
  std::string place() const { return file_.string(); }
  std::string line_place(uint64_t line) const;

  /// Counts towards one warning, "<file>: <count> <what>".
  void warn(std::string_view what, uint64_t count = 1);

  uint32_t add_material(const Material& material);
  /// Takes the mesh without the triangles whose coordinates are not finite, and without vertices that only
  /// those used; nothing if no triangle is left. Indices must be in range.
  std::optional<uint32_t> add_mesh(Mesh mesh);
  void add_instance(uint32_t mesh, const Affine& transform);

  /// Moves the warnings into the model's report. Error if the file placed no triangle.
  void finish();

 private:
  std::filesystem::path file_;
  Model& model_;
  size_t first_instance_;
  std::vector<std::pair<std::string, uint64_t>> warnings_;
};

/// One importer a format; each reads the file into the model. Errors as import_model.
void import_gltf(FileImport& target);  ///< .gltf and .glb
void import_obj(FileImport& target);
void import_ply(FileImport& target);
void import_stl(FileImport& target);

}  // namespace triptych
