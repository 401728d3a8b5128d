// The sample `kit`: one small building in every format that a library on this machine can write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace triptych {

struct KitOptions {
  /// The folder with triptych-sample-kit, beside which `../share/triptych/ifc` has the script that writes
  /// IFC; empty: that of the program that runs.
  std::filesystem::path programs = {};
  bool (*stop)() = nullptr;  ///< asked all the time; once true, that is an Error
};

struct KitFile {
  std::string name;      ///< "kit.obj"
  std::string format{};  ///< "obj"; that of the model which names it, for `kit.bin` and `kit.mtl`
  std::string writer{};  ///< "triptych", or the library
  uint64_t bytes = 0;
};

struct KitReport {
  std::vector<KitFile> files;
  uint64_t solids = 0, colours = 0, triangles = 0;
};

/// Writes `kit.FORMAT` for glTF, GLB, DXF, OBJ, PLY, STL, DAE, 3DS, X3D, FBX, 3MF, STEP, IGES and IFC, what
/// belongs to them, and `walk.json`: all of them, or nothing. Error (the file) for a format whose program is
/// missing or fails.
KitReport make_kit(const KitOptions& options, const std::filesystem::path& folder);

}  // namespace triptych
