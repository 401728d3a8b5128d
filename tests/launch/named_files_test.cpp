// What a command writes is none of the other files that it was given.
#include "launch/named_files.hpp"

#include "base/error.hpp"
#include "launch/answering.hpp"
#include "session/role_arguments.hpp"
#include "tests/session/program.hpp"

#include <set>

namespace triptych::test {
namespace {

void add_all(CLI::App& app, Action& action) {
  for (const auto add : {add_sample, add_build, add_info, add_check, add_render, add_view, add_session,
                         add_replay, add_explain, add_role, add_measure, add_report, add_selftest})
    add(app, action);
  int failed = 1;
  add_diff(app, action, failed);
}

class NamedFiles : public testing::Test {
 protected:
  NamedFiles() {
    for (const std::string& file : {pack, path}) std::ofstream(file) << "something";
  }
  /// What is said about the command line; empty where it may run.
  static std::string refusal(std::vector<std::string> words,
                             void (*check)(const CLI::App&) = check_files_differ) {
    CLI::App app;
    Action action;
    add_all(app, action);
    std::reverse(words.begin(), words.end());
    app.parse(std::move(words));
    try {
      check(app);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  Folder folder;
  const std::string pack = folder.file("x.tpk"), path = folder.file("walk.json"), fresh = folder.file("new");
};

TEST_F(NamedFiles, an_output_is_no_input_of_the_same_command) {
  EXPECT_EQ(refusal({"info", pack, "--json", pack}),
            pack + ": --json would be written over " + pack + ", which the same command line names as pack");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"render", pack, "--path", path, "-o", fresh, "--json", path},
           {"render", pack, "--path", path, "-o", fresh, "--timeline", pack},
           {"session", pack, "--path", path, "--key-file", path, "--timeline", path},
           {"session", pack, "--path", path, "--record", pack},
           {"measure", "session", pack, "--path", path, "--hosts", path, "--json", path},
           {"measure", "build", path, pack, "--keep-pack", pack},
           {"measure", "hierarchy", pack, "--path", path, "--json", pack},
           {"explain", pack, "--path", path, "--frame", "1", "--pixel", "1,1", "--json", path},
           {"replay", folder.file(""), "--pack", pack, "--frame", "1", "-o", pack},
           {"role", "switch", pack, "--index", "1", "--render", "a:1", "--switch-0", "b:1", "--json", pack},
           {"report", path, "-o", fresh, "--json", path}})
    EXPECT_NE(refusal(words), "") << words[0] << " " << words.back();
}

TEST_F(NamedFiles, two_outputs_are_two_files_also_where_neither_is_there) {
  EXPECT_NE(refusal({"build", pack, "-o", fresh, "--json", fresh}), "");
  EXPECT_NE(refusal({"build", pack, "-o", fresh, "--json", folder.file("./new")}), "");
  EXPECT_NE(refusal({"render", pack, "--path", path, "-o", fresh, "--timeline", fresh}), "");
}

TEST_F(NamedFiles, an_output_has_no_name_that_the_command_gives_to_others_in_its_folder) {
  const std::string pictures = folder.file("pictures");
  const auto inside = [&](const std::string& name) { return pictures + "/" + name; };
  EXPECT_EQ(refusal({"render", pack, "--path", path, "-o", pictures, "--json", inside("000017.png")}),
            inside("000017.png") +
                ": is a name that this command gives to what it writes into its --output " + pictures);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"session", pack, "--path", path, "-o", pictures, "--timeline", inside("000001.png")},
           {"session", pack, "--path", path, "--record", pictures, "--json", inside("render.recording")},
           {"replay", folder.file(""), "--frames", "all", "-o", pictures, "--json", inside("000001.png")},
           {"sample", "plant", "-o", pictures, "--json", inside("walk.json")},
           {"sample", "statue", "-o", pictures, "--json", inside("scene.ply")},
           {"report", path, "-o", pictures, "--json", inside("report.json")},
           {"report", inside("report.json"), "-o", pictures}})
    EXPECT_NE(refusal(words), "") << words[0] << " " << words.back();
  EXPECT_EQ(refusal({"render", pack, "--path", path, "-o", pictures, "--json", inside("report.json")}), "");
  EXPECT_EQ(refusal({"sample", "plant", "-o", pictures, "--json", inside("sample.json")}), "");
}

TEST_F(NamedFiles, an_output_is_no_folder_of_another_one) {
  EXPECT_NE(refusal({"render", pack, "--path", path, "-o", fresh + "/a/b", "--json", fresh + "/a"}), "");
  EXPECT_NE(refusal({"build", path, "-o", fresh, "--json", fresh + "/report.json"}), "");
}

