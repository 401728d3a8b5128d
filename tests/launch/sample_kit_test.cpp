// `triptych sample kit`, from the command to the packs and pictures of all of its formats.
#include "tests/session/program.hpp"

#include <gtest/gtest.h>
#include <png.h>
#include <set>

namespace triptych::test {
namespace {

/// Red, green, blue and alpha of each pixel; empty if it cannot be read.
std::vector<uint8_t> pixels_of(const std::string& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, file.c_str())) return {};
  image.format = PNG_FORMAT_RGBA;
  std::vector<uint8_t> pixels(PNG_IMAGE_SIZE(image));
  return png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) ? pixels : std::vector<uint8_t>();
}

/// The share of pixels of which a channel differs by more than rounding.
double different(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  if (a.empty() || a.size() != b.size()) return 1;
  size_t count = 0;
  for (size_t pixel = 0; pixel < a.size(); pixel += 4) {
    bool differs = false;
    for (size_t i = pixel; i < pixel + 4; ++i) differs = differs || std::abs(a[i] - b[i]) > 2;
    count += differs;
  }
  return static_cast<double>(count) / (static_cast<double>(a.size()) / 4);
}

TEST(SampleKitCommand, builds_of_all_formats_have_one_box_the_same_triangles_and_the_same_picture) {
  const Folder folder;
  const std::string kit = folder.file("kit"), json = folder.file("kit.json"), pack = folder.file("kit.tpk"),
                    info = folder.file("info.json");
  // What one that was killed left is neither anybody's nor in the way.
  std::filesystem::create_directories(kit + "/kit.partial-1");
  std::ofstream(kit + "/kit.partial-1/kit.obj") << "half";
  run({"sample", "kit", "-o", kit, "--json", json});
  EXPECT_FALSE(std::filesystem::exists(kit + "/kit.partial-1"));
  const nlohmann::json report = json_of(json);
  std::set<std::string> formats;
  for (const nlohmann::json& file : report["files"]) {
    EXPECT_EQ(file["bytes"], std::filesystem::file_size(kit + "/" + std::string(file["file"])));
    formats.insert(file["format"]);
  }
  EXPECT_EQ(formats.size(), 14u);
  const auto picture = [&](const std::string& format) {
    run({"build", kit + "/kit." + format, "-o", pack});
    const std::string pictures = folder.file(format);
    // Assimp invents smooth normals where it writes OBJ and 3DS files.
    run({"render", pack, "--path", kit + "/walk.json", "--every", "150", "--device", "cpu", "--size",
         "240x160", "--pixel-error", "0.5", "--effects", "vertex-colours", "-o", pictures});
    std::vector<uint8_t> all = pixels_of(pictures + "/000000.png");
    const std::vector<uint8_t> second = pixels_of(pictures + "/000150.png");
    all.insert(all.end(), second.begin(), second.end());
    run({"info", pack, "--json", info});
    std::filesystem::remove(pack);
    return all;
  };
  const std::vector<uint8_t> expected = picture("gltf");
  const nlohmann::json first = json_of(info);
  EXPECT_EQ(expected.size(), 2u * 240 * 160 * 4);
  std::set<std::vector<uint8_t>> colours;
  for (size_t i = 0; i < expected.size(); i += 4)
    colours.insert({expected.begin() + static_cast<std::ptrdiff_t>(i),
                    expected.begin() + static_cast<std::ptrdiff_t>(i) + 3});
  EXPECT_GE(colours.size(), 8u) << "faces of several colours, in several lights";
  for (const std::string& format : formats) {
    SCOPED_TRACE(format);
    const std::vector<uint8_t> found = picture(format);
    const nlohmann::json own = json_of(info);
    EXPECT_EQ(own["placed_triangles"], report["triangles"]);
    for (const char* side : {"min", "max"}) {
      for (size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(double(own["box"][side][axis]), double(first["box"][side][axis]), 1e-4) << side << axis;
    }
    if (format == "stl") {
      EXPECT_GT(different(found, expected), 0.05) << "it has no colours";
    } else {
      EXPECT_LT(different(found, expected), 0.01);
    }
  }
}

}  // namespace
}  // namespace triptych::test
