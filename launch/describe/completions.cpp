#include "launch/describe/described_command.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

namespace {

/// A word in single quotes for sh, bash and zsh.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? "'\\''" : std::string(1, letter);
  return word + "'";
}

/// The words of a flag's value, with spaces between them.
std::string words_of(const DescribedFlag& flag) { return CLI::detail::join(flag.choices, " "); }

/// The first sentence or part of one: what fits beside a flag.
std::string short_description(const std::string& text) {
  return text.substr(0, std::min(text.find_first_of(";:\n"), text.find(". ")));
}

std::vector<std::string> flag_names(const DescribedCommand& command) {
  std::vector<std::string> names;
  for (const DescribedFlag& flag : command.flags) {
    if (!flag.positional) names.insert(names.end(), flag.names.begin(), flag.names.end());
  }
  return names;
}

/// For zsh's _arguments, within single quotes.
std::string zsh_text(const std::string& text) {
  std::string escaped;
  for (const char letter : short_description(text)) {
    if (std::string("[]:\\").find(letter) != std::string::npos) escaped += '\\';
    escaped += letter;
  }
  return escaped;
}

/// What zsh calls for a flag's value.
std::string zsh_action(const DescribedFlag& flag) {
  if (flag.choices.empty()) return flag.names_file ? "_files" : " ";
  return flag.is_list ? "_values -s , value " + words_of(flag) : "(" + words_of(flag) + ")";
}

std::string zsh_function(const DescribedCommand& command) {
  std::string name = "_triptych";
  for (const std::string& word : command.path) name += "_" + word;
  std::string text = name + "() {\n";
  if (!command.subcommands.empty()) {
    text += "  local -a commands=(" + CLI::detail::join(command.subcommands, " ") +
            ")\n"
            "  if (( CURRENT == 2 )); then compadd -- $commands --help; return; fi\n"
            "  local chosen=$words[2]\n  shift words\n  (( CURRENT-- ))\n"
            "  (( $+functions[" +
            name + "_$chosen] )) && " + name + "_$chosen\n}\n";
    return text;
  }
  text += "  _arguments";
  for (const DescribedFlag& flag : command.flags) {
    if (flag.positional) continue;
    for (const std::string& flag_name : flag.names)
      text += " \\\n    " +
              quoted("*" + flag_name + "[" + zsh_text(flag.description) + "]" +
                     (flag.value.empty() ? "" : ":" + zsh_text(flag.value) + ":" + zsh_action(flag)));
  }
  return text + " \\\n    '*:file:_files'\n}\n";
}

/// The condition under which fish completes flags of a command, and the subcommands below it.
std::string fish_condition(const DescribedCommand& command, bool subcommands) {
  if (command.path.empty()) return "__fish_use_subcommand";
  // The words that were typed, in their order: `measure session` is not `session`.
  return (subcommands ? "__triptych_at " : "__triptych_command ") + command.words();
}

}  // namespace

std::string bash_completion(const std::vector<DescribedCommand>& commands) {
  std::string known, values, flags, below;
  for (const DescribedCommand& command : commands) {
    if (!command.path.empty()) known += (known.empty() ? "" : " | ") + quoted(command.words());
    flags += fmt::format("      {}) words={} ;;\n", quoted(command.words()),
                         quoted(CLI::detail::join(flag_names(command), " ")));
    if (!command.subcommands.empty())
      below += fmt::format("      {}) words={} ;;\n", quoted(command.words()),
                           quoted(CLI::detail::join(command.subcommands, " ")));
    for (const DescribedFlag& flag : command.flags) {
      if (flag.choices.empty()) continue;
      for (const std::string& name : flag.names)
        values += fmt::format("    {}) {} {}; return ;;\n", quoted(command.words() + ":" + name),
                              flag.is_list ? "_triptych_list" : "_triptych_word", quoted(words_of(flag)));
    }
  }
  return "# Completes command lines of triptych in bash. Made by `triptych describe bash`.\n"
         "_triptych_word() { COMPREPLY=($(compgen -W \"$1\" -- \"$word\")); }\n"
         // The last word of a list, and none of those before it again; what they offer begins with those.
         "_triptych_list() {\n"
         "  local given='' last=${word##*,} choice\n"
         "  [[ $word == *,* ]] && given=${word%,*},\n"
         "  for choice in $1; do\n"
         "    [[ $choice == \"$last\"* && ,$given != *,$choice,* ]] && COMPREPLY+=(\"$given$choice\")\n"
         "  done\n"
         "}\n"
         "_triptych() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command='' longer "
         "words='' i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    longer=${command:+$command }${COMP_WORDS[i]}\n"
         "    case $longer in\n"
         "      " +
         known +
         ") command=$longer ;;\n"
         "    esac\n"
         "  done\n"
         "  COMPREPLY=()\n"
         "  case $command:$before in\n" +
         values +
         "  esac\n"
         "  if [[ $word == -* ]]; then\n"
         "    case $command in\n" +
         flags +
         "    esac\n"
         "  else\n"
         "    case $command in\n" +
         below +
         "      *) mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); return ;;\n"
         "    esac\n"
         "  fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "}\n"
         "complete -o filenames -F _triptych triptych\n";
}

std::string zsh_completion(const std::vector<DescribedCommand>& commands) {
  std::string script =
      "#compdef triptych\n# Completes command lines of triptych in zsh. Made by `triptych describe zsh`.\n";
  for (const DescribedCommand& command : commands) script += zsh_function(command);
  return script + "_triptych \"$@\"\n";
}

std::string fish_completion(const std::vector<DescribedCommand>& commands) {
  std::string script =
      "# Completes command lines of triptych in fish. Made by `triptych describe fish`.\n"
      "function __triptych_command\n"
      "  set -l typed (commandline -opc)\n"
      "  set -l last (math (count $argv) + 1)\n"
      "  test (count $typed) -ge $last; and test \"$typed[2..$last]\" = \"$argv\"\n"
      "end\n"
      "function __triptych_at\n"
      "  __triptych_command $argv; and test (count (commandline -opc)) -eq (math (count $argv) + 1)\n"
      "end\n";
  for (const DescribedCommand& command : commands) {
    for (const std::string& sub : command.subcommands) {
      std::vector<std::string> path = command.path;
      path.push_back(sub);
      const auto found =
          std::find_if(commands.begin(), commands.end(),
                       [&](const DescribedCommand& candidate) { return candidate.path == path; });
      script +=
          fmt::format("complete -c triptych -n {} -f -a {} -d {}\n", quoted(fish_condition(command, true)),
                      sub, quoted(short_description(found->description)));
    }
    for (const DescribedFlag& flag : command.flags) {
      if (flag.positional) continue;
      script += "complete -c triptych -n " + quoted(fish_condition(command, false));
      for (const std::string& name : flag.names)
        script += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!flag.choices.empty()) {
        script +=
            " -x -a " + quoted(flag.is_list ? "(__fish_append , " + words_of(flag) + ")" : words_of(flag));
      } else if (!flag.value.empty()) {
        script += flag.names_file ? " -r" : " -x";
      }
      script += " -d " + quoted(short_description(flag.description)) + "\n";
    }
  }
  return script;
}

}  // namespace triptych
