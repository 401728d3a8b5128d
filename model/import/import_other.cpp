// Formats without a reader of ours: triptych-import makes a .glb of them.
#include "model/import/converter.hpp"
#include "model/import/import_file.hpp"
#include "model/import/mesh_stream_source.hpp"

#include <array>
#include <cctype>

namespace triptych {

namespace {

/// Which axes and unit formats define. triptych-import converts all of these to y up, and those with a unit
/// to metres.
struct Convention {
  const char* extension;
  bool unit;
  std::optional<UpAxis> up;  ///< nullopt: differs from file to file
};

constexpr std::array conventions = {
    Convention{".dae", true, std::nullopt}, Convention{".zae", true, std::nullopt},
    Convention{".fbx", true, std::nullopt}, Convention{".3ds", false, UpAxis::z},
    Convention{".prj", false, UpAxis::z},   Convention{".ase", false, UpAxis::z},
    Convention{".ask", false, UpAxis::z}};

}  // namespace

void import_other(FileImport& target) {
  std::string extension = target.model_name().extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const Convention& convention : conventions) {
    if (extension != convention.extension) continue;
    target.says_up(convention.up);
    if (convention.unit) target.says_unit(std::nullopt);
  }
  Converted converted =
      convert_model(target.file(), target.unpacked(), target.options(), {"triptych-import", "Assimp", {}});
  for (std::string& warning : converted.warnings) target.remark(std::move(warning));
  for (const auto& file : converted.also_read) target.also_reads(file);
  import_gltf(target, std::move(converted.output));
}

}  // namespace triptych
