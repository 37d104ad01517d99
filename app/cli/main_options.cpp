#include "app/cli/main_options.hpp"

#include <fmt/format.h>
#include <cmath>
#include <utility>

#include "app/print/fit.hpp"
#include "model/material/process.hpp"

namespace kinetix::app {
namespace {

/// Returns a check that a number is in a range. CLI::Range accepts text that is not a number.
CLI::Validator within(double least, double most) {
  const auto problem = [=](std::string& text) {
    double value = NAN;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    return is_number && value >= least && value <= most
               ? std::string()
               : fmt::format("{} is not a number from {:g} to {:g}", text, least, most);
  };
  return {problem, ""};
}

void add_common(CLI::App& app, CommandOptions& options) {
  app.add_flag("--json", options.json, "print the whole result as one JSON document on stdout");
  app.add_flag("-v,--verbose", options.verbose, "print all results instead of a summary of seven lines");
  app.add_flag("--quiet", options.quiet, "print no progress on stderr");
  app.add_option("--threads", options.threads,
                 "number of threads; 0 (default): all cores. The result does not depend on it")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  app.add_option_function<std::uint64_t>(
         "--seed",
         [&options](const std::uint64_t& seed) {
           options.seed = seed;
           options.seed_given = true;
         },
         "seed of random starts and samples, at most 9e15. The same seed gives the same result")
      ->check(CLI::Range(0.0, 9e15))
      ->type_name("N");
}

void add_output(CLI::App& app, CommandOptions& options, const std::string& meaning) {
  app.add_option_function<std::string>(
         "-o",
         [&options](const std::string& folder) {
           options.folder = folder;
           options.folder_given = true;
         },
         meaning)
      ->type_name("DIR");
}

void add_open(CLI::App& app, CommandOptions& options) {
  app.add_flag("--open", options.open, "open the report in the browser");
}

void add_time_limit(CLI::App& app, CommandOptions& options, const std::string& kept) {
  app.add_option("--time-limit", options.time_limit_s,
                 "stop after this time and keep " + kept + ", like the first Ctrl-C")
      ->type_name("SECONDS")
      ->check(within(1e-3, 1e9));
}

void add_fidelity(CLI::App& app, CommandOptions& options) {
  app.add_flag("--fidelity", options.fidelity,
               "repeat the simulation with coarser time steps and report accuracy against run time");
}

constexpr const char* results_folder =
    "folder for result.json, design.yaml and report.html (default: results/NAME; for a design with "
    "_verified, "
    "_exact, _equilibrium or _bullet after the name)";

void add_file(CLI::App& app, CommandOptions& options, const std::string& name, const std::string& meaning) {
  app.add_option(name, options.file, meaning)->required()->type_name("");
}

std::vector<std::string> process_names() {
  std::vector<std::string> names;
  for (const model::Process& process : model::processes()) names.push_back(process.name);
  return names;
}

/// Adds the options that replace keys of the file: process, hinges, bed and lock.
void add_replacements(CLI::App& app, CommandOptions& options) {
  const auto add = [&](const char* name, const char* key, std::string form, const char* meaning) {
    return app.add_option_function<std::string>(
        name,
        [&options, key, form = std::move(form)](const std::string& value) {
          options.changes.emplace_back(key, fmt::format(fmt::runtime(form), value));
        },
        meaning);
  };
  add("--process", "process", "{}", "polyjet, fdm, sla, sls or laser; replaces the file's process")
      ->type_name("NAME")
      ->check(CLI::IsMember(process_names()));
  add("--hinge", "hinge", "{{kind: {}}}",
      "pin, block, film or rod; replaces the file's hinges. Sizes follow from the process")
      ->type_name("KIND")
      ->check(CLI::IsMember({"pin", "block", "film", "rod"}));
  add("--bed", "bed_mm", "[{}]", "bed of your printer. A larger sheet is cut into tiles")->type_name("MM,MM");
  add("--lock", "lock", "{}", "clip, strap or none: part that keeps the sheet folded")
      ->type_name("KIND")
      ->check(CLI::IsMember({"clip", "strap", "none"}));
}

void add_export(CLI::App& app, CommandOptions& options, PrintRequest& request) {
  app.add_option("DESIGN.yaml|DIR", request.source, "a design, or the folder of a result")->type_name("");
  add_common(app, options);
  add_output(app, options, "folder for the files (default: results/NAME_print)");
  app.add_option("--format", request.formats,
                 format_help() + ". Default with --coupon: 3mf, or dxf,svg for laser")
      ->delimiter(',')
      ->allow_extra_args(false)  // the design may follow it
      ->type_name("NAME,...");
  app.add_option("--process", request.process,
                 "polyjet, fdm, sla, sls or laser: its limits are checked (default: the design's)")
      ->type_name("NAME");
  app.add_option("--hinge", request.hinge,
                 "pin, block, film or rod (a wire pushed in), for open hinges and for hinges computed as "
                 "joints (default: the design's, else the first kind of the process that fits)")
      ->type_name("KIND");
  app.add_option(
         "--clearance", request.clearance_mm,
         "pin clearance per side. Use the smallest gap on your test coupon that turned freely (default: "
         "the process's)")
      ->type_name("MM")
      ->check(within(0.01, 10.0));
  app.add_option(
         "--cell-mm", request.cell_mm,
         "cell edge of the print instead of the design's. Walls keep their thickness and height, within "
         "the limits of the process")
      ->type_name("MM")
      ->check(within(0.1, 1e4));
  app.add_option("--bed", request.bed_mm,
                 "bed of your printer. A larger sheet is cut into tiles that join by hinges")
      ->expected(2)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("MM,MM")
      ->check(within(1.0, 1e5));
  app.add_option("--lock", request.lock,
                 "clip, strap or none: part that keeps the sheet folded (default: the design's)")
      ->type_name("KIND");
  app.add_flag("--loose-rods", request.loose_rods, "make rods of pins separate parts, to be pushed in");
  app.add_flag("--round-caps,--caps", request.caps,
               "give all pins identical round caps, which hides where the hinge axes are (earlier: --caps)");
  app.add_option("--orient", request.orient,
                 "orientation of stl, 3mf and step: flat (default), over (the other side up) or best (least "
                 "overhang)")
      ->type_name("NAME");
  app.add_option("--slicer", request.slicer,
                 "prusa, orca, bambu or cura: slicer for the 3mf file (default: one file for all)")
      ->type_name("NAME");
  app.add_flag("--slice", request.slice, "run PrusaSlicer for print time and material, with fdm and sla");
  app.add_flag(
      "--coupon", request.coupon,
      "write a test coupon instead of a design: pins with gaps of 0.1 to 0.6 mm, or for laser bridges "
      "of 0.4 to 1.6 mm. Use the smallest gap that turns, or the narrowest bridge that stays");
  app.add_option_function<std::string>(
         "--state", [&request](const std::string& state) { request.folded = state == "folded"; },
         "flat (default, as printed) or folded")
      ->type_name("NAME")
      ->check(CLI::IsMember({"flat", "folded"}));
}

void add_import(CLI::App& app, CommandOptions& options, ImportRequest& request) {
  app.add_option("MODEL", request.model,
                 "a 3MF, STEP, GLB, OBJ, OFF, PLY or STL file with hard and soft parts. Tiles: a folder with "
                 "vertices.txt and constraints.txt, or an OBJ file")
      ->type_name("");
  add_common(app, options);
  add_output(app, options, "folder for design.yaml and its part files (default: results/NAME)");
  app.add_option("--hard", request.hard, "file of the hard parts, instead of MODEL")->type_name("FILE");
  app.add_option("--soft", request.soft, "file of the soft parts, with --hard")->type_name("FILE");
  app.add_option(
         "--unit", request.unit,
         "mm, cm, m, in or ft: unit of the model's numbers (default: the file's, else inferred from its "
         "size)")
      ->type_name("UNIT");
  app.add_option(
         "--soft-material", request.soft_material,
         "name of the material, colour or part that is soft, or none (default: recognised by words such as "
         "soft, tpu, tango)")
      ->type_name("NAME");
  app.add_option("--material", request.material,
                 "tango (default), tpu95a, pp, pa12, acrylic or steel: material of the soft parts, for their "
                 "stiffness")
      ->type_name("NAME");
  app.add_option("--hinges", request.hinges,
                 "YAML file with the axes of hinges whose shape does not determine them")
      ->type_name("FILE");
  app.add_option("--tile-mm", request.tile_mm, "median edge of tiles (default: 20)")->type_name("MM");
  app.add_option("--thickness-mm", request.thickness_mm,
                 "thickness of the sheet of tiles (default: a twentieth of the median edge)")
      ->type_name("MM");
  app.add_option("--kerf-mm", request.kerf_mm,
                 "width of the cuts between tiles (default: 0.03 of the median edge)")
      ->type_name("MM");
}

void add_view(CLI::App& app, CommandOptions& options, ViewRequest& request) {
  app.add_option("DIR|DESIGN.yaml|TARGET.yaml", request.source,
                 "the folder of a result, a design, or a target to search for (default: a template)")
      ->type_name("");
  add_common(app, options);
  add_replacements(app, options);
  app.add_flag_callback(
      "--no-open", [&request] { request.opens_browser = false; },
      "print the address and do not open a browser");
  app.add_option("--port", request.port, "port of 127.0.0.1; 0 (default): any free port")
      ->type_name("PORT")
      ->check(CLI::Range(0, 65535));
}

void add_search(CLI::App& app, CommandOptions& options) {
  add_common(app, options);
  add_output(app, options, results_folder);
  add_open(app, options);
  add_replacements(app, options);
  app.add_flag_callback(
      "--no-verify", [&options] { options.verify = false; }, "skip the simulation");
  add_time_limit(app, options, "the best design so far");
  add_fidelity(app, options);
  app.add_option("--monte-carlo", options.prints,
                 "simulate N prints with random errors to confirm the tolerance estimate")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  app.add_option("TARGET.yaml", options.file, "the goal, the sheet and the ranges of the search")
      ->type_name("");
}

void add_simulate(CLI::App& app, CommandLine& line) {
  app.add_option(
         "--model", line.options.model,
         "exact (default): analytic motion; equilibrium: elastic hinges; rigid_body (earlier: bullet): "
         "simulation")
      ->type_name("NAME")
      ->check(CLI::IsMember({"exact", "equilibrium", "rigid_body", "bullet"}));
  add_time_limit(app, line.options, "the motion so far, or with --drives the drives so far");
  app.add_option_function<double>(
         "--fold-angle-deg,--theta-deg",
         [&line](const double& angle) {
           line.options.theta_deg = angle;
           line.options.theta_given = true;
         },
         "fold angle instead of that of the design and its drive (earlier: --theta-deg)")
      ->type_name("DEG")
      ->check(within(-89.0, 89.0));
  app.add_flag(
      "--drives", line.options.drives,
      "compare plates, single hinges and tendons at the same fold angle, and print which needs the least "
      "force. Needs --model equilibrium. Writes drives.json into -o DIR");
}

void add_sweep(CLI::App& app, CommandLine& line) {
  add_file(app, line.options, "DOE.yaml", "the sweep: base, factors, method and responses");
  add_common(app, line.options);
  add_replacements(app, line.options);
  add_output(app, line.options, "folder for the table and report.html (default: results/NAME)");
  add_open(app, line.options);
  app.add_flag("--resume", line.options.resume, "continue the sweep whose table is in DIR");
  app.add_option("--share", line.share,
                 "compute only the K-th of N equal parts, into DIR/share-K-of-N. A later run without it "
                 "collects the shares, computes the rest and writes the table")
      ->type_name("K/N");
}

CLI::App& add_command(CLI::App& app, const char* name, const char* meaning) {
  CLI::App& command = *app.add_subcommand(name, meaning);
  command.footer(help_footer(name));
  return command;
}

}  // namespace

void add_options(CLI::App& app, CommandLine& line) {
  app.footer(help_footer(""));
  app.require_subcommand(0, 1);
  app.formatter(std::make_shared<HelpFormatter>(help_width()));
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("{} (see --help)\n", error.what());
  });
  add_search(app, line.options);
  for (const auto& [name, meaning] :
       {std::pair("verify", "simulate a design and compare the result with the model"),
        std::pair("simulate", "compute one folded state of a design"),
        std::pair("check", "validate a file and print expected size, run time and memory")}) {
    const bool checks = std::string_view(name) == "check";
    CLI::App& command = add_command(app, name, meaning);
    add_file(command, line.options, checks ? "FILE.yaml|DIR" : "DESIGN.yaml|DIR",
             checks ? "a target, a design or a sweep, or the folder of a result"
                    : "a design, or the folder of a result");
    add_common(command, line.options);
    add_replacements(command, line.options);
    if (checks)
      command
          .add_option("--picture", line.options.picture,
                      "SVG file that shows what was understood, with the fault marked in a refused drawing")
          ->type_name("OUT.svg");
    if (checks) continue;
    add_output(command, line.options, results_folder);
    add_open(command, line.options);
  }
  add_fidelity(*app.get_subcommand("verify"), line.options);
  add_simulate(*app.get_subcommand("simulate"), line);
  add_sweep(add_command(app, "sweep", "run a design of experiments, also under mpirun"), line);
  add_export(add_command(app, "export", "write a design for printers, CAD and simulators"), line.options,
             line.print);
  add_import(add_command(app, "import", "turn a 3D model with hard and soft parts into a design"),
             line.options, line.model);
  add_view(add_command(app, "view", "open the studio in the browser: press, drag, change, search, export"),
           line.options, line.view);
}

}  // namespace kinetix::app
