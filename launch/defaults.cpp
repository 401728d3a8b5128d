#include "launch/defaults.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/near_words.hpp"
#include "session/parse_toml.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <string_view>

namespace triptych {

namespace {

std::vector<CLI::App*> subcommands(CLI::App& command) {
  return command.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
}

/// Flags of which each says what another is about: where the command line gives one, the others' defaults are
/// not of this run.
bool belong_together(std::string_view one, std::string_view other) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> pairs = {
      {{"--device", "--context"},
       {"--device", "--simd"},
       {"--cull", "--min-pixels"},
       {"--strategies", "--min-pixels"}}};
  return std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
    return (one == pair.first && other == pair.second) || (one == pair.second && other == pair.first);
  });
}

bool is_ruled_out(const CLI::Option& option, const WordsRead& line) {
  return std::any_of(line.given.begin(), line.given.end(), [&](const CLI::Option* given) {
    return given == &option || option.get_excludes().count(const_cast<CLI::Option*>(given)) > 0 ||
           belong_together(option.get_name(), given->get_name());
  });
}

/// Every flag of the command and of those below it.
void collect_flags(CLI::App& command, std::set<std::string>& flags) {
  for (const std::string& name : flags_of(command)) flags.insert(name);
  for (CLI::App* sub : subcommands(command)) collect_flags(*sub, flags);
}

/// Flags that stand for a run of their own, not for how runs are made.
bool is_no_default(std::string_view name) { return name == "help" || name == "version"; }

class DefaultsFile {
 public:
  DefaultsFile(const std::filesystem::path& file, const WordsRead& line, Defaults& defaults)
      : file_(file), line_(line), defaults_(defaults) {}

  /// A table within a table within a table, thousands deep, would be more than the parser's stack takes.
  void check_is_plain(const std::string& text) const {
    constexpr size_t most_bytes = 256 << 10;
    constexpr int most_dots = 200;
    if (text.size() > most_bytes) fail(file_.string(), "is larger than {} KiB", most_bytes >> 10);
    int line = 1, dots = 0;
    for (const char letter : text) {
      dots += letter == '.';
      if (letter == '\n') ++line, dots = 0;
      if (dots > most_dots) fail(file_.string(), "line {}: has more than {} dots", line, most_dots);
    }
  }

  void read(CLI::App& app) {
    const std::string text = read_text_file(file_);
    check_is_plain(text);
    const toml::table table = parse_toml(text, file_.string());
    // What is said of one command counts before what is said of all.
    read_tables(app, table, "");
    std::set<std::string> flags;
    collect_flags(app, flags);
    for (const auto& [key, value] : table) {
      if (value.is_table()) continue;
      const std::string name(key.str());
      expect_known(name, {flags.begin(), flags.end()}, value, "is no flag of any command");
      take(name, value);
    }
  }

 private:
  std::string place(const std::string& key, const toml::node& value) const {
    return fmt::format("{}: line {}: {}", file_.string(), value.source().begin.line, key);
  }

  void expect_known(const std::string& name, const std::vector<std::string>& known, const toml::node& value,
                    const std::string& what) const {
    if (is_no_default(name) || std::find(known.begin(), known.end(), name) == known.end())
      fail(place(name, value), "{}{}", what, did_you_mean(name, known));
  }

