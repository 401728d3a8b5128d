// Nothing of one run is mixed with what another left, or written over what is not its own.
#include "launch/output_folder.hpp"

#include "base/error.hpp"
#include "tests/launch/model_files.hpp"

namespace triptych::test {
namespace {

using OutputFolders = ModelFiles;

void fill(const std::string& where) {
  for (const char* name : {"/000000.png", "/000007.png", "/mine.png", "/render.recording"})
    std::ofstream(where + name) << "old";
}

TEST_F(OutputFolders, what_another_run_left_is_moved_aside_and_what_is_no_run_s_stays) {
  const std::string where = folder.file("pictures");
  std::filesystem::create_directories(where);
  fill(where);
  { const OutputFolder claimed(where, "a run"); }
  EXPECT_FALSE(std::filesystem::exists(where + "/000007.png"));
  EXPECT_EQ(text_of(where + "/earlier-1/000007.png"), "old");
  EXPECT_EQ(text_of(where + "/mine.png"), "old");
  EXPECT_EQ(text_of(where + "/render.recording"), "old");
  fill(where);
  { const OutputFolder claimed(where, "another run"); }
  EXPECT_EQ(text_of(where + "/earlier-2/000000.png"), "old");
}

TEST_F(OutputFolders, the_same_command_makes_its_files_anew) {
  const std::string where = folder.file("pictures");
  { const OutputFolder claimed(where, "a run"), other(folder.file("x"), ""); }
  EXPECT_FALSE(std::filesystem::exists(where)) << "nothing was put into it";
  std::filesystem::create_directories(where);
  {
    OutputFolder claimed(where, "a run");
    fill(where);
    claimed.finish();
  }
  { const OutputFolder came_to_nothing(where, "a run"); }
  EXPECT_EQ(text_of(where + "/000007.png"), "old");
  {
    const OutputFolder failed(where, "a run");
    std::ofstream(where + "/000001.png") << "new";
  }
  EXPECT_EQ(text_of(where + "/000007.png"), "old") << "a run that failed loses nothing";
  {
    OutputFolder claimed(where, "a run");
    std::ofstream(where + "/000001.png") << "newer";
    claimed.finish();
  }
  EXPECT_EQ(text_of(where + "/000001.png"), "newer");
  EXPECT_FALSE(std::filesystem::exists(where + "/000007.png"));
  EXPECT_FALSE(std::filesystem::exists(where + "/earlier-1"));
  EXPECT_EQ(text_of(where + "/mine.png"), "old");
}

TEST_F(OutputFolders, what_a_person_put_there_is_moved_aside_even_from_the_same_command) {
  const std::string where = folder.file("pictures");
  {
    OutputFolder claimed(where, "a run");
    std::ofstream(where + "/000000.png") << "made";
    claimed.finish();
  }
  std::ofstream(where + "/000123.png") << "mine";
  std::ofstream(where + "/000000.png") << "painted over";
  {
    OutputFolder claimed(where, "a run");
    std::ofstream(where + "/000000.png") << "made again";
    claimed.finish();
  }
  EXPECT_EQ(text_of(where + "/000000.png"), "made again");
  EXPECT_EQ(text_of(where + "/earlier-1/000123.png"), "mine");
  EXPECT_EQ(text_of(where + "/earlier-1/000000.png"), "painted over");
}

TEST_F(OutputFolders, the_mark_of_a_run_is_written_over_nothing_else) {
  const std::string where = folder.file("pictures"), precious = folder.file("precious");
  std::filesystem::create_directories(where);
  std::ofstream(precious) << "mine";
  std::filesystem::create_symlink(precious, where + "/.triptych-run");
  EXPECT_THROW(OutputFolder(where, "a run"), Error);
  std::filesystem::remove(where + "/.triptych-run");
  std::ofstream(where + "/.triptych-run") << "mine";
  EXPECT_THROW(OutputFolder(where, "a run"), Error);
  EXPECT_EQ(text_of(precious), "mine");
  EXPECT_EQ(text_of(where + "/.triptych-run"), "mine");
}

TEST_F(OutputFolders, two_runs_at_once_are_refused) {
  const OutputFolder first(folder.file("pictures"), "a run");
  try {
    const OutputFolder second(folder.file("pictures"), "a run");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("pictures: another run writes into it (a run)"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(OutputFolders, pictures_of_two_renders_do_not_mix) {
  const auto render = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", model,      "--path", path, "--size",
                                      "64x64",  "--device", "cpu",    "-o", folder.file("p")};
    words.insert(words.end(), more.begin(), more.end());
    Program program(words);
    EXPECT_EQ(program.wait(), 0) << program.errors();
    return program.errors();
  };
  render({});
  const std::string both = picture("p");
  EXPECT_EQ(render({"--json", folder.file("j")}).find("not of this command"), std::string::npos);
  EXPECT_NE(render({"--frames", "1"}).find("2 pictures that are not of this command are now in "),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.file("p/000001.png")));
  EXPECT_EQ(picture("p/earlier-1"), both);
}

TEST_F(OutputFolders, a_sample_overwrites_samples_and_nothing_else) {
  const std::string where = folder.file("scene");
  const std::vector<std::string> sample = {"sample", "statue", "-o", where, "--triangles", "1000"};
  run(sample);
  run(sample);
  std::ofstream(where + "/scene.ply") << "ply\nof the user's own";
  const std::string said = failure(sample);
  EXPECT_NE(said.find("was not made by `triptych sample`: take another folder, or --force"),
            std::string::npos)
      << said;
  EXPECT_EQ(text_of(where + "/scene.ply"), "ply\nof the user's own");
  run({"sample", "statue", "-o", where, "--triangles", "1000", "--force"});
  EXPECT_GT(text_of(where + "/scene.ply").size(), 1000u);
}

TEST_F(OutputFolders, a_role_that_is_started_by_hand_claims_its_folder_as_others_do) {
  run({"build", model, "-o", folder.file("box.tpk")});
  const std::string port = "127.0.0.1:" + std::to_string(12000 + 2 * (::getpid() % 8000));
  const auto role = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"role",          "render",   folder.file("box.tpk"),
                                      "--path",        path,       "--size",
                                      "64x64",         "--device", "cpu",
                                      "--listen",      port,       "-o",
                                      folder.file("p")};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  run(role({}));
  const std::string picture_before = picture("p");
  Program other(role({"--pixel-error", "9"}));
  EXPECT_EQ(other.wait(), 0) << other.errors();
  EXPECT_NE(other.errors().find("2 pictures that are not of this command are now in "), std::string::npos)
      << other.errors();
  EXPECT_EQ(picture("p/earlier-1"), picture_before);
  Program successor(role({"--pixel-error", "9", "--begin", "1"}));
  EXPECT_EQ(successor.wait(), 0) << successor.errors();
  EXPECT_TRUE(std::filesystem::exists(folder.file("p/000000.png"))) << "what was drawn before --begin stays";
  const OutputFolder held(folder.file("p"), "a run");
  EXPECT_NE(failure(role({})).find("another run writes into it (a run)"), std::string::npos);
}

TEST_F(OutputFolders, what_a_killed_run_left_half_written_the_next_one_removes) {
  std::filesystem::create_directories(folder.file("p"));
  std::ofstream(folder.file("p/000001.png.partial-12")) << "half";
  draws_after_a_build({model}, "p");
  EXPECT_FALSE(std::filesystem::exists(folder.file("p/000001.png.partial-12")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("p/000001.png")));
}

TEST_F(OutputFolders, of_a_session_without_egl_it_is_said_once) {
  const Variable device("TRIPTYCH_DEVICE", "");
  const Variable drivers("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json");
  const auto lines_with_egl = [](const std::string& errors) {
    std::istringstream in(errors);
    int count = 0;
    for (std::string line; std::getline(in, line);) count += line.find("EGL") != std::string::npos;
    return count;
  };
  std::vector<std::string> words = {"session", model, "--path", path, "--size", "64x64"};
  Program automatic(words);
  EXPECT_EQ(automatic.wait(), 0) << automatic.errors();
  EXPECT_EQ(lines_with_egl(automatic.errors()), 1) << automatic.errors();
  words.insert(words.end(), {"--device", "gl"});
  Program gl(words);
  EXPECT_EQ(gl.wait(), 1) << gl.errors();
  EXPECT_EQ(lines_with_egl(gl.errors()), 1) << gl.errors();
}

TEST_F(OutputFolders, without_egl_the_program_draws_by_itself_and_says_so) {
  const Variable device("TRIPTYCH_DEVICE", "");
  const Variable drivers("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json");
  const std::vector<std::string> render = {"render", model,   "--path", path,
                                           "--size", "64x64", "-o",     folder.file("p")};
  std::vector<std::string> gl = render;
  gl.insert(gl.end(), {"--device", "gl"});
  const std::string said = failure(gl);
  EXPECT_NE(said.find("--device cpu draws without it, --context osmesa with Mesa's own library"),
            std::string::npos)
      << said;
  Program automatic(render);
  EXPECT_EQ(automatic.wait(), 0);
  EXPECT_NE(automatic.errors().find("drawing without it, as --device cpu does"), std::string::npos)
      << automatic.errors();
}

}  // namespace
}  // namespace triptych::test
