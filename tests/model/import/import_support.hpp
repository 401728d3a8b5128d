// Small model files for the tests of the importers.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/import/import.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::test {

/// Writes a file into a folder of the running test's own.
inline std::filesystem::path write_model(const std::string& name, std::string_view contents) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = std::filesystem::path(testing::TempDir()) / "triptych_import" /
                      (std::string(test->test_suite_name()) + "_" + test->name());
  make_folder(folder);
  // Neither write_file() nor an overwritten file: both wait for the disk.
  std::filesystem::remove(folder / name);
  std::ofstream(folder / name, std::ios::binary) << contents;
  return folder / name;
}

/// A folder of the running test's own with nothing in it.
inline std::filesystem::path empty_folder(const std::string& name) {
  const auto folder = write_model("beside", "").parent_path() / name;
  std::filesystem::remove_all(folder);
  make_folder(folder);
  return folder;
}

inline Model import_text(const std::string& name, std::string_view contents,
                         const ImportOptions& options = {}) {
  return import_model({write_model(name, contents)}, options);
}

/// What the error says behind the file's name; empty if there is none.
inline std::string import_error(const std::string& name, std::string_view contents) {
  const auto file = write_model(name, contents);
  try {
    import_model({file});
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find(file.string()), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), file.string().size() + 300) << message;
    return message.substr(std::min(message.size(), file.string().size() + 2));
  }
  return "";
}

inline const ImportOptions streamed = {.stream_above = 0};
inline const ImportOptions in_memory = {.stream_above = 1u << 30, .max_in_memory = 1u << 30};

/// Of either kind of mesh.
inline std::vector<CornerTriangle> triangles_of(const Mesh& mesh) {
  std::vector<CornerTriangle> triangles;
  if (mesh.stream) {
    mesh.stream->read([&](std::span<const CornerTriangle> batch) {
      triangles.insert(triangles.end(), batch.begin(), batch.end());
    });
    return triangles;
  }
  for (const Triangle& triangle : mesh.triangles) {
    triangles.push_back({{mesh.positions[triangle.vertices[0]], mesh.positions[triangle.vertices[1]],
                          mesh.positions[triangle.vertices[2]]},
                         triangle.material});
  }
  return triangles;
}

/// Whether a warning of the model says this.
inline bool warns(const Model& model, std::string_view what) {
  for (const std::string& warning : model.report.warnings) {
    if (warning.find(what) != std::string::npos) return true;
  }
  return false;
}

/// Every cut and every single flipped byte of the file imports or gives an Error; it never crashes.
inline void expect_robust(const std::string& name, const std::string& contents) {
  const auto attempt = [&](const std::string& damaged) {
    const auto file = write_model(name, damaged);
    try {
      const Model model = import_model({file});
      for (const Mesh& mesh : model.meshes) {
        for (const Triangle& triangle : mesh.triangles) {
          for (const uint32_t vertex : triangle.vertices) ASSERT_LT(vertex, mesh.positions.size());
          ASSERT_LT(triangle.material, model.materials.size());
        }
      }
    } catch (const Error&) {
    }
  };
  for (size_t length = 0; length < contents.size(); ++length) attempt(contents.substr(0, length));
  for (size_t i = 0; i < contents.size(); ++i) {
    std::string damaged = contents;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
    attempt(damaged);
  }
}

/// Appends the bytes of a value, in the other byte order if asked for.
template <typename Value>
void append(std::string& bytes, Value value, bool swapped = false) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  if (swapped) std::reverse(raw, raw + sizeof(Value));
  bytes.append(raw, sizeof(Value));
}

}  // namespace triptych::test
