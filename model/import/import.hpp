// Imports model files by their extension: glTF and GLB, OBJ, PLY, STL, IFC, STEP, IGES, and the formats that
// Assimp reads.
#pragma once

#include "model/model.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

class KeptConversions;

enum class UpAxis : uint8_t { y, z };
enum class LengthUnit : uint8_t { metre, centimetre, millimetre, inch, foot };

struct ImportOptions {
  /// The up axis and unit of files that do not define them (OBJ, PLY, STL); by default y and metres. Where a
  /// format defines something else, the format is followed, and the report has a warning.
  std::optional<UpAxis> up = std::nullopt;
  std::optional<LengthUnit> unit = std::nullopt;
  /// How far triangles may lie from the curved surfaces of STEP and IGES files, metres; by default a
  /// ten-thousandth of the size of what is in the file.
  std::optional<double> chord = std::nullopt;
  /// Where on Earth the model stands; otherwise where its files say.
  std::optional<GeoPlace> geo_place = std::nullopt;
  /// The folder for binary copies of large text files during the import, in files without a name; empty:
  /// TMPDIR or /tmp.
  std::filesystem::path temporary_folder = {};
  /// Meshes of more triangles stay in their file (Mesh::stream) ...
  uint64_t stream_above = 4096;
  /// ... and so do all further ones once those in memory would have more than this many together.
  uint64_t max_in_memory = 2'000'000;
  /// Meshes that are held in memory take no more than this, bytes: further ones are stored in the temporary
  /// folder, as streams that MeshStream::load() reads back.
  uint64_t held_bytes = uint64_t{1} << 40;
  /// Positions of meshes that stay in their files, cached while those are read: for all threads together, and
  /// for the rest of the process. Less of it makes reading slower where triangles use vertices in no order.
  uint64_t position_cache_bytes = uint64_t{64} << 20;
  /// Subtrees of a scene's nodes that are equal become one group (Model::groups) if they place at least this
  /// many meshes, and this many triangles, in all places together: fewer are not worth a hierarchy of their
  /// own. If false, they are instances like all others.
  bool find_groups = true;
  uint64_t group_placements = 8;
  uint64_t group_triangles = 1u << 14;
  /// DXF and 3MF place blocks and objects within each other, so that a small file may ask for any number of
  /// placements: those beyond so many are skipped, with a warning.
  uint64_t max_placements = 10'000'000;
  /// The program that reads further formats; empty: one of triptych-import, triptych-import-ifc and
  /// triptych-import-step beside the program that runs.
  std::filesystem::path converter = {};
  /// It is killed if it takes more memory, or so much time without saying that it has come further.
  uint64_t converter_bytes = uint64_t{4} << 30;
  double converter_seconds = 600;
  /// What those programs made of IFC, STEP and IGES files is taken from there, and kept; null: they always
  /// run.
  KeptConversions* kept_conversions = nullptr;
};

/// Reads every file into one model in metres, y up. The model's report says what was dropped, merged or not
/// understood; streams report it when they are read. Error (file and place in it) for a file that is missing,
/// damaged, empty of triangles or of an unknown format.
Model import_model(const std::vector<std::filesystem::path>& files, const ImportOptions& options = {});

/// The models' own files: these, and the buffers, material libraries and textures that they name, whether or
/// not they are read or exist. What triptych-import opens beside a file is not among them: Model::files has
/// it. Geometry is not read. Error for a file that cannot be opened.
std::vector<std::filesystem::path> files_of_models(const std::vector<std::filesystem::path>& models);

/// Whether a file of this name is one that import_model reads, by its extension: also .gz and .zip.
bool is_model_name(const std::filesystem::path& file);

/// The extensions that import_model knows, with their dots: those of our own readers, then those that
/// triptych-import reads.
std::vector<std::string> known_extensions();

}  // namespace triptych
