#include "launch/command.hpp"

#include "base/error.hpp"
#include "base/inject.hpp"
#include "base/threads.hpp"
#include "launch/choice_flag.hpp"
#include "launch/number_flags.hpp"
#include "launch/section_flags.hpp"
#include "raster/instruction_set.hpp"
#include "scene/sun.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>

namespace triptych {

namespace {

PictureSize parse_size(const std::string& text, const std::string& flag) {
  PictureSize size{0, 0};
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool separated = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = separated ? std::from_chars(width.ptr + 1, end, size.height) : width;
  constexpr int limit = 16384;
  if (!separated || height.ec != std::errc() || height.ptr != end || size.width < 1 || size.height < 1 ||
      size.width > limit || size.height > limit) {
    throw CLI::ValidationError(flag, fmt::format("\"{}\" is no WxH with sides of 1 to {}", text, limit));
  }
  return size;
}

const std::map<std::string, DeviceKind>& device_kinds() {
  static const std::map<std::string, DeviceKind> kinds{
      {"auto", DeviceKind::automatic}, {"gl", DeviceKind::gl}, {"cpu", DeviceKind::cpu}};
  return kinds;
}

void force_simd(const std::string& word) {
  std::string here;
  for (const InstructionSet set : instruction_sets_here()) {
    const std::string& name = instruction_set_name(set);
    if (name == word) return force_instruction_set(set);
    here += (here.empty() ? "" : ", ") + name;
  }
  throw CLI::ValidationError("--simd", fmt::format("this processor has no \"{}\", but {}", word, here));
}

}  // namespace

namespace {

std::string line_without(const CLI::App& command, const std::vector<std::string>& left_out) {
  std::string line;
  for (const CLI::App* at = &command; at->get_parent() != nullptr; at = at->get_parent())
    line = " " + at->get_name() + line;
  line = "triptych" + line;
  const auto append = [&](const std::string& word) {
    const bool plain =
        word.find_first_of(" \t'\"\\$`&|;<>()*?[]#~!{}\n") == std::string::npos && !word.empty();
    line += " ";
    if (plain) {
      line += word;
      return;
    }
    line += "'";
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += "'";
  };
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    if (std::find(left_out.begin(), left_out.end(), option->get_name()) != left_out.end()) continue;
    const bool flag = option->get_expected_max() == 0;
    // A flag that is given once for each of its values.
    const bool repeated = !option->get_positional() && option->get_delimiter() == '\0' && option->count() > 1;
    if (repeated && !flag) {
      for (const std::string& word : option->results()) {
        append(option->get_name());
        append(word);
      }
      continue;
    }
    if (!option->get_positional()) append(option->get_name());
    if (!flag) append(CLI::detail::join(option->results(), ","));
  }
  return line;
}

}  // namespace

std::string command_line(const CLI::App& command) { return line_without(command, {}); }

std::string run_line(const CLI::App& command) {
  return line_without(command, {"--begin", "--json", "--threads", "--timeline"});
}

void add_common_flags(CLI::App& command, std::filesystem::path& json) {
  command
      .add_option("--json", json,
                  "Write what was found as one JSON object; - is standard output, and what is for people "
                  "then goes to "
                  "standard error")
      ->type_name("FILE");
  command
      .add_option_function<std::vector<std::string>>(
          "--inject",
          [](const std::vector<std::string>& names) {
            for (const std::string& name : names) inject(name);
          },
          "Put a fault in on purpose; shows that the checks can fail (any other word lists them)")
      ->check(one_of(fault_names()))
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      .add_option_function<unsigned>(
          "--threads", [](unsigned count) { set_thread_count(count); },
          "Threads to work with (default: all cores)")
      ->check(whole_number(1, 1024));
}

void add_device_flags(CLI::App& command, DeviceOptions& device) {
  add_choice_flag(command, "--device", device.kind, device_kinds(),
                  "What draws: OpenGL, or the program itself; auto is gl where there is a graphics card")
      ->default_str("auto");
  const std::map<std::string, ContextKind> names{{"egl", ContextKind::egl}, {"osmesa", ContextKind::osmesa}};
  add_choice_flag(command, "--context", device.context, names,
                  "Where OpenGL comes from; without --device it means --device gl")
      ->default_str("egl");
  command
      .add_option_function<std::string>("--simd", force_simd,
                                        "Vector instructions that the device cpu uses, instead of the widest "
                                        "that there are; pictures are the same")
      ->type_name("scalar|sse4.2|avx2|avx512");
  command.parse_complete_callback([&command, &device] {
    resolve_device(command, device);
    if (device.kind == DeviceKind::gl && command.count("--simd") > 0)
      throw CLI::ValidationError("--simd", "is of --device cpu: OpenGL chooses its own");
    if (device.kind == DeviceKind::cpu && command.count("--context") > 0)
      throw CLI::ValidationError("--context",
                                 "says where OpenGL comes from, which --device cpu does not use");
  });
}

