// What keeps the house in order: where includes may point, how long a file may be, what the tree may name.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path source_dir = SOURCE_DIR;

/// Who may include whom. What runs (lod, visibility, render, protocol, nodes …) and what prepares a model
/// (model, simplify, light, preprocess) meet in the pack alone.
const std::map<std::string, std::set<std::string>> may_include = [] {
  const std::set<std::string> base = {"base"}, scene = {"base", "scene"};
  const auto with = [](std::set<std::string> rooms, const std::set<std::string>& more) {
    rooms.insert(more.begin(), more.end());
    return rooms;
  };
  const std::set<std::string> visibility = with(scene, {"cells", "lod"});
  const std::set<std::string> devices = with(visibility, {"visibility"});
  const std::set<std::string> nodes = with(devices, {"protocol", "raster", "render", "residency"});
  const std::set<std::string> building = with(scene, {"light", "model", "simplify"});
  const std::set<std::string> measure = with(with(nodes, building), {"nodes", "preprocess"});
  const std::set<std::string> view = with(nodes, {"nodes"});
  const std::set<std::string> session = with(view, {"measure", "view"});
  return std::map<std::string, std::set<std::string>>{
      {"base", {}},
      {"scene", base},
      {"model", scene},
      {"simplify", with(scene, {"model"})},
      {"light", with(scene, {"model"})},
      {"preprocess", building},
      {"cells", scene},
      {"lod", scene},
      {"visibility", visibility},
      {"protocol", devices},
      {"residency", scene},
      {"raster", with(devices, {"residency"})},
      {"render", with(devices, {"residency"})},
      {"nodes", nodes},
      {"measure", measure},
      {"report", scene},
      {"samples", base},
      {"view", view},
      {"session", session},
      {"launch", with(with(session, measure), {"report", "samples", "session"})},
  };
}();

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Our own files of these kinds, or of all where none is named; without what was built.
std::vector<fs::path> files(const std::vector<std::string>& extensions) {
  std::vector<fs::path> found;
  for (auto entry = fs::recursive_directory_iterator(source_dir); entry != fs::recursive_directory_iterator();
       ++entry) {
    const std::string name = entry->path().filename();
    if (name == ".git" && entry->is_regular_file()) continue;  // of a worktree
    if (entry->is_directory() &&
        (name == ".git" || name == "build" || name == "out" || name == "node_modules")) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file() &&
               (extensions.empty() ||
                std::count(extensions.begin(), extensions.end(), entry->path().extension()))) {
      found.push_back(entry->path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string place(const fs::path& file, size_t line) {
  return fs::relative(file, source_dir).string() + ":" + std::to_string(line + 1);
}

TEST(House, rooms_include_those_that_they_may) {
  const std::regex include("#include \"([a-z]+)/.*");
  size_t seen = 0;
  for (const fs::path& file : files({".cpp", ".hpp"})) {
    const std::string room = *fs::relative(file, source_dir).begin();
    const auto from = may_include.find(room);
    if (from == may_include.end()) continue;
    const auto lines = lines_of(file);
    for (size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_match(lines[i], match, include)) continue;
      ++seen;
      EXPECT_TRUE(match[1] == room || from->second.count(match[1]) != 0)
          << place(file, i) << ": " << lines[i];
    }
  }
  EXPECT_GT(seen, 100u) << "the tree was not found";
}

TEST(House, a_sample_includes_no_other_sample_and_what_they_share_includes_none) {
  const std::regex include("#include \"samples/(\\w+)/.*");
  for (const fs::path& file : files({".cpp", ".hpp"})) {
    const fs::path relative = fs::relative(file, source_dir);
    if (*relative.begin() != "samples") continue;
    const std::string own = relative.parent_path().filename();
    const auto lines = lines_of(file);
    for (size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_match(lines[i], match, include)) continue;
      EXPECT_EQ(match[1], own) << place(file, i);
    }
  }
}

TEST(House, no_two_rooms_include_each_other) {
  for (const auto& [room, others] : may_include) {
    for (const std::string& other : others) {
      ASSERT_EQ(may_include.count(other), 1u) << other;
      EXPECT_EQ(may_include.at(other).count(room), 0u) << room << " and " << other;
    }
  }
}

/// Lines of the room's files that match, but for those in folders below it where `top_only`.
std::vector<std::string> lines_that_match(const std::string& room, const std::regex& pattern,
                                          bool headers_only, bool top_only) {
  std::vector<std::string> found;
  const auto extensions =
      headers_only ? std::vector<std::string>{".hpp"} : std::vector<std::string>{".cpp", ".hpp"};
  for (const fs::path& file : files(extensions)) {
    const fs::path name = fs::relative(file, source_dir);
    if (*name.begin() != room || (top_only && name.parent_path() != room)) continue;
    const auto lines = lines_of(file);
    for (size_t i = 0; i < lines.size(); ++i) {
      if (std::regex_search(lines[i], pattern)) found.push_back(place(file, i) + ": " + lines[i]);
    }
  }
  return found;
}

TEST(House, opengl_stays_behind_the_device) {
  const std::regex opengl(R"(<glad|\bGL(enum|u?int|sizei|float|_[A-Z])|\bgl[A-Z]\w+\()");
  EXPECT_EQ(lines_that_match("render", opengl, true, true), std::vector<std::string>());
  for (const std::string room : {"visibility", "nodes", "measure", "view", "session", "launch"})
    EXPECT_EQ(lines_that_match(room, opengl, false, false), std::vector<std::string>());
  EXPECT_FALSE(lines_that_match("render", opengl, false, false).empty()) << "OpenGL was not found at all";
  const std::regex private_header("#include \"render/gl/");
  for (const auto& [room, others] : may_include) {
    if (room != "render") {
      EXPECT_EQ(lines_that_match(room, private_header, false, false), std::vector<std::string>());
    }
  }
}

TEST(House, faults_stand_at_seams_and_not_in_algorithms) {
  const std::regex asked(R"(\binjected\()");
  for (const auto& [room, others] : may_include) {
    if (room == "base") continue;
    for (const std::string& line : lines_that_match(room, asked, false, false)) {
      const bool at_seam = std::regex_search(
          line, std::regex("injected_rules.cpp|session/run_role.cpp|session/session_connector.cpp"));
      EXPECT_TRUE(at_seam) << line;
    }
  }
}

TEST(House, every_room_is_known) {
  for (const auto& entry : fs::directory_iterator(source_dir)) {
    if (!fs::exists(entry.path() / "CMakeLists.txt")) continue;
    const std::string room = entry.path().filename();
    EXPECT_TRUE(room == "tests" || may_include.count(room) != 0) << room;
  }
}

TEST(House, no_two_types_that_several_files_see_have_one_name) {
  // The linker would take the functions of either for both. Those of one file are in unnamed namespaces.
  const std::regex type("^(?:struct|class|enum class|union) ([A-Z][A-Za-z0-9]*)[^;]*$");
  std::map<std::string, std::set<std::string>> types;  // by name, room and file without its extension
  for (const fs::path& file : files({".cpp", ".hpp"})) {
    const fs::path name = fs::relative(file, source_dir);
    const std::string room = *name.begin();
    if (room == "tests") continue;
    bool is_unnamed = false;
    for (const std::string& line : lines_of(file)) {
      if (line == "namespace {") is_unnamed = true;
      if (line == "}  // namespace") is_unnamed = false;
      std::smatch found;
      if (is_unnamed || !std::regex_match(line, found, type)) continue;
      types[found[1]].insert(room + " " + name.stem().string());
    }
  }
  EXPECT_GT(types.size(), 300u);
  for (const auto& [name, places] : types)
    EXPECT_EQ(places.size(), 1u) << name << " in " << *places.begin() << " and " << *places.rbegin();
}

TEST(House, every_test_is_built) {
  std::string lists;
  for (const fs::path& file : files({".txt"})) {
    if (file.filename() != "CMakeLists.txt") continue;
    for (const std::string& line : lines_of(file)) lists += line + "\n";
  }
  for (const fs::path& file : files({".cpp"})) {
    const std::string name = file.filename();
    if (!name.ends_with("_test.cpp")) continue;
    EXPECT_NE(lists.find(name), std::string::npos) << place(file, 0);
  }
}

TEST(House, a_file_does_one_thing_in_at_most_400_lines) {
  for (const fs::path& file : files({".cpp", ".hpp"})) {
    EXPECT_LE(lines_of(file).size(), 400u) << place(file, 0);
  }
}

TEST(House, nothing_names_a_machine_or_calls_itself_unfinished) {
  const std::regex machine(R"((^|[^\w.$}>])/(home|root|work|Users|mnt)/\w|\.\./shared|\bissue #?\d)");
  const std::regex unfinished(R"(\b(TO)"
                              R"(DO|FIX)"
                              R"(ME|XX)"
                              R"(X)\b)");
  for (const fs::path& file : files({".cpp", ".hpp", ".md", ".cmake", ".txt", ".json", ""})) {
    const auto lines = lines_of(file);
    for (size_t i = 0; i < lines.size(); ++i) {
      EXPECT_FALSE(std::regex_search(lines[i], machine)) << place(file, i) << ": " << lines[i];
      EXPECT_FALSE(std::regex_search(lines[i], unfinished)) << place(file, i) << ": " << lines[i];
    }
  }
}

/// What is tracked; where there is no git, what lies there. Relative to the top.
std::vector<fs::path> tracked_files() {
  const std::string command = "git -C '" + source_dir.string() + "' ls-files 2>/dev/null";
  std::string list;
  if (FILE* pipe = fs::exists(source_dir / ".git") ? ::popen(command.c_str(), "r") : nullptr) {
    char part[4096];
    for (size_t count; (count = std::fread(part, 1, sizeof(part), pipe)) > 0;) list.append(part, count);
    ::pclose(pipe);
  }
  std::vector<fs::path> found;
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);) found.emplace_back(line);
  if (!found.empty()) return found;
  for (const fs::path& file : files({})) found.push_back(fs::relative(file, source_dir));
  return found;
}

