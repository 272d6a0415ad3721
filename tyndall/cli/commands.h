#pragma once
// The program's commands: each adds itself to the command line. A new one is a file, a line here and a line in
// CMakeLists.txt.
#include <CLI/CLI.hpp>

namespace tyndall {

void add_blend(CLI::App& app);
void add_phase(CLI::App& app);
void add_plot(CLI::App& app);
void add_presets(CLI::App& app);
void add_probe(CLI::App& app);
void add_render(CLI::App& app);
void add_schema(CLI::App& app);
void add_show(CLI::App& app);
void add_slab(CLI::App& app);

}  // namespace tyndall