  /// The tables of a command's subcommands.
  void read_tables(CLI::App& command, const toml::table& tables, const std::string& above) {
    std::vector<std::string> names;
    for (const CLI::App* sub : subcommands(command)) names.push_back(sub->get_name());
    for (const auto& [key, node] : tables) {
      const toml::table* const table = node.as_table();
      if (!table) continue;
      const std::string name(key.str()), whole = above + name;
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end() || name == "role")
        fail(place("[" + whole + "]", node), "{}{}",
             name == "role" ? "gets its flags from its session alone" : "is no command",
             did_you_mean(name, names));
      CLI::App& sub = *subcommands(command)[static_cast<size_t>(found - names.begin())];
      read_tables(sub, *table, whole + ".");
      for (const auto& [flag, value] : *table) {
        if (value.is_table()) continue;
        const std::string flag_name(flag.str());
        expect_known(flag_name, flags_of(sub), value, "is no flag of " + command_name(sub));
        if (&sub == line_.command) take(flag_name, value);
      }
    }
  }

  void take(const std::string& name, const toml::node& value) {
    const CLI::Option* const option = line_.command->get_option_no_throw("--" + name);
    const std::vector<std::string> texts = texts_of(name, value);  // also where it is of another command
    if (!option || defaults_.places.count(option->get_name()) > 0 || is_ruled_out(*option, line_)) return;
    defaults_.places[option->get_name()] = place(name, value);
    const bool is_flag = option->get_items_expected_max() == 0;
    if (is_flag != value.is_boolean())
      fail(place(name, value), "{}", is_flag ? "is true or false" : "takes a value, not true or false");
    for (const std::string& text : texts)
      defaults_.words.push_back("--" + name + (is_flag ? "" : "=" + text));
  }

  /// The value as on a command line; none for false.
  std::vector<std::string> texts_of(const std::string& name, const toml::node& value) const {
    if (const auto text = value.value<std::string>(); value.is_string()) return {*text};
    if (value.is_integer()) return {std::to_string(*value.value<int64_t>())};
    if (value.is_floating_point()) return {fmt::format("{}", *value.value<double>())};
    if (value.is_boolean())
      return *value.value<bool>() ? std::vector<std::string>{""} : std::vector<std::string>{};
    const toml::array* const list = value.as_array();
    if (!list) fail(place(name, value), "is neither a text, a number, true or false, nor a list of these");
    std::vector<std::string> texts;
    for (const toml::node& item : *list) {
      const auto text = texts_of(name, item);
      texts.insert(texts.end(), text.begin(), text.end());
    }
    const CLI::Option* const option = line_.command->get_option_no_throw("--" + name);
    if (option && option->get_delimiter() == ',' && !texts.empty()) return {CLI::detail::join(texts, ",")};
    return texts;
  }

  const std::filesystem::path& file_;
  const WordsRead& line_;
  Defaults& defaults_;
};

/// Flags that need another one, which neither the command line nor the files give, are not of this run.
void drop_what_stands_alone(const WordsRead& line, Defaults& defaults) {
  const auto is_given = [&](const CLI::Option* option) {
    return line.given.count(option) > 0 || defaults.places.count(option->get_name()) > 0;
  };
  for (CLI::Option* const option : line.command->get_options()) {
    const auto needs = option->get_needs();
    if (defaults.places.count(option->get_name()) == 0 || std::all_of(needs.begin(), needs.end(), is_given))
      continue;
    defaults.places.erase(option->get_name());
    std::erase_if(defaults.words, [&](const std::string& word) {
      return word.substr(0, word.find('=')) == option->get_name();
    });
  }
}

}  // namespace

std::vector<std::filesystem::path> default_files() {
  const auto variable = [](const char* name) -> std::filesystem::path {
    const char* const value = std::getenv(name);
    return value ? value : "";
  };
  std::vector<std::filesystem::path> files;
  if (std::getenv("TRIPTYCH_CONFIG")) {
    if (!variable("TRIPTYCH_CONFIG").empty()) files.push_back(variable("TRIPTYCH_CONFIG"));
    return files;  // one that is named must be there
  }
  files.emplace_back("triptych.toml");
  const auto home = variable("HOME"), configurations = variable("XDG_CONFIG_HOME");
  if (configurations.is_absolute()) {
    files.push_back(configurations / "triptych" / "triptych.toml");
  } else if (home.is_absolute()) {
    files.push_back(home / ".config" / "triptych" / "triptych.toml");
  }
  std::error_code error;
  std::erase_if(files, [&](const auto& file) { return !std::filesystem::exists(file, error); });
  return files;
}

Defaults read_defaults(CLI::App& app, const WordsRead& line,
                       const std::vector<std::filesystem::path>& files) {
  Defaults defaults;
  for (const auto& file : files) DefaultsFile(file, line, defaults).read(app);
  drop_what_stands_alone(line, defaults);
  return defaults;
}

}  // namespace triptych
