#include "app/pipeline/print_tolerance.hpp"

#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/physics.hpp"
#include "app/run/design_hinges.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/solids/hinge_shape.hpp"

namespace kinetix::app {
namespace {

constexpr int min_prints = 20;                // sample prints in any case
constexpr int more_prints = 100;              // used if the first ones leave the first-order error uncertain
constexpr double largest_ratio_error = 0.04;  // ratio: standard error, near the 0.05 of PrintedGoal
constexpr int max_bodies_for_more = 150,
              max_bodies_to_confirm = 400;  // above these, sample prints take longer than the search
// Cell edges, rms: an equilibrium further from the state of the design is a different one.
constexpr double near_design = 2;
constexpr double across_the_plane = 1e-9;  // of a unit normal: less is rounding
constexpr double one_length = 1e-9;        // of a cell edge: walls of equal length differ by rounding

/// @param wall_mm length of the wall
model::HingeScatter hinge_scatter(const Design& design, const model::ClearanceScatter& play, double wall_mm) {
  model::HingeScatter scatter;
  scatter.t = std::hypot(design.process.sd.t_mm, play.place_mm) / wall_mm;
  scatter.alpha = play.tilt;  // a rod leans along its wall as far as across it
  scatter.beta = std::hypot(design.process.sd.tilt_deg * radians_per_degree, play.tilt);
  scatter.offset = play.place_mm / design.structure.size().edge_mm;
  return scatter;
}

std::vector<double> wall_lengths_mm(const model::Lattice& sheet) {
  std::vector<double> out;
  for (int h = 0; h < sheet.hinges(); ++h) {
    const model::HingedWall wall = sheet.wall(h);
    out.push_back((sheet.rest_position(wall.upper) - sheet.rest_position(wall.lower)).norm());
  }
  return out;
}

/// @param with_play of pins
model::HingeScatter scatter_with(const Design& design, bool with_play) {
  const auto of = [&](const HingeSection& hinge, double wall_mm) {
    const bool plays = with_play && hinge.made;
    return hinge_scatter(
        design, plays ? clearance_scatter(*hinge.made, design.process.sd) : model::ClearanceScatter{},
        wall_mm);
  };
  const double edge_mm = design.structure.size().edge_mm;
  const std::vector<double> walls = wall_lengths_mm(design.structure);
  const bool are_alike = std::all_of(walls.begin(), walls.end(), [&](double wall) {
    return std::abs(wall - edge_mm) <= one_length * edge_mm;
  });
  model::HingeScatter scatter = of(design.hinge, edge_mm);
  if (design.hinge_overrides.empty() && are_alike) return scatter;
  for (int h = 0; h < design.structure.hinges(); ++h)
    scatter.each.push_back(of(hinge_section(design, h), are_alike ? edge_mm : walls[h]));
  return scatter;
}

/// Whether prints are analysed in the plane alone. Errors tilt hinges that are upright in the design, so a flat print
/// bends out of its plane. Goals that are read in the plane do not see that.
bool stays_in_plane(const SearchResult& found, const std::vector<model::ObservedPoint>& points) {
  return found.plan.planar &&
         std::all_of(points.begin(), points.end(), [](const model::ObservedPoint& point) {
           return std::abs(point.normal.z()) <= across_the_plane;
         });
}

/// Design in its equilibrium, the reference of its prints.
struct PrintedDesign {
  PrintHinges hinges;
  bool planar;
  model::SettledDesign settled;

