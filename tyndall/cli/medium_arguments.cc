#include "tyndall/cli/medium_arguments.h"

#include "tyndall/cli/arguments.h"

namespace tyndall {

CLI::Option* add_time(CLI::App& command, double& time) {
  return command
      .add_option("--time", time, "Seconds: when, for media with keyframes and noise in the wind (default 0)")
      ->type_name("T")
      ->check(number_within(-1e9, 1e9));
}

void add_medium_arguments(CLI::App& command, MediumArguments& arguments) {
  add_time(command, arguments.time);
  add_allow_path(command, arguments.allow_path);
}

MediumInTime in_time(const NamedMedium& medium, const MediumArguments& arguments) {
  return {medium.file, at_time(medium.file, arguments.time, medium.name)};
}

MediumInTime medium_of(const std::string& text, const MediumArguments& arguments) {
  return in_time(read_named_medium(text, arguments.allow_path), arguments);
}

}  // namespace tyndall
