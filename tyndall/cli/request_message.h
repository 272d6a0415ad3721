#pragma once
// What is said of a request that the command line's parser could not make sense of.
#include <CLI/CLI.hpp>
#include <string>

namespace tyndall {

/// "slab: found the unknown option "--thicknes", expected one of ... (did you mean "--thickness"?)": the same
/// kind of sentence that a Fault is (document/fault.h), in place of the parser's own. `app` is as the parser left it.
std::string request_message(const CLI::ParseError& error, const CLI::App& app, int argc, const char* const* argv);

}  // namespace tyndall
