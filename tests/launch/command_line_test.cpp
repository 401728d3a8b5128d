// What every command line has in common: the words of its flags, and which numbers are none.
#include "launch/command.hpp"
#include "raster/instruction_set.hpp"

#include <cstdlib>
#include <gtest/gtest.h>

namespace triptych {
namespace {

TEST(CommandLine, help_lists_the_words_of_a_flag_and_nothing_of_how_they_are_stored) {
  CLI::App app;
  Action action;
  for (const auto add : {add_build, add_render, add_session, add_replay, add_role, add_selftest, add_measure})
    add(app, action);
  const std::string help = app.help("", CLI::AppFormatMode::All);
  EXPECT_NE(help.find("--context egl|osmesa=egl"), std::string::npos);
  EXPECT_NE(help.find("--test queries|storage=storage"), std::string::npos);
  EXPECT_NE(help.find("--cull approximate|frustum|none|occlusion|portals=occlusion"), std::string::npos);
  EXPECT_NE(help.find("--up y|z=y"), std::string::npos);
  EXPECT_EQ(help.find('{'), std::string::npos);
  EXPECT_EQ(help.find("->"), std::string::npos);
}

TEST(CommandLine, is_told_as_a_shell_takes_it_with_every_flag_that_was_given) {
  CLI::App app;
  Action action;
  add_measure(app, action);
  app.parse("triptych measure accuracy 'my pack.tpk' --path w.json --pixel-error 1,2 -o \"it's\" --shifts 2",
            true);
  const CLI::App* accuracy = app.get_subcommands().front()->get_subcommands().front();
  const std::string line = command_line(*accuracy);
  EXPECT_EQ(line.find("triptych measure accuracy "), 0u) << line;
  for (const char* words :
       {" 'my pack.tpk'", " --path w.json", " --pixel-error 1,2", " --output 'it'\\''s'", " --shifts 2"})
    EXPECT_NE(line.find(words), std::string::npos) << words << " in " << line;
  EXPECT_EQ(line.find("--points"), std::string::npos) << line;
}

TEST(CommandLine, a_threshold_in_pixels_is_of_the_approximate_strategy_alone) {
  for (const auto& [add, line] : {std::pair(&add_render, std::string("render p --path w -o o")),
                                  std::pair(&add_view, std::string("view p"))}) {
    const auto parse = [add = add, line = line](const std::string& flags) {
      CLI::App app;
      Action action;
      add(app, action);
      app.parse(line + flags, false);
    };
    EXPECT_NO_THROW(parse(" --cull approximate"));
    for (const char* pixels : {"1", "4", "1000000"})
      EXPECT_NO_THROW(parse(std::string(" --cull approximate --min-pixels ") + pixels));
    for (const char* pixels : {"0", "-1", "1000001", "4.5", "all"})
      EXPECT_THROW(parse(std::string(" --cull approximate --min-pixels ") + pixels), CLI::ValidationError);
    for (const char* other : {"", " --cull occlusion", " --cull frustum", " --cull none"})
      EXPECT_THROW(parse(other + std::string(" --min-pixels 4")), CLI::ValidationError);
  }
}

TEST(CommandLine, samples_are_1_4_8_or_16) {
  for (const auto& [add, line] : {std::pair(&add_render, std::string("render p --path w -o o")),
                                  std::pair(&add_view, std::string("view p")),
                                  std::pair(&add_session, std::string("session p --path w"))}) {
    const auto parse = [add = add, line = line](const std::string& flags) {
      CLI::App app;
      Action action;
      add(app, action);
      app.parse(line + flags, false);
    };
    for (const char* samples : {"1", "4", "8", "16"})
      EXPECT_NO_THROW(parse(std::string(" --edges --samples ") + samples));
    for (const char* samples : {"0", "2", "-4", "32", "4.0", "08", "all"})
      EXPECT_THROW(parse(std::string(" --samples ") + samples), CLI::ValidationError) << samples;
  }
}

TEST(CommandLine, numbers_are_not_taken_for_words) {
  CLI::App app;
  Action action;
  add_selftest(app, action);
  EXPECT_THROW(app.parse("selftest --context 1", false), CLI::ValidationError);
  EXPECT_NO_THROW(app.parse("selftest --context osmesa", false));
}

/// What the line says of the device, with the environment's TRIPTYCH_DEVICE.
DeviceKind device_of(const std::string& line, const char* environment) {
  const char* const before = std::getenv("TRIPTYCH_DEVICE");
  const std::string kept = before ? before : "";
  environment ? ::setenv("TRIPTYCH_DEVICE", environment, 1) : ::unsetenv("TRIPTYCH_DEVICE");
  CLI::App app;
  DeviceOptions device{.kind = DeviceKind::automatic};
  add_device_flags(*app.add_subcommand("draw"), device);
  app.add_subcommand("other");
  const auto restore = [&] {
    before ? ::setenv("TRIPTYCH_DEVICE", kept.c_str(), 1) : ::unsetenv("TRIPTYCH_DEVICE");
  };
  try {
    app.parse(line, false);
  } catch (...) {
    restore();
    throw;
  }
  restore();
  return device.kind;
}

TEST(CommandLine, the_environment_names_the_device_where_no_flag_does) {
  EXPECT_EQ(device_of("draw", nullptr), DeviceKind::automatic);
  EXPECT_EQ(device_of("draw", ""), DeviceKind::automatic);
  EXPECT_EQ(device_of("draw", "cpu"), DeviceKind::cpu);
  EXPECT_EQ(device_of("draw --device auto", "cpu"), DeviceKind::automatic);
  EXPECT_EQ(device_of("draw --context osmesa", "cpu"), DeviceKind::gl);
  EXPECT_EQ(device_of("draw --device gl --context osmesa", nullptr), DeviceKind::gl);
  EXPECT_EQ(device_of("other", "gpu"), DeviceKind::automatic);
  EXPECT_EQ(device_of("draw --device cpu", "gpu"), DeviceKind::cpu);
  try {
    device_of("draw", "gpu");
    ADD_FAILURE();
  } catch (const CLI::ValidationError& error) {
    EXPECT_EQ(std::string(error.what()), "TRIPTYCH_DEVICE: \"gpu\" is no device: auto, cpu or gl");
  }
}

TEST(CommandLine, vector_instructions_are_those_that_the_flag_names) {
  for (const InstructionSet set : instruction_sets_here()) {
    device_of("draw --simd " + instruction_set_name(set), nullptr);
    EXPECT_EQ(forced_instruction_set(), set);
    EXPECT_EQ(instruction_set(), set);
  }
  force_instruction_set(std::nullopt);
  EXPECT_EQ(instruction_set(), instruction_sets_here().back());
  EXPECT_THROW(device_of("draw --device gl --simd scalar", nullptr), CLI::ValidationError);
  force_instruction_set(std::nullopt);
  try {
    device_of("draw --simd mmx", nullptr);
    FAIL() << "no processor of today has them alone";
  } catch (const CLI::ValidationError& error) {
    EXPECT_NE(std::string(error.what()).find("has no \"mmx\", but scalar"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(forced_instruction_set(), std::nullopt);
}

TEST(CommandLine, a_context_that_the_device_does_not_use_is_refused) {
  EXPECT_THROW(device_of("draw --device cpu --context egl", nullptr), CLI::ValidationError);
}

TEST(CommandLine, times_and_rates_are_numbers_that_a_clock_can_count) {
  for (const std::string flag : {"--timeout", "--rate"}) {
    for (const std::string value : {"nan", "inf", "0", "-1", "1e300", "1e-300", "1s"}) {
      CLI::App app;
      Action action;
      add_session(app, action);
      EXPECT_THROW(app.parse("session pack.tpk --path walk.json " + flag + " " + value, false),
                   CLI::ValidationError)
          << flag << " " << value;
    }
  }
}

TEST(CommandLine, counts_are_whole_numbers_in_decimal_digits) {
  for (const std::string flag : {"--frames", "--loop", "--batch", "--restarts", "--port"}) {
    for (const std::string value :
         {"-1", "99999999999999999999999", "010", "1.5", "1e3", "0x10", "nan", "many"}) {
      CLI::App app;
      Action action;
      add_session(app, action);
      try {
        app.parse("session pack.tpk --path walk.json " + flag + " " + value, false);
        ADD_FAILURE() << flag << " " << value;
      } catch (const CLI::ValidationError& error) {
        EXPECT_NE(std::string(error.what()).find("is not a whole number from"), std::string::npos);
        EXPECT_LT(std::string(error.what()).size(), 100u);
      }
    }
  }
}

TEST(CommandLine, numbers_that_programs_give_each_other_are_checked_like_those_of_persons) {
  const std::string role = "role switch a.tpk --render a:1 --switch-0 a:2 --index ",
                    node = "role render a.tpk --path walk.json --listen ",
                    pixel = "explain a.tpk --path walk.json --frame 0 --pixel ";
  const auto refused = [](const std::string& line) {
    CLI::App app;
    Action action;
    for (const auto add : {add_role, add_explain}) add(app, action);
    try {
      app.parse(line, false);
    } catch (const CLI::ParseError&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused(role + "1 --session 18446744073709551615"));
  EXPECT_FALSE(refused(node + "a:1 --begin 10"));
  EXPECT_FALSE(refused(pixel + "10,20"));
  for (const std::string& line :
       {role + "01", role + "2", role + "1 --session -1", role + "1 --session 18446744073709551616",
        node + "a:1 --begin 010", pixel + "0x1,1", pixel + "-1,1"})
    EXPECT_TRUE(refused(line)) << line;
}

TEST(CommandLine, bytes_are_whole_numbers_with_a_suffix_that_do_not_overflow) {
  const auto refused = [](const std::string& value) {
    CLI::App app;
    Action action;
    add_build(app, action);
    try {
      app.parse(std::vector<std::string>{value, "--memory", "x.tpk", "-o", "x.obj", "build"});
    } catch (const CLI::ValidationError& error) {
      EXPECT_NE(std::string(error.what()).find("is not a number of bytes from 128M on"), std::string::npos);
      return true;
    }
    return false;
  };
  for (const char* value : {"128M", "134217728", "1g", "0500M", "16T"}) EXPECT_FALSE(refused(value)) << value;
  for (const char* value : {"", "-1", "-1G", "nan", "1.5G", "0x80000000", "127M", "1GG", "G", "1 G", "1X",
                            "18446744073709551616", "16777216T", "99999999999999999999G"})
    EXPECT_TRUE(refused(value)) << value;
}

TEST(CommandLine, flags_may_stand_before_what_they_are_about) {
  for (const std::string line : {"render --pixel-error 2 pack.tpk --path walk.json -o pictures",
                                 "session --batch 7 pack.tpk --path walk.json",
                                 "measure session --batch 7,8 pack.tpk --path walk.json",
                                 "measure simplifiers --pixel-error 1,2 scene.gltf --path walk.json"}) {
    CLI::App app;
    Action action;
    for (const auto add : {add_render, add_session, add_measure}) add(app, action);
    EXPECT_NO_THROW(app.parse(line, false)) << line;
  }
}

TEST(CommandLine, of_sizes_and_counts_of_frames_the_last_one_counts) {
  CLI::App app;
  RunOptions options;
  add_run_flags(app, options);
  app.parse("pack.tpk --path walk.json --size 512x512 --frames 60 --size 64x48 --frames 90", false);
  EXPECT_EQ(options.size.width, 64);
  EXPECT_EQ(options.size.height, 48);
  EXPECT_EQ(options.frames, 90u);
}

TEST(CommandLine, a_list_is_refused_where_one_value_is_used) {
  for (const std::string line :
       {"render pack.tpk --path walk.json -o pictures --pixel-error 1,2",
        "render pack.tpk --path walk.json -o pictures --pixel-error 1 --pixel-error 2",
        "session pack.tpk --path walk.json --batch 1,2",
        "measure session pack.tpk --path walk.json --pixel-error 1,2"}) {
    CLI::App app;
    Action action;
    for (const auto add : {add_render, add_session, add_measure}) add(app, action);
    EXPECT_THROW(app.parse(line, false), CLI::ParseError) << line;
  }
}

}  // namespace
}  // namespace triptych