  PrintedDesign(const SearchResult& found, const model::LinkageDrive& drive, const model::State& state,
                const std::vector<model::ObservedPoint>& points)
      : hinges(print_hinges(found, drive, state)),
        planar(stays_in_plane(found, points)),
        settled(found.design.structure, {state, hinges.elasticity, hinges.drive}, planar) {}
};

std::optional<PrintedGoal> expected_with(const SearchResult& found, const PrintedDesign& design,
                                         const model::State& state,
                                         const std::vector<model::ObservedPoint>& points) {
  const model::SettledDesign& settled = design.settled;
  if (!settled.is_stable()) return std::nullopt;
  if (!(aligned_distance(found.design.structure, settled.state(), state).rms <= near_design))
    return std::nullopt;
  const auto with = [&](const model::HingeScatter& scatter) {
    return analyse_print_tolerance(settled.system(), settled.state(), settled.theta(), settled.tangent(),
                                   points, scatter);
  };
  PrintedGoal out;
  out.can_be_printed = print_problems(found.design).empty();
  out.soft = design.hinges.soft;
  out.made = with(scatter_with(found.design, true));
  if (const auto pin = loosest_pin(found.design);
      pin && clearance_scatter(*pin, found.design.process.sd).place_mm > 0)
    out.without_clearance = with(scatter_with(found.design, false));
  return out;
}

model::PrintedLinkage printed_of(const Design& design) {
  return [&design](const Eigen::Matrix4Xd& errors) { return printed_sheet(design.structure, errors); };
}

constexpr int settled_prints_of_pins = 100;  // enough to tell a share of 0.05 by 0.02

/// Checks whether prints are mostly judged to first order. The elastic model has no clearance: it would strain a sheet of
/// pins by errors that their clearance absorbs.
bool has_joints_with_pins(const Design& design) {
  return design.hinge.model == HingeSection::Model::rotary && loosest_pin(design);
}

constexpr int states_during_motion =
    8;  // states of the motion in which walls of prints are checked for contact

/// Counts the sample prints whose walls touch. The folded state is held as its prints are. In earlier states each
/// hinge rests at the turn that it has there, in the closed form or, for elastic hinges, on their path.
std::optional<model::TouchingPrints> count_touching(const Run& run, const PrintedDesign& design,
                                                    const RunOptions& options) {
  const model::Linkage linkage = run.design.structure;
  const model::LinkageDrive none;
  std::vector<const model::State*> frames;
  for (const NamedState& frame : run.states)
    if (frame.name == "frame") frames.push_back(&frame.poses);
  const bool is_on_path = run.compensation.has_value();
  const model::MotionPath motion{
      is_on_path ? static_cast<int>(frames.size()) : states_during_motion - 1,
      [&](int k) -> std::optional<model::HeldState> {
        if (!is_on_path && !run.plan.exact) return std::nullopt;
        const model::State at =
            is_on_path ? *frames[k] : run.plan.exact.at(run.theta * (k + 1) / states_during_motion);
        return model::HeldState{at, with_rest_at(design.hinges.elasticity, linkage, at), none};
      }};
  model::ToleranceOptions prints = print_options(options, design.planar);
  if (options.prints == 0 && has_joints_with_pins(run.design)) prints.most_settled = settled_prints_of_pins;
  return touching_prints(printed_of(run.design), design.settled, motion, scatter_of(run.design), prints);
}

constexpr int max_bodies_to_press = 100;  // above this it takes too long: one path per side of each print

/// Presses sample prints from flat: elastic hinges between plates, if the design itself folds to the requested side.
/// Empty otherwise.
std::optional<model::FlatStarts> press_from_flat(const Run& run, const PrintedDesign& design,
                                                 const model::State& state, const RunOptions& options) {
  const model::LinkageDrive& drive = design.hinges.drive;
  const bool is_pressed = run.compensation && drive.has_plates();
  if (!is_pressed || !(mean_theta(run.design.structure, state) * drive.theta() > 0)) return std::nullopt;
  if (options.prints == 0 && run.design.structure.bodies() > max_bodies_to_press) return std::nullopt;
  return flat_starts(printed_of(run.design), design.hinges.elasticity, drive, scatter_of(run.design),
                     prints_of(options), print_options(options, design.planar), path_of_run(design.planar));
}

model::PrintRuns runs_of(const Run& run, const PrintedDesign& design,
                         const std::vector<model::ObservedPoint>& points, int prints,
                         const RunOptions& options) {
  return print_runs(printed_of(run.design), design.settled, points, scatter_of(run.design), prints,
                    print_options(options, design.planar));
}

/// Returns a block that suits all hinges in a state. An exact motion stretches no hinge, so a stretch left by
/// rounding counts as 0.
model::ManufacturedHinge soft_block(const SearchResult& found, const model::Linkage& linkage,
                                    const model::State& design) {
  const model::CellSize size = linkage.size;
  model::ManufacturedHinge block = open_hinge(model::HingeKind::block, found.design.process, size);
  for (int h = 0; h < found.design.structure.hinges(); ++h) {
    const double stretch = found.plan.exact ? 0 : edge_stretch_mm(linkage, design, h, block.height_mm);
    block.gap_mm = std::max(block.gap_mm, open_gap_mm(block, size.thickness_mm,
                                                      found.design.structure.hinge(h).offset * size.edge_mm,
                                                      hinge_turn(linkage, design, h), stretch));
  }
  return block;
}

model::Elasticity set_at(const model::ManufacturedHinge& made, double turn) {
  model::Elasticity out = elasticity_of(made);
  out.law = std::make_shared<model::SetHinge>(turn);
  return out;
}

}  // namespace

int prints_of(const RunOptions& options) { return std::max(options.prints, min_prints); }

model::ToleranceOptions print_options(const RunOptions& options, bool planar) {
  model::ToleranceOptions out;
  out.planar = planar;
  out.threads = options.threads;
  out.stop = [&stop = options.stop] { return stop.stop_requested(); };
  return out;
}

model::HingeScatter scatter_of(const Design& design) { return scatter_with(design, true); }

model::Lattice printed_sheet(model::Lattice sheet, const Eigen::Matrix4Xd& errors) {
  for (int h = 0; h < static_cast<int>(errors.cols()); ++h) {
    model::HingeParameters& hinge = sheet.hinge(h);
    hinge.t += errors(0, h);
    hinge.alpha += errors(1, h);
    hinge.beta += errors(2, h);
    hinge.offset += errors(3, h);
  }
  return sheet;
}

std::optional<PrintedGoal> estimate_print_tolerance(const SearchResult& found,
                                                    const model::LinkageDrive& drive,
                                                    const model::State& design,
                                                    const std::vector<model::ObservedPoint>& points) {
  if (points.empty()) return std::nullopt;
  return expected_with(found, {found, drive, design, points}, design, points);
}

std::optional<PrintedGoal> analyse_print_tolerance(const Run& run, const model::LinkageDrive& drive,
                                                   const model::State& state,
                                                   const std::vector<model::ObservedPoint>& points,
                                                   const RunOptions& options) {
  if (points.empty()) return std::nullopt;
  const PrintedDesign design(run, drive, state, points);
  std::optional<PrintedGoal> out = expected_with(run, design, state, points);
  if (!out) return out;
  out->touching = count_touching(run, design, options);
  out->from_flat = press_from_flat(run, design, state, options);
  const bool is_first_order =
      has_joints_with_pins(run.design) || run.design.structure.bodies() > max_bodies_to_confirm;
  if (options.prints == 0 && is_first_order) return out;
  model::PrintRuns runs = runs_of(run, design, points, prints_of(options), options);
  if (options.prints == 0 && runs.ratio_error > largest_ratio_error &&
      run.design.structure.bodies() <= max_bodies_for_more)
    runs = runs_of(run, design, points, more_prints, options);
  if (runs.prints + runs.failed > 0) out->runs = runs;
  return out;
}

PrintHinges print_hinges(const SearchResult& found, const model::LinkageDrive& drive,
                         const model::State& design) {
  if (found.design.hinge.model == HingeSection::Model::elastic)
    return {elasticity_of(found.design), drive, std::nullopt};
  const model::Linkage linkage(found.design.structure);
  const model::ManufacturedHinge block = soft_block(found, linkage, design);
  PrintHinges out{elasticity_of(block), {}, std::nullopt};
  std::optional<SoftHinges> soft;
  for (int h = 0; h < found.design.structure.hinges(); ++h) {
    const auto& made = hinge_section(found.design, h).made;
    const double turn = hinge_turn(linkage, design, h);
    out.elasticity.each.push_back(set_at(made.value_or(block), turn));
    out.elasticity.k_point = std::max(out.elasticity.k_point, out.elasticity.each.back().k_point);
    if (made && is_pin(made->kind)) continue;
    const model::ManufacturedHinge& bent = made ? *made : block;
    const double strain = hinge_strain(bent, linkage, design, h);
    if (!soft || strain / bent.material.strain_max > soft->strain / soft->made.material.strain_max)
      soft = SoftHinges{.made = bent, .is_assumed = !made, .strain = strain};
  }
  out.soft = soft;
  return out;
}

model::Elasticity with_rest_at(model::Elasticity elasticity, const model::Linkage& linkage,
                               const model::State& state) {
  if (elasticity.each.empty()) elasticity.each.assign(linkage.hinges.size(), elasticity);
  for (std::size_t h = 0; h < linkage.hinges.size(); ++h)
    elasticity.each[h].law =
        std::make_shared<model::SetHinge>(hinge_turn(linkage, state, static_cast<int>(h)));
  return elasticity;
}

}  // namespace kinetix::app
