// The import of one model file: what every importer writes into.
#pragma once

#include "model/import/import.hpp"
#include "model/import/import_limits.hpp"
#include "model/import/object_collector.hpp"
#include "model/import/packed_file.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace triptych {

class SpoolFile;

/// Collects what one file adds to the model, and counts what is left out.
class FileImport {
 public:
  FileImport(std::filesystem::path file, Model& model, const ImportOptions& options = {});

  const std::filesystem::path& file() const { return file_; }
  /// Its name, within an archive the member's: its extension says the format.
  const std::filesystem::path& model_name() const { return packed_.name.empty() ? file_ : packed_.name; }
  /// What the importer reads: the file, or what a .gz or .zip holds (model/import/packed_file.hpp). Error
  /// (the path) if it cannot be opened.
  std::shared_ptr<const StreamSource> content();
  /// Another file that the model names (model/import/beside.hpp), from the same folder or archive; null where
  /// there is none.
  std::shared_ptr<const StreamSource> beside(std::string_view name);
  void unpacks(PackedFile packed);
  /// What was unpacked; null if the file is read as it is.
  const PackedFile* unpacked() const { return packed_.name.empty() ? nullptr : &packed_; }
  const ImportOptions& options() const { return options_; }
  /// The place of errors: the file's name as it was given.
  std::string place() const { return file_.string(); }
  std::string line_place(uint64_t line) const;

  /// Notes another file that belongs to the model.
  void also_reads(const std::filesystem::path& file) { model_.files.push_back(file); }

  /// Counts towards one warning, "<file>: <count> <what>".
  void warn(std::string_view what, uint64_t count = 1);
  /// A warning without a count, "<file>: <what>".
  void remark(std::string what);
  /// The format defines which axis is up, and what is added is converted to y up already: a warning if
  /// ImportOptions differ. Nullopt: it differs from file to file.
  void says_up(std::optional<UpAxis> up);
  /// The format does not define it, but its users agree on one: it is used where ImportOptions say nothing.
  void assume_up(UpAxis up);
  /// The same as says_up() for the unit; what is added is in metres.
  void says_unit(std::optional<LengthUnit> unit);

  /// Where the file says that the model stands; of several that do not agree the first counts. north: of the
  /// model, in metres y up.
  void says_geo_place(const GeoPlace& geo_place);

  /// Counts triangles that were dropped because their coordinates are not finite.
  void drop(uint64_t triangles);
  /// Only counts them: the stream that dropped them has the warning.
  void count_dropped(uint64_t triangles);
  /// Takes over the warnings of a stream that was read into memory.
  void take_warnings(const MeshStream& stream);

  uint32_t add_material(const Material& material);
  uint32_t add_image(ModelImage image);
  /// In the file's own coordinates.
  void add_light(ModelLight light);
  /// Of one that add_material returned.
  void set_material(uint32_t index, const Material& material);
  /// Whether a mesh of so many triangles should stay in its file.
  bool should_stream(uint64_t triangles) const;
  /// How many more triangles may be held in memory.
  uint64_t memory_left() const;
  /// Adds the mesh without the triangles whose coordinates are not finite, and without vertices that only
  /// those used; nullopt if no triangle is left. Indices must be in range.
  std::optional<uint32_t> add_mesh(Mesh mesh);
  uint32_t add_stream(std::string name, std::shared_ptr<const MeshStream> stream);
  void add_instance(uint32_t mesh, const Affine& transform, SourceObjectId object = no_id);
  /// The group's instances are in its own space: only those of groups in the model are turned to metres.
  uint32_t add_group(Group group);
  void add_group_instance(uint32_t group, const Affine& transform, SourceObjectId first_object = no_id);
  /// What moves groups; the index of its first joint in the model's.
  uint32_t add_motion(Motion motion);
  /// Places a group by a joint of the model's.
  void add_moving_group(uint32_t group, uint32_t joint, SourceObjectId first_object);
  /// What the file says of its objects.
  ObjectCollector& objects() { return objects_; }

  /// Moves the warnings into the model's report. Error if the file placed no triangle.
  void finish();

 private:
  uint32_t push_mesh(Mesh mesh);

  std::filesystem::path file_;
  PackedFile packed_;
  Model& model_;
  ImportOptions options_;
  size_t first_instance_, first_group_instance_, first_warning_;
  uint64_t in_memory_ = 0;  ///< triangles of the model's meshes that do not stay in their files
  uint64_t held_bytes_ = 0;
  std::shared_ptr<SpoolFile> store_;  ///< for meshes beyond ImportOptions::held_bytes
  Affine to_metres_y_up_{1};
  ObjectCollector objects_;
  std::vector<std::pair<std::string, uint64_t>> warnings_;  ///< for a count of 0 no number is printed
};

/// One importer per format; each reads the file into the model. Errors as import_model.
void import_gltf(FileImport& target);  ///< .gltf and .glb
void import_obj(FileImport& target);
void import_ply(FileImport& target);
void import_stl(FileImport& target);
void import_dxf(FileImport& target);
void import_3mf(FileImport& target);
void import_ifc(FileImport& target);    ///< .ifc and .ifczip
void import_step(FileImport& target);   ///< .step, .stp, .iges, .igs
void import_other(FileImport& target);  ///< all formats that triptych-import reads

/// The files that a model file refers to, textures included. Error for a file that cannot be opened.
std::vector<std::filesystem::path> files_beside_gltf(const std::filesystem::path& file);
std::vector<std::filesystem::path> files_beside_obj(const std::filesystem::path& file);

/// Imports the .glb that triptych-import made from a file.
void import_gltf(FileImport& target, std::shared_ptr<const StreamSource> source);
/// Imports what the reader of a further format made from a file (scene_stream.hpp).
void import_scene(FileImport& target, std::shared_ptr<const StreamSource> source);

}  // namespace triptych