TEST_F(NamedFiles, what_cannot_be_read_or_written_is_said_before_any_work) {
  const auto said = [](const std::vector<std::string>& words) {
    return refusal(words, check_files_can_be_used);
  };
  const std::string here = folder.file("."), nowhere = folder.file("none/x");
  EXPECT_EQ(said({"info", here}), here + ": is a folder, not a file");
  EXPECT_EQ(said({"session", pack, "--path", path, "--key-file", here}), here + ": is a folder, not a file");
  EXPECT_EQ(said({"build", path, nowhere, "-o", fresh}),
            nowhere + ": cannot be opened: No such file or directory");
  EXPECT_EQ(said({"info", pack, "--json", nowhere}),
            nowhere + ": cannot be written: No such file or directory");
  EXPECT_EQ(said({"info", pack, "--json", ""}), "--json: is given an empty name");
  EXPECT_EQ(said({"replay", pack, "--frame", "1", "-o", fresh}), pack + ": is a file, not a folder");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"build", path, "-o", nowhere},
           {"measure", "build", path, "--keep-pack", nowhere},
           {"render", pack, "--path", path, "-o", fresh, "--timeline", nowhere},
           {"render", pack, "--path", path, "-o", pack + "/below"},
           {"session", pack, "--path", path, "--record", pack + "/below"},
           {"sample", "building", "-o", pack + "/below"},
           {"replay", here, "--frame", "1", "-o", nowhere},
           {"report", path, "-o", pack + "/below"}})
    EXPECT_NE(said(words), "") << words[0] << " " << words.back();
  EXPECT_EQ(said({"sample", "plant", "-o", nowhere, "--json", nowhere + "/sample.json"}), "")
      << "the folder will be there";
  EXPECT_EQ(said({"sample", "plant", "-o", nowhere, "--json", folder.file("none/sample.json")}), "");
  EXPECT_NE(said({"sample", "plant", "-o", nowhere, "--json", nowhere + "/below/sample.json"}), "");
  EXPECT_EQ(folder.files(), 2u) << "asking leaves nothing behind";
}

TEST_F(NamedFiles, links_lead_to_the_same_file) {
  std::filesystem::create_symlink(pack, folder.file("symbolic"));
  std::filesystem::create_hard_link(pack, folder.file("hard"));
  std::filesystem::create_directory_symlink(folder.file("."), folder.file("elsewhere"));
  for (const char* name : {"symbolic", "hard", "elsewhere/x.tpk"})
    EXPECT_NE(refusal({"info", pack, "--json", folder.file(name)}), "") << name;
  EXPECT_NE(refusal({"build", pack, "-o", fresh, "--json", folder.file("elsewhere/new")}), "");
}

TEST_F(NamedFiles, what_differs_may_run) {
  EXPECT_EQ(refusal({"build", pack, pack, "-o", fresh, "--json", folder.file("other")}), "");
  EXPECT_EQ(refusal({"session", pack, "--path", path, "-o", fresh, "--record", fresh}), "")
      << "pictures and recordings have names of their own";
  EXPECT_EQ(refusal({"info", folder.file("none.tpk"), "--json", fresh}), "");
}

TEST_F(NamedFiles, nothing_is_written_by_a_command_that_is_refused) {
  EXPECT_NE(failure({"info", pack, "--json", pack}).find("--json would be written over"), std::string::npos);
  EXPECT_EQ(text_of(pack), "something");
  EXPECT_EQ(folder.files(), 2u);
}

TEST_F(NamedFiles, a_line_break_in_a_name_does_not_break_the_line) {
  Program program({"info", folder.file("a\nb\x1b[2J.tpk")});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_EQ(program.errors(),
            "triptych: " + folder.file("a b [2J.tpk") + ": cannot be opened: No such file or directory\n");
}

TEST_F(NamedFiles, a_role_is_given_a_pack_that_looks_like_a_flag) {
  SessionOptions options;
  options.run.pack = "-x.tpk";
  const Listener listener({"127.0.0.1", 0});
  SessionSetup setup;
  setup.render_listener = setup.switch_listener = &listener;
  EXPECT_EQ(switch_arguments(options, setup, Role::switch_0).at(2), "./-x.tpk");
  EXPECT_EQ(render_arguments(options, setup).at(2), "./-x.tpk");
}

void collect(const CLI::App& app, std::set<std::string>& read, std::set<std::string>& written,
             std::set<std::string>& others) {
  for (const CLI::Option* option : app.get_options())
    (!names_files(*option) ? others : is_written(*option) ? written : read).insert(option->get_name());
  for (const CLI::App* command : app.get_subcommands({})) collect(*command, read, written, others);
}

TEST_F(NamedFiles, of_every_command_are_known_as_read_or_written) {
  CLI::App app;
  Action action;
  add_all(app, action);
  std::set<std::string> read, written, others;
  collect(app, read, written, others);
  using Names = std::set<std::string>;
  EXPECT_EQ(read, (Names{"--bcf", "--hosts", "--key-file", "--model", "--pack", "--path", "--with", "after",
                         "before", "folder", "input", "manifest", "pack"}));
  EXPECT_EQ(written, (Names{"--cache", "--journal", "--json", "--keep-pack", "--output", "--place-file",
                            "--record", "--timeline"}));
  for (const std::string& name : read) EXPECT_EQ(others.count(name), 0u) << name << " is of two kinds";
}

}  // namespace
}  // namespace triptych::test
