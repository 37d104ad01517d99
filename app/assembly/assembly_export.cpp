#include "app/assembly/assembly_export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/assembly/assembly_run.hpp"
#include "app/files/design_file.hpp"
#include "app/io/atomic_file.hpp"
#include "app/print/print_report.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

constexpr std::array<std::string_view, 3> mesh_formats = {"stl", "3mf", "glb"};

void refuse_what_makes_sheets(const PrintRequest& request) {
  const auto refuse = [](bool given, const char* option) {
    if (given)
      throw InvalidInput(std::string(option) +
                         " makes sheets; a design of bodies is written as its parts are");
  };
  refuse(!request.hinge.empty(), "--hinge");
  refuse(request.clearance_mm > 0, "--clearance");
  refuse(request.cell_mm > 0, "--cell-mm");
  refuse(!request.bed_mm.empty(), "--bed");
  refuse(request.loose_rods, "--loose-rods");
  refuse(request.caps, "--caps");
  refuse(request.orient != "flat", "--orient");
  refuse(request.slice, "--slice");
  for (const std::string& name : request.formats)
    if (std::find(mesh_formats.begin(), mesh_formats.end(), name) == mesh_formats.end())
      throw InvalidInput("--format: " + targets::in_ticks(name) +
                         " is of sheets; a design of bodies is written as " + targets::joined(mesh_formats));
}

const model::Process& process_called(const std::string& name) {
  if (name.empty()) return model::processes().front();
  std::vector<std::string_view> names;
  for (const model::Process& process : model::processes()) {
    if (process.name == name) return process;
    names.push_back(process.name);
  }
  throw InvalidInput("--process: unknown process " + targets::in_ticks(name) +
                     targets::did_you_mean(name, names) + "; allowed: " + targets::joined(names));
}

/// Corners on the first body's side first, as many as on the other's: each half goes with its body. Corners that no triangle
/// uses fill the shorter one.
model::Polyhedron in_halves(const model::AssemblyHinge& hinge) {
  std::array<std::vector<int>, 2> sides;
  for (int p = 0; p < static_cast<int>(hinge.soft.points.size()); ++p)
    sides[hinge.along.dot(hinge.soft.points[p] - hinge.point) > 0 ? 1 : 0].push_back(p);
  const std::size_t half = std::max(sides[0].size(), sides[1].size());
  model::Polyhedron out;
  std::vector<int> place(hinge.soft.points.size());
  for (const std::vector<int>& side : sides) {
    for (const int p : side) place[p] = out.add_point(hinge.soft.points[p]);
    for (std::size_t k = side.size(); k < half; ++k)
      out.add_point(side.empty() ? hinge.point : hinge.soft.points[side.front()]);
  }
  for (const auto& t : hinge.soft.triangles) out.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return out;
}

model::Polyhedron about(model::Polyhedron solid, const Eigen::Vector3d& origin) {
  for (Eigen::Vector3d& p : solid.points) p -= origin;
  return solid;
}

model::HingePrint print_of(const model::AssemblyHinge& h) {
  model::HingePrint print;
  print.made.kind = h.kind;
  print.made.clearance_mm = h.clearance_mm;
  print.made.gap_mm = print.made.thickness_mm = print.made.height_mm = print.made.diameter_mm =
      1;  // its mesh says
  return print;
}

/// Of print.json: stiffness as the design says it, not as a made hinge has it.
nlohmann::ordered_json said(const PrintJob& job, const AssemblyFile& file) {
  nlohmann::ordered_json out = print_json(job, {});
  const model::HingeStiffness& k = file.assembly.hinges[job.sheet.usual_hinge()].k;
  out["k"] = {{"axial", k.axial}, {"shear", k.shear}, {"along", k.along}, {"turn", k.turn}};
  return out;
}

/// A way that ends before the drive's goal has no folded state; its files say so.
void add_way(const AssemblyRun& run, bool folded, PrintSheet& sheet) {
  for (const NamedState& s : run.states)
    if (s.name == "frame") {
      sheet.path.push_back(s.poses);
      sheet.thetas.push_back(s.theta);
    }
  if (run.motion.reached) return;
  const std::string why = "it does not come to its drive's goal: " + closure_words(run);
  if (folded) throw InvalidInput("--state folded: " + why);
  sheet.warnings.push_back(why);
}

}  // namespace

std::optional<AssemblyFile> assembly_to_export(const PrintRequest& request) {
  if (request.source.empty() || request.coupon) return std::nullopt;
  const targets::Node root = targets::read_document(design_at(request.source), max_design_bytes);
  return is_assembly(root) ? std::optional(read_assembly(root)) : std::nullopt;
}

PrintJob assembly_job(const AssemblyFile& file, const PrintRequest& request) {
  PrintSheet sheet;
  sheet.name = file.name;
  sheet.is_imported = true;
  sheet.process = process_called(request.process);
  const model::Assembly& a = file.assembly;
  const AssemblyRun run = run_assembly(file, Model::exact, std::nullopt, {});
  sheet.linkage = run.linkage;
  for (const model::AssemblyBody& b : a.bodies) sheet.meshes.push_back(about(b.solid, b.position));
  for (const model::AssemblyHinge& h : a.hinges) {
    sheet.hinges.push_back(print_of(h));
    sheet.soft.push_back(h.soft.points.empty() ? model::Polyhedron{}
                                               : about(in_halves(h), a.bodies[h.lower].position));
  }
  sheet.bodies.resize(a.bodies.size());
  sheet.rods.resize(a.hinges.size());
  sheet.tiles.of_body.assign(a.bodies.size(), 0);
  add_way(run, request.folded, sheet);
  sheet.warnings.push_back("parts are written as they were imported: nothing was checked for a process");
  return {std::move(sheet), request.folded};
}

int export_assembly(const CommandOptions& options, const PrintRequest& request, const AssemblyFile& file) {
  refuse_what_makes_sheets(request);
  const PrintJob job = assembly_job(file, request);
  for (const std::string& format : request.formats)
    if (const auto load = print_format(format).load) load();
  OutputFolder folder(options.folder_of(file.name, "_print"));
  FileSet files(folder.path());
  std::vector<std::string> names;
  for (const std::string& format : request.formats)
    for (const NamedContent& content : print_format(format).write(job)) {
      files.add(content.name, content.content);
      names.push_back(content.name);
    }
  const std::string json = said(job, file).dump(1) + "\n";
  files.add("print.json", json);
  names.emplace_back("print.json");
  files.commit();
  folder.keep();
  std::string text =
      fmt::format("{}\n  {:<10} {}: {}\n", file.name, "written", folder.path(), fmt::join(names, ", "));
  for (const std::string& warning : print_warnings(job))
    text += fmt::format("  {:<10} {}\n", "note", warning);
  std::cout << (options.json ? json : text);
  return done;
}

}  // namespace kinetix::app
