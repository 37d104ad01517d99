#include "app/print/sheet/print_sheet.hpp"

#include <fmt/format.h>

#include "app/files/cuts_section.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/sheet/fold_motion.hpp"
#include "model/assembly/assembly.hpp"

namespace kinetix::app {
namespace {

using model::HingeKind;

constexpr double widest_turn = 2.8;  // rad: at half a turn corners meet however long the gap

model::Lattice resized(model::Lattice sheet, const PrintChoice& choice, const model::Process& process) {
  if (auto* squares = sheet.squares()) squares->size = resized(squares->size, choice, process);
  if (auto* block = sheet.sodalite()) block->size = resized(block->size, choice, process);
  if (auto* planar = sheet.planar()) planar->size = resized(planar->size, choice, process);
  return sheet;
}

/// Returns the turn of a hinge's upper body against the lower one about the axis, from flat to a state, rad.
double turn_of(const model::RestHinge& hinge, const model::State& state) {
  const Eigen::Matrix3d turn = state[hinge.lower].R.transpose() * state[hinge.upper].R;
  const Eigen::Vector3d twice_sine(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  return std::copysign(std::atan2(twice_sine.norm(), turn.trace() - 1), twice_sine.dot(hinge.axis));
}

void check_process(const model::Process& process, const model::CellSize& size,
                   const model::ManufacturedHinge& hinge) {
  const auto problems = print_problems(process, size, hinge);
  if (!problems.empty()) throw InvalidInput(problems.front().what);
}

/// Checks that an eye is at least as high as one clearance. It has half of what two clearances leave of a pin's
/// height.
void check_eye(const model::HingePrint& pin) {
  const double eye = pin.made.height_mm / 2 - pin.axial_clearance_mm;
  if (!is_pin(pin.made.kind) || eye >= pin.axial_clearance_mm) return;
  throw InvalidInput(
      fmt::format("a pin {:.3g} mm high has no room for an eye between two clearances of {:g} mm: its wall "
                  "must be higher",
                  pin.made.height_mm, pin.axial_clearance_mm));
}

class SheetMaker {
 public:
  SheetMaker(const Design& design, const PrintPath& path, const model::Process& process,
             const PrintChoice& choice)
      : design_(design), choice_(choice), structure_(resized(design.structure, choice, process)) {
    sheet_.name = design.name;
    sheet_.process = process;
    if (choice.clearance_mm > 0) sheet_.process.clearance_mm = choice.clearance_mm;
    sheet_.linkage = structure_;
    sheet_.path = with_edge(path.states, structure_.size().edge_mm);
    sheet_.thetas = path.thetas;
    if (path.motion)
      sheet_.motion = [at = path.motion, edge = structure_.size().edge_mm](double theta) {
        return with_edge({at(theta)}, edge).front();
      };
    sheet_.turns = path.turns;
    sheet_.jumps = path.jumps;
    sheet_.is_path_exact = path.is_exact;
    sheet_.no_path_reason = path.flat_only_reason;
    for (int h = 0; h < hinges(); ++h) turns_.push_back(largest_turn(h));
  }

  PrintSheet made() && {
    if (sheet_.linkage.hinges.empty())
      throw InvalidInput("the design has no hinges: there is nothing to fold, and nothing to print");
    sheet_.tiles.of_body.assign(sheet_.linkage.bodies.size(), 0);
    make_whole();
    if (!choice_.bed_mm) return std::move(sheet_);
    sheet_.tiles = cut_into_tiles(boxes(), *choice_.bed_mm);
    check_one_piece();
    if (sheet_.tiles.count() > 1) make_whole();  // rods between two tiles are loose
    return std::move(sheet_);
  }

 private:
  void make_whole() {
    choose_hinges();
    if (choice_.caps && !is_pin(sheet_.kind()))
      throw InvalidInput("round caps only apply to pins, and the design has other hinges");
    make_solids(sheet_);
  }

  /// Checks that a sheet that is cut in one piece is on one bed.
  void check_one_piece() const {
    if (!sheet_.process.cuts_sheets() || sheet_.tiles.count() < 2) return;
    const Eigen::Vector2d& bed = *choice_.bed_mm;
    throw BedTooSmall(fmt::format(
        "{} cuts the sheet in one piece, and a bed of {:g} x {:g} mm does not hold it: make it of "
        "fewer or smaller cells",
        sheet_.process.name, bed.x(), bed.y()));
  }

  /// Returns the boxes of the flat bodies from above, each with the soft parts that are printed with it (tile_parts),
  /// mm.
  std::vector<Eigen::AlignedBox2d> boxes() const {
    const model::State& flat = sheet_.path.front();
    std::vector<Eigen::AlignedBox2d> all(sheet_.meshes.size());
    const auto add = [&](const model::Polyhedron& solid, int body) {
      for (const Eigen::Vector3d& p : solid.points) all[body].extend(p.head<2>());
    };
    for (int b = 0; b < static_cast<int>(all.size()); ++b) add(placed_body(sheet_, flat, b), b);
    for (int h = 0; h < hinges(); ++h)
      if (!sheet_.soft[h].points.empty()) add(placed_soft(sheet_, flat, h), sheet_.linkage.hinges[h].lower);
    return all;
  }

  bool is_loose(int h, const model::ManufacturedHinge& made) const {
    const model::RestHinge& hinge = sheet_.linkage.hinges[h];
    const std::vector<int>& tile = sheet_.tiles.of_body;
    if (made.kind == HingeKind::rod) return true;
    return made.kind == HingeKind::pin && (choice_.loose_rods || tile[hinge.lower] != tile[hinge.upper]);
  }

  int hinges() const { return static_cast<int>(sheet_.linkage.hinges.size()); }

  /// Returns the largest turn along the path, rad: in an equilibrium hinges may turn back before its end.
  double largest_turn(int hinge) const {
    double most = 0;
    for (const model::State& state : sheet_.path)
      if (const double turn = turn_of(sheet_.linkage.hinges[hinge], state); std::abs(turn) > std::abs(most))
        most = turn;
    return most;
  }

  /// Returns the largest stretch along the path of a soft hinge of this height, mm; 0 along an exact motion.
  double stretch_mm(int h, double height_mm) const {
    if (sheet_.is_path_exact) return 0;
    double most = 0;
    for (const model::State& state : sheet_.path)
      most = std::max(most, edge_stretch_mm(sheet_.linkage, state, h, height_mm));
    return most;
  }

  /// Returns the gap that an elastomer or living hinge needs, mm.
  double gap_mm(const model::ManufacturedHinge& hinge, int h) const {
    const model::CellSize& size = sheet_.linkage.size;
    const double offset = structure_.hinge(h).offset * size.edge_mm;
    return open_gap_mm(hinge, size.thickness_mm, offset, turns_[h], stretch_mm(h, hinge.height_mm));
  }

  /// Returns the largest offset of an axis from the middle of its wall, mm.
  double largest_offset_mm() const {
    double most = 0;
    for (int h = 0; h < hinges(); ++h) most = std::max(most, std::abs(structure_.hinge(h).offset));
    return most * sheet_.linkage.size.edge_mm;
  }

  std::vector<model::ManufacturedHinge> open_hinges() const {
    model::ManufacturedHinge open = open_hinge(choice_.kind, sheet_.process, sheet_.linkage.size);
    if (is_pin(choice_.kind)) open.height_mm *= choice_.height_share;
    std::vector<model::ManufacturedHinge> all(hinges(), open);
    if (is_pin(choice_.kind)) return all;
    double longest = 0;
    for (int h = 0; h < hinges(); ++h) longest = std::max(longest, all[h].gap_mm = gap_mm(all[h], h));
    if (choice_.alike)
      for (model::ManufacturedHinge& hinge : all) hinge.gap_mm = longest;
    return all;
  }

  void choose_hinges() {
    const std::vector<model::ManufacturedHinge> open = open_hinges();
    const double furthest_mm = largest_offset_mm();
    sheet_.hinges.clear();
    for (int h = 0; h < hinges(); ++h) {
      model::ManufacturedHinge made =
          hinge_at(design_.hinge, design_.hinge_overrides, h).made.value_or(open[h]);
      if (sheet_.process.cuts_sheets()) made = fitted(made, design_.structure.size(), sheet_.linkage.size);
      check_process(sheet_.process, sheet_.linkage.size, made);
      validate(made, sheet_.linkage.size);
      sheet_.hinges.push_back(with_faces({.made = made,
                                          .knuckle_wall_mm = sheet_.process.min_wall_mm,
                                          .min_gap_mm = sheet_.process.clearance_mm,
                                          .turn = std::clamp(turns_[h], -widest_turn, widest_turn),
                                          .loose = is_loose(h, made),
                                          .cap_across_mm = choice_.caps || made.caps ? furthest_mm : 0},
                                         sheet_.process));
      check_eye(sheet_.hinges.back());
    }
  }

  const Design& design_;
  const PrintChoice choice_;
  const model::Lattice structure_;
  PrintSheet sheet_;
  std::vector<double> turns_;  // of each hinge, the largest along the path, rad
};

}  // namespace

std::optional<Eigen::Vector2d> requested_bed(const model::Process& process) {
  if (!process.is_bed_given) return std::nullopt;
  return Eigen::Vector2d(process.bed_mm[0], process.bed_mm[1]);
}

model::CellSize resized(const model::CellSize& size, const PrintChoice& choice,
                        const model::Process& process) {
  const double height_mm = process.cuts_sheets() ? process.sheet_mm : size.height_mm;
  if (!(choice.edge_mm > 0)) return {size.edge_mm, size.thickness_mm, height_mm};
  const double clearance = choice.clearance_mm > 0 ? choice.clearance_mm : process.clearance_mm;
  const bool has_rods = choice.kind == HingeKind::rod || choice.loose_rods;
  const double min_height = is_pin(choice.kind) ? min_pin_height_mm(clearance, process, has_rods) : 0;
  return {choice.edge_mm, std::max(size.thickness_mm, process.min_wall_mm), std::max(height_mm, min_height)};
}

bool PrintSheet::has_soft() const {
  return std::any_of(soft.begin(), soft.end(),
                     [](const model::Polyhedron& part) { return !part.points.empty(); });
}

bool PrintSheet::has_caps() const {
  return std::any_of(hinges.begin(), hinges.end(),
                     [](const model::HingePrint& h) { return h.cap_across_mm > 0; });
}

bool PrintSheet::is_one_material() const {
  return has_soft() && !process.film.empty() &&
         std::none_of(hinges.begin(), hinges.end(),
                      [](const model::HingePrint& h) { return h.made.kind == HingeKind::block; });
}

int PrintSheet::loose_rods() const {
  return static_cast<int>(std::count_if(rods.begin(), rods.end(),
                                        [](const model::Polyhedron& rod) { return !rod.points.empty(); }));
}

model::Polyhedron PrintSheet::with_rods(int body) const {
  model::Polyhedron all = meshes[body];
  for (std::size_t h = 0; h < rods.size(); ++h)
    if (linkage.hinges[h].lower == body && !rods[h].points.empty()) append(rods[h], all);
  return all;
}

HingeKind PrintSheet::kind() const {
  const auto of = [&](HingeKind kind) {
    return std::count_if(hinges.begin(), hinges.end(),
                         [&](const model::HingePrint& h) { return h.made.kind == kind; });
  };
  return std::max({HingeKind::pin, HingeKind::rod, HingeKind::block, HingeKind::film},
                  [&](HingeKind a, HingeKind b) { return of(a) < of(b); });
}

int PrintSheet::most_frequent_hinge() const {
  const auto first = std::find_if(hinges.begin(), hinges.end(), [most = kind()](const model::HingePrint& h) {
    return h.made.kind == most;
  });
  return static_cast<int>(first - hinges.begin());
}

void make_solids(PrintSheet& sheet) {
  sheet.meshes.clear();
  sheet.rods.clear();
  sheet.soft.clear();
  sheet.bodies = body_solids(
      sheet.linkage, [&](int h) -> const model::HingePrint& { return sheet.hinges[h]; }, sheet.posts);
  for (const model::BodySolid& body : sheet.bodies)
    sheet.meshes.push_back(body.arms.empty() ? model::Polyhedron{} : body_mesh(body));
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h)
    sheet.rods.push_back(sheet.hinges[h].loose ? rod_solid(sheet.linkage, h, sheet.hinges[h])
                                               : model::Polyhedron{});
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h)
    sheet.soft.push_back(is_pin(sheet.hinges[h].made.kind) ? model::Polyhedron{}
                                                           : soft_solid(sheet.linkage, h, sheet.hinges[h]));
}

