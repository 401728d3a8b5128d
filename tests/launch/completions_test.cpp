// What the shells complete, asked of the shells themselves.
#include "tests/session/program.hpp"

#include <array>
#include <cstdlib>
#include <fstream>

namespace triptych::test {
namespace {

class Completions : public testing::Test {
 protected:
  /// What a line of a shell prints.
  static std::string printed(const std::string& line) {
    FILE* const pipe = ::popen(line.c_str(), "r");
    std::string text;
    std::array<char, 4096> buffer{};
    for (size_t count; (count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      text.append(buffer.data(), count);
    ::pclose(pipe);
    return text;
  }
  static bool is_there(const std::string& shell) {
    return std::system(("command -v " + shell + " >/dev/null 2>&1").c_str()) == 0;
  }
  /// The script for a shell, as a file.
  std::string script(const std::string& shell, const std::string& name) const {
    const std::string file = folder.file(name);
    std::ofstream(file) << printed(std::string(TRIPTYCH_PROGRAM) + " describe " + shell);
    return file;
  }

  Folder folder;
};

TEST_F(Completions, of_fish_are_the_words_that_may_follow) {
  if (!is_there("fish")) GTEST_SKIP() << "fish is not installed: apt-get install fish runs this test";
  const std::string file = script("fish", "triptych.fish");
  const auto completed = [&](const std::string& typed) {
    std::istringstream in(printed("cd '" + folder.file(".") + "' && HOME=$PWD fish --no-config -c \"source " +
                                  file + "; complete -C '" + typed + "'\" 2>&1"));
    std::string words;
    for (std::string line; std::getline(in, line);) words += line.substr(0, line.find('\t')) + " ";
    return words;
  };
  EXPECT_EQ(completed("triptych rend"), "render ");
  EXPECT_EQ(completed("triptych measure sess"), "session ");
  EXPECT_EQ(completed("triptych render --pixel"), "--pixel-error ");
  EXPECT_EQ(completed("triptych render --device g"), "gl ");
  EXPECT_EQ(completed("triptych measure session --rate"), "--rate ");
  EXPECT_EQ(completed("triptych measure session spe"), "") << "one subcommand is enough";
  EXPECT_EQ(completed("triptych build --keep touching,pl"), "touching,planes ");
  EXPECT_EQ(completed("triptych render --effects vertex-colours,tr"), "vertex-colours,transparency ");
}

TEST_F(Completions, of_bash_are_the_words_that_may_follow) {
  const std::string file = script("bash", "triptych.bash");
  const auto completed = [&](const std::string& typed) {
    return printed("bash -c 'source " + file + "; COMP_WORDS=(" + typed +
                   "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _triptych; echo ${COMPREPLY[*]}'");
  };
  EXPECT_EQ(completed("triptych rend"), "render\n");
  EXPECT_EQ(completed("triptych measure sess"), "session\n");
  EXPECT_EQ(completed("triptych render --device g"), "gl\n");
  EXPECT_EQ(completed("triptych build --keep touching,pl"), "touching,planes\n");
  EXPECT_EQ(completed("triptych build --keep touching,planes,"),
            "touching,planes,cover touching,planes,order touching,planes,shade touching,planes,none\n");
  EXPECT_EQ(completed("triptych render --effects vertex-colours,tr"), "vertex-colours,transparency\n");
}

TEST_F(Completions, of_zsh_are_the_words_that_may_follow) {
  if (!is_there("zsh")) GTEST_SKIP() << "zsh is not installed: apt-get install zsh runs this test";
  script("zsh", "_triptych");
  // A shell in a terminal of its own; it is waited for until it has completed the word. Its name is not that
  // of a program: nothing is run.
  std::ofstream(folder.file("ask")) << R"(zmodload zsh/zpty
zpty -b shell "zsh -f -i"
zpty -w shell "PS1=; fpath=('$1' \$fpath); autoload -Uz compinit; compinit -u -d '$1/dump'; bindkey '^I' complete-word; print RE\\ADY"
zpty -r -m shell said '*READY*'
zpty -w -n shell "$2"$'\t'
zpty -r -m shell said "*$3*" && print -r -- found
zpty -d shell
)";
  const auto completes = [&](const std::string& typed, const std::string& whole) {
    return printed("timeout 60 zsh -f '" + folder.file("ask") + "' '" + folder.file(".") + "' '" + typed +
                   "' '" + whole + "'") == "found\n";
  };
  EXPECT_TRUE(completes("triptych rend", "triptych render"));
  EXPECT_TRUE(completes("triptych measure sess", "triptych measure session"));
  EXPECT_TRUE(completes("triptych render --pixel", "triptych render --pixel-error"));
  EXPECT_TRUE(completes("triptych render --device g", "triptych render --device gl"));
  EXPECT_TRUE(completes("triptych build --keep touching,pl", "triptych build --keep touching,planes"));
  EXPECT_TRUE(completes("triptych render --effects vertex-colours,tr",
                        "triptych render --effects vertex-colours,transparency"));
}

}  // namespace
}  // namespace triptych::test
