#include "launch/kept_build.hpp"

#include "base/file.hpp"
#include "measure/json.hpp"
#include "preprocess/work_folder.hpp"

#include <string_view>

namespace triptych {

namespace {

ContentKey key_of(std::string_view what, const std::string& content) {
  ContentKeyWriter writer;
  writer.write_all(std::span<const char>(what));
  writer.write_all(std::span<const char>(content));
  return writer.key();
}

}  // namespace

KeptBuild::KeptBuild(BuildCache& cache, const BuildFlags& flags)
    : cache_(cache),
      content_(flags),
      report_key_(key_of("report of a whole build\n", content_.key())),
      pack_key_(key_of("pack of a whole build\n", content_.key())) {}

std::optional<nlohmann::json> KeptBuild::take(const std::filesystem::path& pack) const {
  const auto bytes = cache_.find(report_key_);
  if (!bytes) return std::nullopt;
  const auto* const text = reinterpret_cast<const char*>(bytes->data());
  nlohmann::json kept = nlohmann::json::parse(text, text + bytes->size());
  if (!content_.still_holds(kept.at("opened").get<ModelContent::Files>())) return std::nullopt;
  const WorkFolder alone(pack, {}, {});  // and without what a killed build left
  AtomicFile file(pack);
  if (!cache_.read(pack_key_, [&](std::span<const std::byte> stretch) { file.write(stretch); }))
    return std::nullopt;
  file.commit();
  nlohmann::json& report = kept.at("report");
  for (nlohmann::json& name : report.at("files")) name = content_.file_of(name).string();
  return std::move(report);
}

void KeptBuild::keep(nlohmann::json report, const std::filesystem::path& pack) const {
  const ModelContent::Files opened = content_.opened(report.at("files").get<std::vector<std::string>>());
  if (content_.key_now() != content_.key()) return;
  for (nlohmann::json& name : report.at("files")) name = content_.name_of(name.get<std::string>());
  const std::string text = json_text({{"opened", opened}, {"report", report}});
  cache_.keep(report_key_, std::as_bytes(std::span(text)));
  cache_.keep_file(pack_key_, pack);
}

}  // namespace triptych