/// What may lie in which folder, by the whole path.
const std::vector<std::string> places = {
    R"(README\.md|LICENSE|CMakeLists\.txt|CMakePresets\.json|\.gitignore|\.clang-format|\.ci/run)",
    R"((base|scene|cells|model|simplify|light|preprocess|lod|visibility|residency|raster|protocol|render|nodes|measure|report|samples|view|session|launch)/(\w+/)?\w+\.[ch]pp)",
    R"((\w+/)+CMakeLists\.txt)",
    R"(launch/(packages\.txt|compile|demo|install))",
    R"(launch/ifc/(\w+\.mjs|package(-lock)?\.json))",
    R"(cmake/[\w-]+\.cmake|cmake/precompiled/\w+\.[ch]pp)",
    R"(docs/[\w-]+\.(md|png)|docs/walk\.json|docs/hard-cases/\w+\.png)",
    R"(tests/(\w+/)+\w+\.([ch]pp|cmake|py|supp)|tests/(run|check_formatting|check_names|fuzz/run|raster/no_weak_symbols))",
    R"(tests/fuzz/findings/README\.md|tests/fuzz/findings/\w+/[\w.-]+)"};

TEST(House, everything_lies_in_its_place_and_no_note_was_left_behind) {
  const std::vector<fs::path> tracked = tracked_files();
  EXPECT_GT(tracked.size(), 500u) << "the tree was not found";
  for (const fs::path& file : tracked) {
    EXPECT_TRUE(std::any_of(
        places.begin(), places.end(),
        [&](const std::string& place) { return std::regex_match(file.string(), std::regex(place)); }))
        << file << " has no place in the tree (tests/house knows them)";
  }
}

