#include "session/hosts.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "session/parse_toml.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// ssh ends, and is started again, where the other machine is not heard of for a minute.
constexpr const char* default_launch =
    "ssh -o BatchMode=yes -o ConnectTimeout=20 -o ServerAliveInterval=20 {host} {remote}";

/// A table's texts, read by their keys; keys that were never read are an error.
class Texts {
 public:
  Texts(const std::filesystem::path& path, std::string table, const toml::table* values)
      : place_(path.string() + (table.empty() ? "" : ": [" + table + "]")), values_(values) {}

  std::string get(const std::string& key, const std::string& otherwise) {
    asked_.push_back(key);
    const toml::node* node = values_ ? values_->get(key) : nullptr;
    if (node == nullptr) return otherwise;
    if (!node->is_string()) fail(place_, "{} must be a text in quotes", key);
    return node->as_string()->get();
  }
  std::string need(const std::string& key) {
    const std::string text = get(key, "");
    if (text.empty()) fail(place_, "{} is missing", key);
    return text;
  }
  void expect_no_more() const {
    if (!values_) return;
    for (const auto& [key, node] : *values_) {
      const std::string name(key.str());
      if (!node.is_table() && std::count(asked_.begin(), asked_.end(), name) == 0)
        fail(place_, "{} is not known", name);
    }
  }

 private:
  std::string place_;
  const toml::table* values_;
  std::vector<std::string> asked_;
};

std::string shell_word(const std::string& word) {
  std::string text = "'";
  for (const char character : word)
    text += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return text + "'";
}

using Marks = std::vector<std::pair<std::string, std::string>>;

/// The template with each mark replaced, in one pass: marks within replacements are not replaced.
std::string fill_in(const std::string& text, const Marks& marks) {
  std::string filled;
  for (size_t at = 0; at < text.size();) {
    const auto mark = std::find_if(marks.begin(), marks.end(), [&](const auto& candidate) {
      return text.compare(at, candidate.first.size(), candidate.first) == 0;
    });
    filled += mark == marks.end() ? text.substr(at, 1) : mark->second;
    at += mark == marks.end() ? 1 : mark->first.size();
  }
  return filled;
}

}  // namespace

Hosts read_hosts(const std::filesystem::path& path, const std::string& pack) {
  const toml::table file = parse_toml(read_text_file(path), path.string());
  for (const auto& [key, node] : file) {
    const std::string name(key.str());
    if (node.is_table() && name != "render" && name != "switch_0" && name != "switch_1")
      fail(path.string(), "[{}] is not known", name);
  }
  Hosts hosts;
  Texts all(path, "", &file);
  hosts.launch = all.get("launch", default_launch);
  if (hosts.launch.find("{host}") == std::string::npos) fail(path.string(), "launch must contain {{host}}");
  if (hosts.launch.find("{command}") == std::string::npos &&
      hosts.launch.find("{remote}") == std::string::npos)
    fail(path.string(), "launch must contain {{command}} or {{remote}}");
  const Host common{"", all.get("program", "triptych"), all.get("pack", pack), all.get("key_file", "")};
  all.expect_no_more();
  Texts render(path, "render", file["render"].as_table());
  hosts.render = parse_address(render.need("address"));
  hosts.key_file = render.get("key_file", common.key_file);
  render.expect_no_more();
  for (size_t i = 0; i < hosts.switch_nodes.size(); ++i) {
    const std::string table = "switch_" + std::to_string(i);
    Texts texts(path, table, file[table].as_table());
    hosts.switch_nodes[i] = {texts.need("host"), texts.get("program", common.program),
                             texts.get("pack", common.pack), texts.get("key_file", common.key_file)};
    if (i == 0) hosts.switch_0 = parse_address(texts.need("address"));
    texts.expect_no_more();
  }
  return hosts;
}

std::string launch_line(const Hosts& hosts, const Host& host, const std::vector<std::string>& arguments) {
  std::string command = shell_word(host.program);
  for (const std::string& argument : arguments) command += " " + shell_word(argument);
  return "exec " + fill_in(hosts.launch, {{"{host}", shell_word(host.name)},
                                          {"{remote}", shell_word(command)},
                                          {"{command}", command}});
}

}  // namespace triptych
