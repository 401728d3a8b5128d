// A small model file that names another one, for commands that take models.
#pragma once

#include "tests/session/scene_files.hpp"

#include <cstdlib>

namespace triptych::test {

/// A variable of the environment while this lives; programs that are started inherit it.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

/// box.obj and box.mtl in a folder of the test's own, a path before it, and a cache for packs beside them.
class ModelFiles : public testing::Test {
 protected:
  ModelFiles() {
    write_model(folder.file("."));
    View view;
    view.camera.eye = {3, 2, 5};
    view.camera.target = {0, 0, 0};
    view.width = view.height = 64;
    std::ofstream(path) << path_text({view, view});
  }

  static void write_model(const std::filesystem::path& where, const std::string& color = "1 0 0",
                          const std::string& more = "") {
    std::filesystem::create_directories(where);
    std::ofstream(where / "box.mtl") << "newmtl paint\nKd " << color << "\n" << more;
    std::ofstream(where / "box.obj")
        << "mtllib box.mtl\nusemtl paint\n"
           "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\n"
           "v -1 1 1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  }
  /// Draws the path; whether a pack had to be built for it.
  bool draws_after_a_build(const std::vector<std::string>& what, const std::string& into) const {
    std::vector<std::string> words = {"render"};
    words.insert(words.end(), what.begin(), what.end());
    for (const std::string& word :
         {std::string("--path"), path, std::string("--size"), std::string("64x64"), std::string("--device"),
          std::string("cpu"), std::string("-o"), folder.file(into)})
      words.push_back(word);
    Program program(words);
    EXPECT_EQ(program.wait(), 0) << program.errors();
    return program.errors().find("building a pack") != std::string::npos;
  }
  std::string picture(const std::string& in) const { return text_of(folder.file(in + "/000000.png")); }
  size_t cached() const {
    std::error_code none;
    const std::filesystem::directory_iterator entries(folder.file("cache"), none);
    return static_cast<size_t>(std::distance(begin(entries), end(entries)));
  }

  Folder folder;
  const std::string model = folder.file("box.obj"), path = folder.file("path.json");
  const Variable cache{"TRIPTYCH_CACHE", folder.file("cache")};
};

}  // namespace triptych::test