PrintSheet make_print_sheet(const Design& design, const PrintPath& path, const model::Process& process,
                            const PrintChoice& choice) {
  return SheetMaker(design, path, process, choice).made();
}

model::Polyhedron placed(model::Polyhedron mesh, const model::Pose& pose) {
  for (Eigen::Vector3d& p : mesh.points) p = pose.R * p + pose.p;
  return mesh;
}

model::Polyhedron placed_body(const PrintSheet& sheet, const model::State& state, int body) {
  return placed(sheet.with_rods(body), state[body]);
}

model::Polyhedron placed_soft(const PrintSheet& sheet, const model::State& state, int hinge) {
  const model::RestHinge& rest = sheet.linkage.hinges[hinge];
  const Eigen::Vector3d between =
      sheet.linkage.rest_position(rest.lower) - sheet.linkage.rest_position(rest.upper);
  model::Polyhedron out = sheet.soft[hinge];
  const std::size_t half = out.points.size() / 2;
  for (std::size_t k = 0; k < out.points.size(); ++k) {
    const model::Pose& pose = state[k < half ? rest.lower : rest.upper];
    const Eigen::Vector3d p = k < half ? out.points[k] : Eigen::Vector3d(out.points[k] + between);
    out.points[k] = pose.R * p + pose.p;
  }
  return out;
}

