// SPDX-License-Identifier: MIT
// strut completion bash|zsh: prints a completion script. It is made from the commands and options as CLI11 holds them,
// so it offers what this very program understands and cannot drift from it.
#include "commands.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace strut::cli {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

bool has_commands(const CLI::App& command) {
  return !commands_of(command).empty();
}

std::string names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return joined(names);
}

/// An option's spellings, e.g. "-o", "--output"; none for a positional argument.
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// The values an option may have where help shows a fixed set, as "a|b" or (CLI11's own ways) "{a,b}" or
/// "{a->1,b->2}"; else empty.
std::vector<std::string> choices(const CLI::Option& option) {
  std::string type = option.get_type_name();
  const auto open = type.find('{');
  if (open != std::string::npos) {
    type = type.substr(open + 1, type.find('}') - open - 1);
  } else if (type.find('|') == std::string::npos) {
    return {};
  }
  std::vector<std::string> words = CLI::detail::split(type, open == std::string::npos ? '|' : ',');
  for (std::string& word : words) word.resize(std::min(word.size(), word.find("->")));
  return words;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

std::string bash_case(const std::string& pattern, const std::vector<std::string>& words) {
  return fmt::format("    {}) words='{}' ;;\n", pattern, joined(words));
}

/// What may follow an option (by command and option), and what else a command understands.
struct BashTables {
  std::string values, options;
};

void add_to_tables(const std::string& name, const CLI::App& command, BashTables& tables) {
  std::vector<std::string> words;
  if (has_commands(command)) words.push_back(names_of(commands_of(command)));
  for (const CLI::Option* option : command.get_options()) {
    const auto own = spellings(*option);
    const auto fixed = choices(*option);
    if (own.empty()) words.insert(words.end(), fixed.begin(), fixed.end());
    words.insert(words.end(), own.begin(), own.end());
    for (const std::string& spelling : own) {
      if (takes_value(*option)) tables.values += bash_case(fmt::format("'{}:{}'", name, spelling), fixed);
    }
  }
  tables.options += bash_case(fmt::format("'{}'", name), words);
  for (const CLI::App* below : commands_of(command)) add_to_tables(name + " " + below->get_name(), *below, tables);
}

/// The cases of a command of commands: the word after it belongs to its name.
std::string bash_groups(const CLI::App& app) {
  std::vector<std::string> groups;
  for (const CLI::App* command : commands_of(app)) {
    if (has_commands(*command)) groups.push_back(command->get_name());
  }
  return fmt::format("{}", fmt::join(groups, "|"));
}

std::string bash_script(const CLI::App& app) {
  BashTables tables;
  for (const CLI::App* command : commands_of(app)) add_to_tables(command->get_name(), *command, tables);
  return fmt::format(
      "# bash completion of strut, made by: strut completion bash\n"
      "_strut() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} words=none\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -le 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$current\"))\n"
      "    return\n"
      "  fi\n"
      "  local command=${{COMP_WORDS[1]}}\n"
      "  case $command in {}) [ \"$COMP_CWORD\" -le 2 ] || command+=\" ${{COMP_WORDS[2]}}\" ;; esac\n"
      "  case $command:$previous in\n{}  esac\n"
      "  local is_fixed=${{words#none}}\n"
      "  if [ \"$words\" = none ]; then\n"
      "    case $command in\n{}    esac\n"
      "  fi\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "  [[ -n $is_fixed || $current == -* ]] || COMPREPLY+=($(compgen -f -- \"$current\"))\n"
      "}}\n"
      "complete -o filenames -F _strut strut\n",
      names_of(commands_of(app)), bash_groups(app), tables.values, tables.options);
}

/// `text` inside single quotes, with what zsh's _arguments reads as punctuation escaped.
std::string zsh_text(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') quoted += '\\';
      quoted += c;
    }
  }
  return quoted;
}

std::string zsh_value(const CLI::Option& option) {
  const auto fixed = choices(option);
  return fixed.empty() ? ":value:_files" : fmt::format(":value:({})", joined(fixed));
}

std::string zsh_arguments(const CLI::App& command) {
  std::string arguments;
  for (const CLI::Option* option : command.get_options()) {
    const auto own = spellings(*option);
    if (own.empty()) {
      arguments += fmt::format(" \\\n        '*{}'", zsh_value(*option));
    }
    for (const std::string& spelling : own) {
      arguments += fmt::format(" \\\n        '*{}[{}]{}'", spelling, zsh_text(option->get_description()),
                               takes_value(*option) ? zsh_value(*option) : "");
    }
  }
  return arguments;
}

/// Offers the commands of `app` as the next word, then what each of them takes.
std::string zsh_commands(const CLI::App& app) {
  std::string commands;
  std::string cases;
  for (const CLI::App* command : commands_of(app)) {
    commands += fmt::format("    '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
    cases += fmt::format("    {})\n", command->get_name());
    cases +=
        has_commands(*command) ? zsh_commands(*command) : fmt::format("      _arguments{}\n", zsh_arguments(*command));
    cases += "      ;;\n";
  }
  return fmt::format(
      "  commands=(\n{}  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $words[1] in\n{}  esac\n",
      commands, cases);
}

std::string zsh_script(const CLI::App& app) {
  return fmt::format(
      "#compdef strut\n"
      "# zsh completion of strut, made by: strut completion zsh\n"
      "_strut() {{\n"
      "  local -a commands\n"
      "{}"
      "}}\n"
      "if [ \"$funcstack[1]\" = _strut ]; then _strut \"$@\"; else compdef _strut strut; fi\n",
      zsh_commands(app));
}

}  // namespace

void add_completion(CLI::App& app) {
  CLI::App* command = app.add_subcommand("completion", "Print a script that completes strut's commands in a shell");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "The shell: bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  command->callback([&app, shell] { fmt::print("{}", *shell == "bash" ? bash_script(app) : zsh_script(app)); });
}

}  // namespace strut::cli
