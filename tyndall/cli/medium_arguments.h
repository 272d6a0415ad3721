#pragma once
// How commands are told of media, and at which time.
#include <CLI/CLI.hpp>
#include <string>

#include "tyndall/document/named_medium.h"

namespace tyndall {

/// --time and --allow-path: what every command takes that asks for a medium.
struct MediumArguments {
  double time = 0.0;  // [s]
  bool allow_path = false;
};

/// Both options; add_time() is the first alone.
void add_medium_arguments(CLI::App& command, MediumArguments& arguments);
CLI::Option* add_time(CLI::App& command, double& time);

/// A medium as its file states it, and as it is at the time that was asked for, without keyframes.
struct MediumInTime {
  MediumFile stated, now;
};
MediumInTime in_time(const NamedMedium& medium, const MediumArguments& arguments);

/// The medium of this name (named_medium.h). Throws Fault.
MediumInTime medium_of(const std::string& text, const MediumArguments& arguments);

}  // namespace tyndall
