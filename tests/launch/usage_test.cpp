// What is said about command lines that are wrong, and what triptych.toml adds to those that are right.
#include "launch/usage.hpp"

#include "base/near_words.hpp"
#include "launch/command.hpp"
#include "launch/defaults.hpp"
#include "launch/describe/described_command.hpp"
#include "tests/launch/model_files.hpp"

namespace triptych::test {
namespace {

/// What the program prints to standard output for a line of sh; $T is the program.
std::string printed(const std::string& line) {
  const Variable program("T", TRIPTYCH_PROGRAM);
  std::string text;
  FILE* const pipe = ::popen(line.c_str(), "r");
  char part[4096];
  for (size_t count; (count = std::fread(part, 1, sizeof(part), pipe)) > 0;) text.append(part, count);
  ::pclose(pipe);
  return text;
}

using Usage = ModelFiles;

std::string usage_error(const std::vector<std::string>& words) {
  Program program(words);
  EXPECT_EQ(program.wait(), 2) << program.errors();
  const std::string errors = program.errors();
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  return errors;
}

TEST_F(Usage, a_flag_that_is_not_known_is_named_before_one_that_is_missing) {
  const std::string said = usage_error({"render", "a.tpk", "--pixle-error", "2"});
  EXPECT_EQ(said,
            "triptych render: there is no flag --pixle-error; did you mean --pixel-error?; triptych render "
            "--help lists them\n");
  EXPECT_EQ(usage_error({"render", "--hlep"}),
            "triptych render: there is no flag --hlep; did you mean --help?\n");
  EXPECT_NE(usage_error({"build", "-q"}).find("there is no flag -q;"), std::string::npos);
  EXPECT_NE(usage_error({"rendre"}).find("there is no subcommand \"rendre\"; did you mean render?"),
            std::string::npos);
  EXPECT_NE(usage_error({"measure", "acuracy"}).find("did you mean accuracy?"), std::string::npos);
  // Values are no flags, whatever they look like.
  EXPECT_EQ(usage_error({"info", "a.tpk", "--build", "--keep none"}).find("there is no flag"),
            std::string::npos);
}

TEST_F(Usage, is_told_in_our_words) {
  EXPECT_NE(usage_error({"render", "a.tpk", "--size"}).find("--size needs a value, WxH"), std::string::npos);
  EXPECT_NE(usage_error({"render", "a.tpk", "--cull", "frustrum"})
                .find("--cull: \"frustrum\" is none of approximate, frustum, none, occlusion, portals; did "
                      "you mean frustum?"),
            std::string::npos);
  EXPECT_NE(
      usage_error({"render", "a.tpk", "--path", "p", "-o", "o", "--cull", "portals", "--target-ms", "5"})
          .find("--target-ms: raises the pixel error, with which portals widen"),
      std::string::npos);
  EXPECT_NE(usage_error({"session", "a.tpk", "--path", "p", "--cull", "approximate"})
                .find("\"approximate\" is none of frustum, none, occlusion, portals"),
            std::string::npos);
  EXPECT_NE(usage_error({"report", "a.json", "b.json", "-o", "x"}).find("there is no use for: b.json"),
            std::string::npos);
  EXPECT_NE(usage_error({"explain", "a.tpk", "--path", "p", "--frame", "0", "--pixel", "512,3"})
                .find("--pixel: 512,3 lies outside of a picture of 512x512"),
            std::string::npos);
}

TEST(NearWords, are_those_that_a_slip_of_the_hand_makes) {
  const std::vector<std::string> known = {"--size", "--samples", "--pixel-error"};
  EXPECT_EQ(nearest_word("--sieze", known), "--size");
  EXPECT_EQ(nearest_word("--zise", known), "--size");
  EXPECT_EQ(nearest_word("--pixel", known), "--pixel-error");
  EXPECT_EQ(nearest_word("--quality", known), "");
}

TEST_F(Usage, the_version_is_told_with_what_draws) {
  const std::string text = printed("\"$T\" --version");
  EXPECT_EQ(text.rfind("triptych 0.", 0), 0u) << text;
  for (const char* part : {"\nbuilt: ", "flags \"", "\ndevice: ", "\nOpenGL of EGL: "})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

TEST_F(Usage, json_goes_to_standard_output_alone) {
  const auto json = nlohmann::json::parse(printed("\"$T\" info '" + model + "' --json - 2>/dev/null"));
  EXPECT_EQ(json["source_triangles"], 12);
  EXPECT_NE(printed("\"$T\" info '" + model + "' --json - 2>&1 >/dev/null").find("source_triangles"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST_F(Usage, a_file_of_defaults_counts_where_the_command_line_says_nothing) {
  const std::string file = folder.file("triptych.toml"), json = folder.file("render.json");
  const Variable config("TRIPTYCH_CONFIG", file);
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"render",         model,    "--path", path, "-o",
                                      folder.file("p"), "--json", json};
    words.insert(words.end(), more.begin(), more.end());
    run(words);
    return json_of(json);
  };
  std::ofstream(file) << "device = 'cpu'\nsamples = 1\n[render]\nsamples = 4\nedges = true\nframes = 1\n"
                         "[measure.session]\nsize = '64x64'\n";
  EXPECT_EQ(render({})["samples"], 4);
  EXPECT_EQ(render({})["edges"], true);
  EXPECT_EQ(render({})["frames"], 1);
  EXPECT_EQ(render({"--samples", "1", "--frames", "2"})["samples"], 1);
  EXPECT_EQ(render({"--samples", "1", "--frames", "2"})["frames"], 2);
}

TEST_F(Usage, a_file_of_defaults_that_is_wrong_is_named_with_line_and_key) {
  const std::string file = folder.file("triptych.toml");
  const Variable config("TRIPTYCH_CONFIG", file);
  for (const auto& [text, said] :
       {std::pair<std::string, std::string>{"\nsise = '1x1'\n",
                                            ": line 2: sise: is no flag of any command; did you mean size?"},
        {"[rendr]\n", ": line 1: [rendr]: is no command; did you mean render?"},
        {"[render]\nwindow = true\n", ": line 2: window: is no flag of triptych render"},
        {"[render]\nsize = 'small'\n", ": line 2: size: --size: \"small\" is no WxH"},
        {"[render]\nedges = 3\n", ": line 2: edges: is true or false"},
        {"[role]\ndevice = 'cpu'\n", ": line 1: [role]: gets its flags from its session alone"},
        {"size = \n", ": line 1, column 8: is no TOML: a value is expected"},
        {"device = cpu\n",
         ": line 1, column 10: is no TOML: a value is expected; text stands in quotes, as in device = "
         "\"cpu\""}}) {
    std::ofstream(file) << text;
    const std::string error = usage_error({"render", model, "--path", path, "-o", folder.file("p")});
    EXPECT_EQ(error.rfind("triptych: " + file + said, 0), 0u) << error;
  }
}

TEST_F(Usage, files_of_defaults_are_the_working_folder_s_and_the_user_s_own) {
  const Variable none("TRIPTYCH_CONFIG", "");
  EXPECT_TRUE(default_files().empty());
  ::unsetenv("TRIPTYCH_CONFIG");
  const Variable own("XDG_CONFIG_HOME", folder.file("config"));
  std::filesystem::create_directories(folder.file("config/triptych"));
  std::ofstream(folder.file("config/triptych/triptych.toml")) << "frames = 1\nsamples = 4\n";
  std::ofstream(folder.file("triptych.toml")) << "samples = 8\n";
  const auto json = nlohmann::json::parse(
      printed("cd '" + folder.file(".") +
              "' && \"$T\" render box.obj --path path.json -o p --device cpu --json - 2>/dev/null"));
  EXPECT_EQ(json["frames"], 1);
  EXPECT_EQ(json["samples"], 8);
}

TEST_F(Usage, man_page_and_completions_tell_every_flag_of_every_command) {
  CLI::App app{"the program"};
  Action action;
  for (const auto add : {add_build, add_render, add_measure}) add(app, action);
  const auto commands = described_commands(app);
  const std::string man = man_page(commands, "1.0"), bash = bash_completion(commands),
                    zsh = zsh_completion(commands), fish = fish_completion(commands);
  size_t flags = 0;
  for (const DescribedCommand& command : commands) {
    for (const DescribedFlag& flag : command.flags) {
      if (flag.positional) continue;
      const std::string& name = flag.names.back();
      ++flags;
      EXPECT_NE(bash.find(name), std::string::npos) << name;
      EXPECT_NE(zsh.find(name + "["), std::string::npos) << name;
      EXPECT_NE(fish.find("-l " + name.substr(2)), std::string::npos) << name;
    }
  }
  EXPECT_GT(flags, 50u);
  EXPECT_NE(man.find(".SS \"triptych measure session\""), std::string::npos);
  EXPECT_NE(man.find("\\fB\\-\\-pixel\\-error\\fR"), std::string::npos);
  const std::string script = folder.file("complete");
  std::ofstream(script) << bash;
  const std::string complete = "bash -c '. " + script +
                               "; COMP_WORDS=(triptych %); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); "
                               "_triptych; echo \"${COMPREPLY[*]}\"'";
  const auto completed = [&](const std::string& words) {
    return printed(std::string(complete).replace(complete.find('%'), 1, words));
  };
  EXPECT_EQ(completed("rend"), "render\n");
  EXPECT_EQ(completed("measure sess"), "session\n");
  EXPECT_EQ(completed("render --pixel"), "--pixel-error\n");
  EXPECT_EQ(completed("render --device g"), "gl\n");
}

}  // namespace
}  // namespace triptych::test