TEST(House, every_page_of_the_docs_can_be_found_from_the_readme) {
  std::string readme;
  for (const std::string& line : lines_of(source_dir / "README.md")) readme += line;
  for (const fs::path& file : tracked_files()) {
    if (file.extension() != ".md" || *file.begin() != "docs") continue;
    EXPECT_NE(readme.find("(" + file.string() + ")"), std::string::npos) << file << " is linked nowhere";
  }
}

TEST(House, the_list_of_packages_is_sorted_and_names_each_once) {
  std::vector<std::string> packages = lines_of(source_dir / "launch/packages.txt");
  std::erase_if(packages, [](const std::string& line) { return line.empty() || line.front() == '#'; });
  ASSERT_FALSE(packages.empty());
  EXPECT_TRUE(std::is_sorted(packages.begin(), packages.end()));
  EXPECT_EQ(std::adjacent_find(packages.begin(), packages.end()), packages.end());
}

TEST(House, what_a_newcomer_calls_can_be_called) {
  for (const char* script : {"launch/install", "launch/compile", "launch/demo", "tests/run",
                             "tests/check_formatting", "tests/check_names", ".ci/run"}) {
    const fs::path file = source_dir / script;
    ASSERT_TRUE(fs::exists(file)) << script;
    EXPECT_NE(fs::status(file).permissions() & fs::perms::owner_exec, fs::perms::none) << script;
    EXPECT_EQ(lines_of(file).front(), "#!/usr/bin/env bash") << script;
  }
}

}  // namespace
