// What the subcommands share: flags that mean the same everywhere, and the functions that add each
// subcommand.
#pragma once

#include "launch/shown_model.hpp"
#include "session/run_options.hpp"
#include "visibility/strategies.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace triptych {

/// Runs the chosen subcommand once the command line was parsed; returns the exit code.
using Action = std::function<int()>;

/// --json, --inject and --threads, which every subcommand takes.
void add_common_flags(CLI::App& command, std::filesystem::path& json);
/// --device and --context, and what the environment's TRIPTYCH_DEVICE says where neither is given. Takes the
/// command's parse_complete_callback(); a context beside --device cpu is a usage error.
void add_device_flags(CLI::App& command, DeviceOptions& device);
/// Once the command line was parsed: what flags and environment come to. A usage error where the environment
/// names no device.
void resolve_device(const CLI::App& command, DeviceOptions& device);
/// --window; then --path is not needed: require_path() checks that once the command line was parsed.
void add_window_flag(CLI::App& command, bool& window);
/// A window is larger than a picture where --size does not say how large; once the command line was parsed.
void size_for_window(const CLI::App& command, RunOptions& options);
void require_path(const RunOptions& options, bool window);
/// --timeline.
void add_timeline_flag(CLI::App& command, std::filesystem::path& file);
/// The same and --test.
void add_device_and_test_flags(CLI::App& command, DeviceOptions& device);
/// The positional "pack", a file that must be one.
void add_pack(CLI::App& command, RunOptions& options);
/// add_pack() and add_device_and_test_flags(): what every process that draws needs.
void add_drawing_flags(CLI::App& command, RunOptions& options);
/// --path, --size, --pixel-error, --frames. The last --size and the last --frames count.
void add_path_flags(CLI::App& command, RunOptions& options);
/// --sizes: a list, where a command draws the path at several; empty where it is not given.
void add_sizes_flag(CLI::App& command, std::vector<PictureSize>& sizes);
/// --samples: of each pixel.
void add_samples_flag(CLI::App& command, RunOptions& options);
/// The same as a list, where a command draws the path with several; empty where it is not given.
void add_samples_flag(CLI::App& command, std::vector<uint32_t>& samples);
/// --samples, --edges, --section and --section-box: how the frames of a path are drawn.
void add_picture_flags(CLI::App& command, RunOptions& options);
/// {"samples", "edges", "section": {"planes", "box"}}, into a report.
void add_picture(nlohmann::json& report, const RunOptions& options);
/// --every: only every so many frames of the path.
void add_every_flag(CLI::App& command, RunOptions& options);
/// --target-ms: a frame time to keep by raising the pixel error.
CLI::Option* add_target_flag(CLI::App& command, RunOptions& options);
/// add_common_flags, add_drawing_flags and add_path_flags.
void add_run_flags(CLI::App& command, RunOptions& options);
/// The same for a command that also takes model files (launch/shown_model.hpp), without the pack.
void add_shown_run_flags(CLI::App& command, RunOptions& options, ShownModel& model);

/// --cull and --min-pixels. A --min-pixels beside a strategy that does not count is a usage error.
struct CullChoice {
  StrategyKind kind = StrategyKind::occlusion;
  uint32_t min_pixels = StrategyOptions{}.min_pixels;
};
void add_cull_flags(CLI::App& command, CullChoice& cull);
/// --cull of a session, which claims that its pictures are the un-culled ones.
void add_exact_cull_flag(CLI::App& command, StrategyKind& kind);
/// Checks that once the command line was parsed.
void check_cull_flags(const CLI::App& command, const CullChoice& cull);

/// Once the command line was parsed: portals beside --target-ms are a usage error.
void check_target_flag(const RunOptions& options, StrategyKind kind);

/// --batch: ids per packet of a delta; one, or a list where a command sweeps.
void add_batch_flag(CLI::App& command, size_t& packet_ids);
void add_batch_flag(CLI::App& command, std::vector<size_t>& packet_ids);

/// The words of a command that was parsed, as a shell takes them: for reports that name the command that
/// printed them.
std::string command_line(const CLI::App& command);
/// The same without flags that do not decide what pictures show: --begin, --json,
/// --threads, --timeline. Two runs with equal words make the same (launch/output_folder.hpp).
std::string run_line(const CLI::App& command);

void add_sample(CLI::App& app, Action& action);
void add_build(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_render(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_session(CLI::App& app, Action& action);
void add_replay(CLI::App& app, Action& action);
void add_explain(CLI::App& app, Action& action);
void add_role(CLI::App& app, Action& action);
void add_measure(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_selftest(CLI::App& app, Action& action);
/// Hidden: prints the man page and what shells complete. The app must outlive it.
void add_describe(CLI::App& app, Action& action);

}  // namespace triptych