namespace {

/// Sorts the corners of a soft part: first those on the first body's side, then as many on the other's. Each half
/// moves with its body. Corners that no triangle uses fill the shorter half.
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

/// Returns the hinges of a sheet with cuts, and warns of bridges that may break off.
std::vector<model::HingePrint> prints_of_cuts(const targets::CutSheet& cuts, const model::Process& process,
                                              std::vector<std::string>& warnings) {
  std::vector<model::HingePrint> out(cuts.joints.size());
  std::size_t narrow = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].made = joint_hinge(cuts.joints[k], process);
    if (!cuts.joints[k].is_crease && out[k].made.thickness_mm < process.min_film_mm) ++narrow;
  }
  if (narrow > 0)
    warnings.push_back(
        fmt::format("{} of {} bridges are narrower than {:g} mm after the cut and may break off", narrow,
                    out.size(), process.min_film_mm));
  return out;
}

model::HingePrint print_of(const model::AssemblyHinge& h) {
  model::HingePrint print;
  print.made.kind = h.kind;
  print.made.clearance_mm = h.clearance_mm;
  print.made.gap_mm = print.made.thickness_mm = print.made.height_mm = print.made.diameter_mm =
      1;  // the mesh has the sizes
  return print;
}

/// Adds the motion to a sheet. A motion that ends before the drive's goal has no folded state, which a warning
/// reports.
/// @throws InvalidInput in this case if the folded state is requested
void add_path_of_run(const Run& run, bool folded, PrintSheet& sheet) {
  for (const NamedState& s : run.states)
    if (s.name == "frame") {
      sheet.path.push_back(s.poses);
      sheet.thetas.push_back(s.theta);
    }
  if (run.closed_path->reached) return;
  const std::string why = "it does not reach the goal of its drive: " + run.closed_path->description;
  if (folded) throw InvalidInput("--state folded: " + why);
  sheet.warnings.push_back(why);
}

}  // namespace

PrintSheet imported_sheet(const Design& design, const model::Process& process, bool folded) {
  PrintSheet sheet;
  sheet.name = design.name;
  sheet.process = process;
  sheet.linkage = design.structure;
  const model::Assembly& a = *design.structure.assembly();
  for (const model::AssemblyBody& b : a.bodies) sheet.meshes.push_back(about(b.solid, b.position));
  for (const model::AssemblyHinge& h : a.hinges) {
    sheet.hinges.push_back(print_of(h));
    sheet.imported_k.push_back(h.k);
    sheet.soft.push_back(h.soft.points.empty() ? model::Polyhedron{}
                                               : about(in_halves(h), a.bodies[h.lower].position));
  }
  sheet.bodies.resize(a.bodies.size());
  sheet.rods.resize(a.hinges.size());
  sheet.tiles.of_body.assign(a.bodies.size(), 0);
  add_path_of_run(run_design(design, Model::exact, {}), folded, sheet);
  sheet.cuts = design.cuts;
  if (design.cuts)
    sheet.hinges = prints_of_cuts(*design.cuts, design.process, sheet.warnings);
  else
    sheet.warnings.push_back("parts are written as they were imported: nothing was checked for a process");
  return sheet;
}

}  // namespace kinetix::app
