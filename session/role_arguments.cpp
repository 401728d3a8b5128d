#include "session/role_arguments.hpp"

#include "base/inject.hpp"
#include "base/threads.hpp"
#include "measure/frame_journal.hpp"
#include "raster/instruction_set.hpp"
#include "scene/section_text.hpp"
#include "scene/sun.hpp"

namespace triptych {

namespace {

using Words = std::vector<std::string>;

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

/// The name for a command line, where one that begins with a dash would be a flag.
std::string unmistakable(const std::string& name) { return name.starts_with('-') ? "./" + name : name; }

Words shared_arguments(const SessionOptions& options, const SessionSetup& setup, const std::string& pack,
                       const std::string& key_file) {
  Words words = {unmistakable(pack),
                 "--session",
                 std::to_string(setup.session),
                 "--pack-hash",
                 std::to_string(setup.pack_hash),
                 "--connect-timeout",
                 fmt::format("{}", options.connect_timeout_s),
                 "--device",
                 device_name(options.run.device.kind)};
  if (options.run.device.kind != DeviceKind::cpu) {
    append(words, {"--context", options.run.device.context == ContextKind::egl ? "egl" : "osmesa", "--test",
                   options.run.device.test == TestKind::storage ? "storage" : "queries"});
  }
  if (thread_count_limit() > 0) append(words, {"--threads", std::to_string(thread_count_limit())});
  if (const auto set = forced_instruction_set()) append(words, {"--simd", instruction_set_name(*set)});
  const MemoryCaps& caps = options.run.device.memory;
  if (caps.memory != no_cap) append(words, {"--memory", std::to_string(caps.memory)});
  if (caps.device_memory != no_cap) append(words, {"--device-memory", std::to_string(caps.device_memory)});
  if (caps.on_miss == OnMiss::coarser) append(words, {"--on-miss", "coarser"});
  append(words, {"--cull", strategy_name(options.strategy)});
  if (!options.timeline.empty()) append(words, {"--timeline"});
  if (!options.record.empty()) append(words, {"--record", options.record.string()});
  if (!key_file.empty()) append(words, {"--key-file", key_file});
  if (options.insecure) append(words, {"--insecure"});
  for (const std::string& name : injected_names()) append(words, {"--inject", name});
  return words;
}

}  // namespace

Words render_arguments(const SessionOptions& options, const SessionSetup& setup) {
  const RunOptions& run = options.run;
  Words words = {"role", "render"};
  append(words, shared_arguments(options, setup, run.pack.string(),
                                 setup.hosts ? setup.hosts->key_file : options.key_file.string()));
  append(words,
         {"--journal", setup.journal.string(), "--begin", std::to_string(mend_frame_journal(setup.journal)),
          "--size", fmt::format("{}x{}", run.size.width, run.size.height), "--pixel-error",
          fmt::format("{}", run.pixel_error()), "--samples", std::to_string(run.samples),
          "--listen-descriptor", std::to_string(setup.render_listener->descriptor()), "--timeout",
          fmt::format("{}", options.timeout_ms), "--gather", fmt::format("{}", options.gather_s)});
  if (options.until_told) {
    append(words, {"--until-told"});
  } else {
    append(words, {"--loop", std::to_string(options.loop)});
  }
  if (run.frames > 0) append(words, {"--frames", std::to_string(run.frames)});
  if (run.target_ms > 0) append(words, {"--target-ms", fmt::format("{}", run.target_ms)});
  if (options.rate > 0) append(words, {"--rate", fmt::format("{}", options.rate)});
  if (!options.output.empty()) append(words, {"-o", options.output.string()});
  if (!setup.path.empty()) append(words, {"--path", setup.path.string()});
  if (options.window) append(words, {"--window", "--place-file", setup.place.string()});
  if (!setup.bcf.empty())
    append(words, {"--bcf", setup.bcf.string(), "--viewpoint", std::to_string(options.viewpoint.number)});
  if (options.hash) append(words, {"--hash"});
  if (run.edges) append(words, {"--edges"});
  if (run.time != 0) append(words, {"--time", fmt::format("{}", run.time)});
  if (run.effects != Effects::all()) append(words, {"--effects", effects_text(run.effects)});
  if (run.moment) append(words, {"--date", moment_text(*run.moment)});
  for (const std::string& word : run.hide) append(words, {"--hide=" + word});
  for (const std::string& word : run.isolate) append(words, {"--isolate=" + word});
  for (const SectionPlane& plane : run.section.planes()) append(words, {"--section", section_words(plane)});
  if (run.section.box()) append(words, {"--section-box", section_words(*run.section.box())});
  return words;
}

Words switch_arguments(const SessionOptions& options, const SessionSetup& setup, Role role) {
  const bool first = role == Role::switch_0;
  const Host* host = setup.hosts ? &setup.hosts->switch_nodes[first ? 0 : 1] : nullptr;
  Words words = {"role", "switch"};
  append(words, shared_arguments(options, setup, host ? host->pack : options.run.pack.string(),
                                 host ? host->key_file : options.key_file.string()));
  append(words,
         {"--keep-trying", "--index", first ? "0" : "1", "--batch", std::to_string(options.batches.front()),
          "--render", to_text(setup.render_listener->address())});
  if (host) {
    append(words, {"--end-with-stdin", "--tell-record", first ? "--listen" : "--switch-0",
                   to_text(setup.hosts->switch_0)});
  } else if (first) {
    append(words, {"--listen-descriptor", std::to_string(setup.switch_listener->descriptor())});
  } else {
    append(words, {"--switch-0", to_text(setup.switch_listener->address())});
  }
  return words;
}

}  // namespace triptych