void resolve_device(const CLI::App& command, DeviceOptions& device) {
  if (command.count("--device") > 0) return;
  const char* const word = std::getenv("TRIPTYCH_DEVICE");
  if (command.count("--context") > 0) {
    device.kind = DeviceKind::gl;
  } else if (word != nullptr && *word != 0) {
    const auto found = device_kinds().find(word);
    if (found == device_kinds().end())
      throw CLI::ValidationError("TRIPTYCH_DEVICE",
                                 fmt::format("\"{}\" is no device: auto, cpu or gl", word));
    device.kind = found->second;
  }
}

void add_cull_flags(CLI::App& command, CullChoice& cull) {
  const std::map<std::string, StrategyKind> names(strategy_names().begin(), strategy_names().end());
  add_choice_flag(command, "--cull", cull.kind, names, "What is left out")->default_str("occlusion");
  command
      .add_option("--min-pixels", cull.min_pixels,
                  "With --cull approximate: what owns fewer pixels may be left out")
      ->check(whole_number(1, 1'000'000))
      ->capture_default_str();
}

void add_exact_cull_flag(CLI::App& command, StrategyKind& kind) {
  std::map<std::string, StrategyKind> names;
  for (const auto& [name, of_name] : strategy_names()) {
    if (!counts_pixels(of_name)) names.emplace(name, of_name);
  }
  add_choice_flag(command, "--cull", kind, names, "What is left out")->default_str("occlusion");
}

void check_cull_flags(const CLI::App& command, const CullChoice& cull) {
  if (command.count("--min-pixels") > 0 && !counts_pixels(cull.kind))
    throw CLI::ValidationError("--min-pixels", "is of --cull approximate: other strategies count no pixels");
}

void check_target_flag(const RunOptions& options, StrategyKind kind) {
  if (options.target_ms > 0 && kind == StrategyKind::portals)
    throw CLI::ValidationError("--target-ms",
                               "raises the pixel error, with which portals widen, so that more is drawn: "
                               "take another --cull");
}

void add_window_flag(CLI::App& command, bool& window) {
  command.add_flag("--window", window, "Cameras come from a person at a window, and pictures go there");
  command.get_option("--path")->required(false);
}

void size_for_window(const CLI::App& command, RunOptions& options) {
  if (command.count("--size") == 0) options.size = {1280, 800};
}

void require_path(const RunOptions& options, bool window) {
  if (options.path.empty() && !window) throw CLI::RequiredError("--path");
}

void add_timeline_flag(CLI::App& command, std::filesystem::path& file) {
  command
      .add_option("--timeline", file,
                  "Write when each stage of each frame ran, as a Chrome trace (ui.perfetto.dev opens it)")
      ->type_name("FILE");
}

void add_device_and_test_flags(CLI::App& command, DeviceOptions& device) {
  add_device_flags(command, device);
  const std::map<std::string, TestKind> names{{"queries", TestKind::queries}, {"storage", TestKind::storage}};
  add_choice_flag(command, "--test", device.test, names,
                  "How OpenGL tests boxes: occlusion queries, or a draw that marks a storage buffer")
      ->default_str("storage");
}

void add_pack(CLI::App& command, RunOptions& options) {
  command.add_option("pack", options.pack, "The pack to draw")->required()->type_name("FILE.tpk");
}

void add_drawing_flags(CLI::App& command, RunOptions& options) {
  add_pack(command, options);
  add_device_and_test_flags(command, options.device);
}

// Scripts add to a line that they were given: of sizes and counts of frames the last one counts.
void add_path_flags(CLI::App& command, RunOptions& options) {
  command.add_option("--path", options.path, "The camera path")->required()->type_name("FILE");
  command
      .add_option_function<std::string>(
          "--size", [&options](const std::string& text) { options.size = parse_size(text, "--size"); },
          "Width and height of the picture in pixels")
      ->type_name("WxH")
      ->default_str("512x512")
      ->take_last();
  take_one(
      command.add_option("--pixel-error", options.pixel_errors, "How far surfaces may deviate, in pixels"))
      ->check(positive_number())
      ->default_str("1");
  command.add_option("--frames", options.frames, "Only the first frames of the path")
      ->check(whole_number(1, max_frames))
      ->take_last();
}

