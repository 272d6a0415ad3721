#include "tyndall/cli/request_message.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include "tyndall/document/fault.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

/// The command that was being parsed, or the program itself.
const CLI::App& command_of(const CLI::App& app) {
  const auto begun = app.get_subcommands();
  return begun.empty() ? app : *begun.back();
}

/// An option's description in the middle of a sentence.
std::string about(const CLI::Option& option) {
  std::string text = option.get_description();
  const bool word = text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0;
  if (word || text.starts_with("A ")) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::optional<std::string> unknown_command(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<std::string_view> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  const std::string first = argc > 1 ? argv[1] : "";
  for (const std::string_view name : names) {
    if (name == first) return std::nullopt;
  }
  const std::string what = first.starts_with('-') ? "the option " : "";
  return Fault("command", what + in_quotes(first), one_of(first, names)).what();
}

std::string unexpected(const CLI::App& command, const std::vector<std::string>& extras) {
  std::vector<std::string> options;
  std::string arguments;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    if (option->get_positional()) arguments += (arguments.empty() ? "" : " and ") + option->get_name(true);
  }
  for (const std::string& extra : extras) {
    if (!extra.starts_with('-')) continue;
    const std::string word = extra.substr(0, extra.find('='));
    return Fault(command.get_name(), "the unknown option " + in_quotes(word),
                 one_of(word, {options.begin(), options.end()}))
        .what();
  }
  return Fault(command.get_name(), in_quotes(extras.empty() ? "" : extras.front()) + ", one argument too many",
               arguments + " and options")
      .what();
}

std::string missing(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    const std::string name = option->get_name();
    return Fault(command.get_name(), "no " + name, (name.starts_with('-') ? "this option too: " : "") + about(*option))
        .what();
  }
  return Fault(command.get_name(), "an incomplete request", "what --help says").what();
}

/// The option that a message of the parser begins with or names, such as "--spp" in "--spp: 1 required INT missing".
const CLI::Option* named_option(const CLI::App& command, const std::string& name) {
  return name.empty() ? nullptr : command.get_option_no_throw(name);
}

std::string wrong_count(const CLI::App& command, const std::string& said) {
  const std::string name = said.substr(0, said.find(':'));
  if (said.find("At Most") != said.npos || said.find("at most") != said.npos) {
    return Fault(command.get_name(), name + " more than once", "each option once").what();
  }
  const CLI::Option* const option = named_option(command, name);
  return Fault(command.get_name(), "nothing after " + name, option == nullptr ? "a value" : about(*option)).what();
}

std::string unreadable(const CLI::App& command, const std::string& said) {
  constexpr std::string_view lead = "Could not convert: ";
  const std::size_t begin = said.find(lead), equals = said.find(" = ");
  if (begin == said.npos || equals == said.npos) return printable(said);
  const std::string name = said.substr(begin + lead.size(), equals - begin - lead.size());
  const CLI::Option* const option = named_option(command, name);
  const bool flag = option != nullptr && option->get_expected_max() == 0;
  return Fault(name, in_quotes(said.substr(equals + 3)),
               flag                ? "no value after it"
               : option == nullptr ? "another value"
                                   : about(*option))
      .what();
}

}  // namespace

std::string request_message(const CLI::ParseError& error, const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App& command = command_of(app);
  if (&command == &app) {
    if (const auto message = unknown_command(app, argc, argv)) return *message;
  }
  const std::string help = " (see tyndall " + command.get_name() + " --help)", said = error.what();
  const auto extras = command.remaining();
  // What is missing may well be there under another spelling.
  const bool misspelt = std::ranges::any_of(extras, [](const std::string& extra) { return extra.starts_with("--"); });
  if (misspelt || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    return unexpected(command, extras.empty() ? app.remaining() : extras) + help;
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing(command) + help;
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) return wrong_count(command, said) + help;
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) return unreadable(command, said);
  return printable(said);  // our own checks (arguments.h), with the option's name before
}

}  // namespace tyndall
