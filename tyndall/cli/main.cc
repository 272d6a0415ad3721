// The program tyndall. Exit codes: 0 done, 1 something went wrong inside or while writing, 2 the request or a file in
// it cannot be used (nothing has been written then), 128 + n stopped by signal n after writing what there was.
#include <fcntl.h>
#include <unistd.h>

#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "tyndall/cli/commands.h"
#include "tyndall/cli/request_message.h"
#include "tyndall/document/fault.h"

namespace tyndall {
namespace {

constexpr int internal_failure = 1, unusable_request = 2;

using AddCommand = void (*)(CLI::App&);
constexpr AddCommand commands[] = {
#include "command_list.inc"
};

/// Where the caller closed a standard stream, the next file opened would take its number, and a message would go into
/// it. Opened for the wrong direction, it still fails as a closed one does.
void occupy_standard_streams() {
  for (int stream = 0; stream < 3; ++stream) {
    if (::fcntl(stream, F_GETFD) == -1) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

int complain(int code, const std::string& message) {
  std::cerr << "tyndall: " << message << '\n';
  return code;
}

int run(int argc, char** argv) {
  CLI::App app{"Tyndall designs the air of a picture: haze, fog, smoke, dust, clear air.", "tyndall"};
  app.footer("tyndall COMMAND --help explains a command and gives an example.");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  for (const AddCommand add : commands) add(app);
  if (argc < 2) {
    std::cerr << app.help();
    return unusable_request;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
  } catch (const CLI::RuntimeError& ended) {  // a command that chose its exit code, having said what there is to say
    return ended.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return complain(unusable_request, request_message(error, app, argc, argv));
  }
  if (!std::cout.flush()) return complain(internal_failure, "the output could not be written");
  return 0;
}

}  // namespace
}  // namespace tyndall

int main(int argc, char** argv) {
  using namespace tyndall;
  occupy_standard_streams();
  try {
    return run(argc, argv);
  } catch (const Fault& fault) {
    return complain(unusable_request, fault.what());
  } catch (const std::bad_alloc&) {
    return complain(internal_failure, "not enough memory");
  } catch (const std::exception& error) {
    return complain(internal_failure, error.what());
  }
}
