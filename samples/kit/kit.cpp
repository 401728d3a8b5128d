#include "samples/kit/kit.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/partial_folder.hpp"
#include "samples/kit/kit_files.hpp"
#include "samples/kit/kit_plan.hpp"
#include "samples/kit/run_writer.hpp"
#include "samples/orbits.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace triptych {

namespace {

/// Who writes a format, and the files that come with it.
struct Format {
  const char* name;
  const char* writer;
  const char* beside = "";
};

constexpr const char *own = "triptych", *assimp = "Assimp", *occt = "OpenCASCADE", *web_ifc = "web-ifc";
constexpr std::array formats = {Format{"gltf", own, "kit.bin"},
                                Format{"glb", own},
                                Format{"dxf", own},
                                Format{"3mf", own},
                                Format{"obj", assimp, "kit.mtl"},
                                Format{"ply", assimp},
                                Format{"stl", assimp},
                                Format{"dae", assimp},
                                Format{"3ds", assimp},
                                Format{"x3d", assimp},
                                Format{"fbx", assimp},

                                Format{"step", occt},
                                Format{"igs", occt},
                                Format{"ifc", web_ifc}};

std::filesystem::path this_programs_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

void write_format(const std::string& format, const std::filesystem::path& programs,
                  const std::filesystem::path& folder, bool (*stop)()) {
  const std::filesystem::path file = folder / ("kit." + format);
  if (format == "gltf") return write_kit_gltf(folder);
  if (format == "glb") return write_kit_glb(folder);
  if (format == "dxf") return write_kit_dxf(folder);
  if (format == "3mf") return write_kit_3mf(folder);
  if (format == "ifc") {
    const std::filesystem::path plan = folder / "plan.json";
    write_kit_plan(plan);
    return run_script("kit.ifc", programs.parent_path() / "share/triptych/ifc/write_ifc.mjs", {plan, file},
                      stop);
  }
  run_writer("kit." + format, programs / "triptych-sample-kit", {format, file}, stop);
}

/// Error (the file) where something stands that a file cannot replace: before anything is written.
void check_places(const std::filesystem::path& folder) {
  std::vector<std::string> names = {"walk.json"};
  for (const Format& format : formats) {
    names.push_back(std::string("kit.") + format.name);
    if (*format.beside) names.emplace_back(format.beside);
  }
  for (const std::string& name : names) {
    std::error_code none;
    const std::filesystem::file_status status = std::filesystem::status(folder / name, none);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
      fail((folder / name).string(), "is no file, and stands in the way of one; choose another folder");
  }
}

/// The camera goes once around, comes close, and sees the roof from above.
CameraFrames walk_around() {
  return orbit_walk({.centre = {3.4, 2, -1.6},
                     .radius = 15,
                     .closest = 9,
                     .low = eye_height,
                     .high = 8,
                     .spin = {1.2, eye_height, 0.5}});
}

KitReport described() {
  KitReport report;
  std::set<std::array<uint8_t, 3>> colours;
  for (const KitSolid& solid : kit_solids()) {
    colours.insert(solid.colour);
    report.triangles += mesh_of(solid).triangles.size();
  }
  report.solids = kit_solids().size();
  report.colours = colours.size();
  return report;
}

}  // namespace

KitReport make_kit(const KitOptions& options, const std::filesystem::path& folder) {
  const std::filesystem::path programs =
      options.programs.empty() ? this_programs_folder() : std::filesystem::absolute(options.programs);
  make_folder(folder);
  check_places(folder);
  const PartialFolder work(folder / "kit");  // files are written there first
  KitReport report = described();
  for (const Format& format : formats) {
    if (options.stop && options.stop()) fail(std::string("kit.") + format.name, "was told to end before it");
    write_format(format.name, programs, work.path(), options.stop);
    for (const std::string& name : {std::string("kit.") + format.name, std::string(format.beside)}) {
      if (name.empty()) continue;
      std::error_code error;
      const uint64_t bytes = std::filesystem::file_size(work.path() / name, error);
      if (error || bytes == 0) fail(name, "was not written by {}", format.writer);
      report.files.push_back({name, format.name, format.writer, bytes});
    }
  }
  write_file(work.path() / "walk.json", path_json(walk_around()));
  for (const KitFile& file : report.files)
    std::filesystem::rename(work.path() / file.name, folder / file.name);
  std::filesystem::rename(work.path() / "walk.json", folder / "walk.json");
  return report;
}

}  // namespace triptych
