#include "launch/describe/described_command.hpp"

#include <fmt/core.h>

namespace triptych {

namespace {

/// Text in troff: no backslash, dash or dot means anything but itself.
std::string troff(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char letter : text) {
    if (begins_line && (letter == '.' || letter == '\'')) escaped += "\\&";
    escaped += letter == '\\' ? "\\e" : letter == '-' ? "\\-" : std::string(1, letter);
    begins_line = letter == '\n';
  }
  return escaped;
}

std::string flag_entry(const DescribedFlag& flag) {
  std::string names;
  for (const std::string& name : flag.names)
    names += (names.empty() ? "" : ", ") + ("\\fB" + troff(name) + "\\fR");
  std::string notes;
  if (!flag.otherwise.empty()) notes += " (default: " + flag.otherwise + ")";
  if (flag.required) notes += " (required)";
  return fmt::format(".TP\n{}{}\n{}\n", names, flag.value.empty() ? "" : " \\fI" + troff(flag.value) + "\\fR",
                     troff(flag.description + notes));
}

}  // namespace

std::string man_page(const std::vector<DescribedCommand>& commands, const std::string& version) {
  // "Triptych: what it does"
  const std::string& title = commands.front().description;
  const std::string does = title.substr(title.find(": ") == std::string::npos ? 0 : title.find(": ") + 2);
  std::string page = fmt::format(
      ".TH TRIPTYCH 1 \"\" \"triptych {}\"\n.SH NAME\ntriptych \\- {}\n.SH SYNOPSIS\n.B triptych\n.I "
      "command\n"
      ".RI [ flags ]\n.SH COMMANDS\n",
      troff(version), troff(does));
  for (const DescribedCommand& command : commands) {
    if (command.path.empty()) continue;
    page += fmt::format(".SS \"triptych {}\"\n{}.\n", troff(command.words()), troff(command.description));
    for (const DescribedFlag& flag : command.flags) page += flag_entry(flag);
    if (!command.footer.empty()) page += ".PP\n.nf\n" + troff(command.footer) + "\n.fi\n";
  }
  page +=
      ".SH EXIT STATUS\n0: done. 1: failed; the last line on standard error says what and where. 2: usage. "
      "130, 143: "
      "interrupted.\n"
      ".SH FILES\n.TP\n.I triptych.toml\nDefaults of flags: in the working folder, and in\n.I "
      "~/.config/triptych/triptych.toml\n"
      ".SH ENVIRONMENT\n"
      ".TP\n.B TRIPTYCH_DEVICE\nThe device where no flag names one: auto, cpu or gl\n"
      ".TP\n.B TRIPTYCH_CACHE\nThe folder for packs of model files that were shown (default: "
      "~/.cache/triptych)\n"
      ".TP\n.B TRIPTYCH_CONFIG\nThe file that is read in place of triptych.toml; empty: none\n";
  return page;
}

}  // namespace triptych
