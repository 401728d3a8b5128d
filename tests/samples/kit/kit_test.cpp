// The sample `kit`: what libraries wrote of one building in 14 formats is read back as that building.
#include "samples/kit/kit.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "model/flatten.hpp"
#include "model/import/display_color.hpp"
#include "samples/kit/kit_plan.hpp"
#include "tests/model/import/import_support.hpp"
#include "tests/samples/mesh_edges.hpp"
#include "tests/samples/sample_files.hpp"

#include <fstream>
#include <glm/glm.hpp>
#include <map>
#include <set>

namespace triptych {
namespace {

using Colour = std::array<int, 3>;
using Corners = std::array<glm::dvec3, 3>;

/// What triangles of one colour are together.
struct Sum {
  uint64_t triangles = 0;
  double area = 0;
  glm::dvec3 moment{0};  ///< area by position: tells where they are
  double volume = 0;     ///< positive where they look outward

  void add(const Corners& corners) {
    const auto& [a, b, c] = corners;
    const double own = glm::length(glm::cross(b - a, c - a)) / 2;
    ++triangles;
    area += own;
    moment += own * (a + b + c) / 3.0;
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
};

struct Summary {
  glm::dvec3 low{1e30}, high{-1e30};
  std::map<Colour, Sum> colours;
  std::set<std::string> names;