void add_sizes_flag(CLI::App& command, std::vector<PictureSize>& sizes) {
  take_list(command.add_option_function<std::vector<std::string>>(
                "--sizes",
                [&sizes](const std::vector<std::string>& words) {
                  for (const std::string& word : words) sizes.push_back(parse_size(word, "--sizes"));
                },
                "Draw the path at each of these sizes, instead of --size"))
      ->type_name("WxH,...");
}

void add_samples_flag(CLI::App& command, RunOptions& options) {
  const std::map<std::string, uint32_t> counts{{"1", 1}, {"4", 4}, {"8", 8}, {"16", 16}};
  add_choice_flag(command, "--samples", options.samples, counts,
                  "Samples a pixel: more make outlines smooth, and take as many times longer")
      ->type_name("1|4|8|16")
      ->default_str("1");
}

void add_samples_flag(CLI::App& command, std::vector<uint32_t>& samples) {
  take_list(command.add_option("--samples", samples, "Draw the path with each of so many samples a pixel"))
      ->check(one_of({"1", "4", "8", "16"}))
      ->default_str("1")
      ->type_name("N,...");
}

namespace {
void add_effects_flag(CLI::App& command, Effects& effects) {
  std::vector<std::string_view> names;
  for (const Effect effect : all_effects) names.push_back(effect_name(effect));
  command
      .add_option_function<std::string>(
          "--effects",
          [&effects](const std::string& words) {
            try {
              effects = parse_effects(words, "--effects");
            } catch (const Error& error) {
              throw CLI::ValidationError(error.what());
            }
          },
          "Draw only these of what the model calls for beyond opaque surfaces")
      ->type_name(fmt::format("{}|all|none", fmt::join(names, ",")))
      ->default_str("all");
}

void add_date_flag(CLI::App& command, std::optional<double>& moment) {
  command
      .add_option_function<std::string>(
          "--date",
          [&moment](const std::string& words) {
            try {
              moment = parse_moment(words, "--date");
            } catch (const Error& error) {
              throw CLI::ValidationError(error.what());
            }
          },
          "Show the sky of that moment, with the sun's light, over a model whose place is known")
      ->type_name("2026-06-21T15:00Z");
}
}  // namespace

void add_picture_flags(CLI::App& command, RunOptions& options) {
  add_samples_flag(command, options);
  command.add_flag("--edges", options.edges, "Draw edges and creases as thin lines");
  add_effects_flag(command, options.effects);
  constexpr double years = 1e9;  // seconds
  command
      .add_option("--time", options.time,
                  "Seconds at which what moves is shown, where the path names no time")
      ->check(number_between(-years, years))
      ->type_name("SECONDS");
  add_section_flags(command, options.section);
  add_date_flag(command, options.moment);
}

void add_picture(nlohmann::json& report, const RunOptions& options) {
  report["samples"] = options.samples;
  report["edges"] = options.edges;
  report["effects"] = effects_text(options.effects);
  report["time"] = options.time;
  report["section"] = section_json(options.section);
  if (options.moment) report["date"] = moment_text(*options.moment);
}

void add_every_flag(CLI::App& command, RunOptions& options) {
  command
      .add_option("--every", options.every,
                  "Only every so many frames of the path, each as if it were the next one")
      ->check(whole_number(1, max_frames));
}

CLI::Option* add_target_flag(CLI::App& command, RunOptions& options) {
  return command
      .add_option("--target-ms", options.target_ms,
                  "Raise the pixel error where it must be so that frames take no longer, in milliseconds")
      ->check(positive_number())
      ->type_name("T");
}

void add_run_flags(CLI::App& command, RunOptions& options) {
  add_common_flags(command, options.json);
  add_drawing_flags(command, options);
  add_path_flags(command, options);
}

void add_shown_run_flags(CLI::App& command, RunOptions& options, ShownModel& model) {
  add_common_flags(command, options.json);
  add_shown_model(command, model);
  add_device_and_test_flags(command, options.device);
  add_path_flags(command, options);
}

namespace {
constexpr uint64_t max_batch = uint64_t{1} << 32;

template <typename Target>
CLI::Option* add_batch(CLI::App& command, Target& target) {
  return command
      .add_option("--batch", target, "Ids a packet of a delta: smaller ones come earlier and cost more bytes")
      ->type_name("IDS")
      ->check(whole_number(1, max_batch));
}
}  // namespace

void add_batch_flag(CLI::App& command, size_t& packet_ids) {
  add_batch(command, packet_ids)->capture_default_str();
}
void add_batch_flag(CLI::App& command, std::vector<size_t>& packet_ids) {
  take_one(add_batch(command, packet_ids))->default_str(std::to_string(packet_ids.front()));
}

}  // namespace triptych
