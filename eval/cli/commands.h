#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace dressform {

// A command adds itself to the program and returns what runs when it is chosen: a function that gives the exit code.
using Command = std::function<int()>;

Command add_run_command(CLI::App& app);
Command add_synthesize_command(CLI::App& app);
Command add_import_command(CLI::App& app);
Command add_inspect_command(CLI::App& app);
Command add_reconstruct_command(CLI::App& app);
Command add_calibrate_command(CLI::App& app);
Command add_render_command(CLI::App& app);
Command add_score_command(CLI::App& app);
Command add_report_command(CLI::App& app);
Command add_variants_command(CLI::App& app);
Command add_gate_command(CLI::App& app);

}  // namespace dressform