  void add(const Corners& corners, const Colour& colour) {
    for (const glm::dvec3& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
    colours[colour].add(corners);
  }
};

/// In metres, y up. Without colours all is of one, as it comes without a material.
Summary summary_of_plan(bool coloured) {
  Summary summary;
  for (const KitSolid& solid : kit_solids()) {
    const KitMesh mesh = mesh_of(solid);
    summary.names.insert(solid.name);
    const uint8_t none = display_byte(Material().base_color.r);
    const auto colour = coloured ? solid.colour : std::array<uint8_t, 3>{none, none, none};
    for (const auto& [a, b, c] : mesh.triangles)
      summary.add(
          {turned_y_up(mesh.positions[a]), turned_y_up(mesh.positions[b]), turned_y_up(mesh.positions[c])},
          {colour[0], colour[1], colour[2]});
  }
  return summary;
}

Colour colour_of(const Model& model, const Mesh& mesh, const Triangle& triangle) {
  if (mesh.has_colors() && triangle.material == 0) {
    const VertexColor colour = mesh.colors.at(triangle.vertices[0]);
    for (const uint32_t vertex : triangle.vertices) EXPECT_EQ(mesh.colors.at(vertex), colour);
    return {colour[0], colour[1], colour[2]};
  }
  const glm::dvec4 colour(model.materials.at(triangle.material).base_color);
  return {display_byte(colour.r), display_byte(colour.g), display_byte(colour.b)};
}

Summary summary_of(const Model& model) {
  Summary summary;
  for (const Instance& instance : flattened(model).instances) {
    const Mesh& mesh = model.meshes.at(instance.mesh);
    for (const Triangle& triangle : mesh.triangles) {
      Corners corners;
      for (size_t i = 0; i < 3; ++i)
        corners[i] = instance.transform * glm::dvec4(mesh.positions.at(triangle.vertices[i]), 1);
      summary.add(corners, colour_of(model, mesh, triangle));
    }
    if (instance.object == no_id) continue;
    const SourceObject& object = model.source_objects.objects.at(instance.object);
    summary.names.insert(std::string(model.source_objects.texts[object.name]));
  }
  return summary;
}

double distance(const Summary& a, const Summary& b) {
  return std::max(glm::length(a.low - b.low), glm::length(a.high - b.high));
}

/// What a format is expected to keep.
struct Kept {
  const char* format;
  double tolerance;  ///< of the box, metres
  bool colours = true;
  bool names = true;
};

// Numbers of seven digits or single precision keep 8.2 m to a millionth.
constexpr double exact = 1e-9, single = 2e-6;
constexpr std::array formats = {
    Kept{"gltf", single},
    Kept{"glb", single},
    Kept{"dxf", exact},
    Kept{"3mf", exact},
    Kept{"obj", single},
    Kept{"ply", single, true, false},
    Kept{"stl", single, false, false},
    Kept{"dae", single},
    Kept{"3ds", single},
    Kept{"x3d", single, true, false},
    Kept{"fbx", single},
    Kept{"step", exact},
    Kept{"igs", exact},
    Kept{"ifc", single},
};

void expect_equal(const Summary& found, const Summary& expected, const Kept& kept) {
  EXPECT_LT(distance(found, expected), kept.tolerance)
      << found.low.x << " " << found.low.y << " " << found.low.z << " to " << found.high.x << " "
      << found.high.y << " " << found.high.z;
  ASSERT_EQ(found.colours.size(), expected.colours.size());
  for (const auto& [colour, sum] : expected.colours) {
    SCOPED_TRACE(fmt::format("colour {} {} {}", colour[0], colour[1], colour[2]));
    ASSERT_EQ(found.colours.count(colour), 1u);
    const Sum& own = found.colours.at(colour);
    EXPECT_EQ(own.triangles, sum.triangles);
    EXPECT_NEAR(own.area, sum.area, 1e-4);
    EXPECT_LT(glm::length(own.moment - sum.moment), 1e-3);
    EXPECT_NEAR(own.volume, sum.volume, 1e-4);
  }
}

TEST(SampleKit, every_format_gives_the_same_box_triangles_colours_and_names) {
  const Folder folder("kit");
  const KitReport report = make_kit({}, folder.path());
  std::set<std::string> written;
  for (const KitFile& file : report.files) {
    written.insert(file.format);
    EXPECT_EQ(file.bytes, std::filesystem::file_size(folder.path() / file.name)) << file.name;
  }
  EXPECT_EQ(written.size(), formats.size());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "walk.json"));
  for (const Kept& kept : formats) {
    SCOPED_TRACE(kept.format);
    ASSERT_EQ(written.count(kept.format), 1u);
    const Model model = read_whole(folder.path() / ("kit." + std::string(kept.format)));
    const Summary expected = summary_of_plan(kept.colours), found = summary_of(model);
    EXPECT_EQ(model.placed_triangles(), report.triangles);
    expect_equal(found, expected, kept);
    for (const std::string& name : expected.names) {
      // 3DS has the mesh's name and a number behind the node's.
      const std::string longer = name + "_" + name + "_";
      const bool known = std::any_of(found.names.begin(), found.names.end(), [&](const std::string& own) {
        return own == name || (kept.format == std::string("3ds") && own.starts_with(longer));
      });
      EXPECT_EQ(known, kept.names) << name;
    }
  }
}

TEST(SampleKit, storeys_come_back_from_the_formats_that_have_them) {
  const Folder folder("kit_storeys");
  make_kit({}, folder.path());
  const Model ifc = read_whole(folder.path() / "kit.ifc");
  std::set<std::string> storeys;
  for (const SourceObject& object : ifc.source_objects.objects)
    storeys.insert(std::string(ifc.source_objects.texts[object.storey]));
  EXPECT_EQ(storeys, (std::set<std::string>{"Ground floor", "Upper floor"}));
  for (const char* format : {"gltf", "glb", "dae", "fbx"}) {
    const Model model = read_whole(folder.path() / (std::string("kit.") + format));
    storeys.clear();
    for (const Instance& instance : flattened(model).instances)
      storeys.insert(model.source_objects.path_of(instance.object));
    EXPECT_EQ(storeys, (std::set<std::string>{"Ground floor", "Upper floor"})) << format;
  }
}

TEST(SampleKit, its_solids_are_closed_and_its_box_shows_turns_and_mirror_images) {
  const Summary plan = summary_of_plan(true);
  EXPECT_EQ(plan.names.size(), kit_solids().size());
  EXPECT_GE(plan.colours.size(), 6u);
  std::set<long> distances;
  for (int axis = 0; axis < 3; ++axis)
    distances.insert({std::lround(1000 * std::abs(plan.low[axis])), std::lround(1000 * plan.high[axis])});
  EXPECT_EQ(distances.size(), 6u);
  for (const KitSolid& solid : kit_solids()) {
    const KitMesh mesh = mesh_of(solid);
    for (const auto& [edge, use] : edges_of(mesh.triangles))
      EXPECT_TRUE(use.forwards == 1 && use.backwards == 1) << solid.name;
    EXPECT_GT(volume_of(mesh.positions, mesh.triangles), 0) << solid.name;
    EXPECT_EQ(mesh.triangles.size(), 4 * solid.outline.size() - 4) << solid.name;
  }
}

/// What make_kit complains of; it leaves nothing in its folder.
std::string complaint(const std::filesystem::path& programs, bool (*stop)() = nullptr) {
  const Folder folder("kit_none");
  std::string message;
  try {
    make_kit({.programs = programs, .stop = stop}, folder.path());
  } catch (const Error& error) {
    message = error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  return message;
}

/// A folder with a program in place of triptych-sample-kit.
std::filesystem::path programs_with(const std::string& script) {
  const auto folder = test::empty_folder("programs");
  const auto program = folder / "triptych-sample-kit";
  std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  return folder;
}

TEST(SampleKit, what_a_killed_one_left_is_removed_by_the_next) {
  const Folder folder("kit_left");
  std::filesystem::create_directories(folder.path() / "kit.partial-1/below");
  std::ofstream(folder.path() / "kit.partial-1/below/kit.obj") << "half";
  EXPECT_THROW(make_kit({.programs = "", .stop = [] { return true; }}, folder.path()), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(SampleKit, a_program_that_is_missing_or_fails_is_named_with_its_format_and_nothing_is_left) {
  const auto nothing = test::empty_folder("nothing");
  EXPECT_EQ(complaint(nothing),
            "kit.obj: is written by " + (nothing / "triptych-sample-kit").string() + ", which is not there");
  const std::string writes = "echo x > $2; [ $1 = obj ] && echo x > ${2%.obj}.mtl\n";
  EXPECT_EQ(complaint(programs_with(writes +
                                    "[ $1 != step ] || { echo noise; echo 'triptych: OpenCASCADE: no' >&2; "
                                    "echo more; exit 1; }")),
            "kit.step: OpenCASCADE: no");
  EXPECT_NE(complaint(programs_with(writes + "[ $1 != ply ] || kill -SEGV $$")).find("kit.ply: "),
            std::string::npos);
  EXPECT_NE(complaint(programs_with(writes + "[ $1 != ply ] || kill -SEGV $$")).find("signal 11"),
            std::string::npos);
  EXPECT_NE(complaint(programs_with("exit 7")).find("exit code 7"), std::string::npos);
  EXPECT_EQ(complaint(programs_with("[ $1 = dae ] || { " + writes + " }; exit 0")),
            "kit.dae: was not written by Assimp");
  EXPECT_EQ(complaint("", [] { return true; }), "kit.gltf: was told to end before it");
  EXPECT_NE(complaint(programs_with(writes + "exit 0")).find("kit.ifc: is written by "), std::string::npos);
}

TEST(SampleKit, ends_when_it_is_told_to_while_a_program_writes) {
  static int asked;
  asked = 0;
  const Stopwatch stopwatch;
  // The program sleeps at OBJ, whose turn comes after some questions.
  const std::string said = complaint(programs_with("exec sleep 60"), [] { return ++asked > 10; });
  EXPECT_NE(said.find("kit.obj: was told to end while "), std::string::npos) << said;
  EXPECT_LT(stopwatch.seconds(), 30);
}

TEST(SampleKit, replaces_files_of_its_names_or_nothing) {
  const auto folder = test::empty_folder("obstacle");
  std::filesystem::create_directories(folder / "kit.obj");
  std::ofstream(folder / "kit.gltf") << "mine";
  EXPECT_THROW(make_kit({.programs = programs_with("exit 0")}, folder), Error);
  std::string kept;
  std::ifstream(folder / "kit.gltf") >> kept;
  EXPECT_EQ(kept, "mine");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 2);
}

}  // namespace
}  // namespace triptych
