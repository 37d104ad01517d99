#include "app/assembly/assembly_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/run/stopwatch.hpp"
#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/linkage/make_drive.hpp"
#include "optim/solvers/parallel_runs.hpp"
#include "sim/contact_parts.hpp"
#include "sim/shapes/convex_cuts.hpp"

namespace kinetix::app {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double bore_share = 1.05;  // of a bore's radius: its polygon's corners lie outside it
constexpr double pin_share =
    2;  // of the reach of a pin, h / sqrt(12) of what bears: half of h and a little more
constexpr double one_shape_mm = 1e-4;    // mm: what floats far from the origin leave of equal shapes
constexpr double most_overlap_mm = 0.1;  // mm: by which pieces may stick out of their bodies
constexpr double stiff = 1e8;  // joint_stiffness of what closes exactly, as of exact families of sheets
constexpr std::array step_factors = {10.0, 4.0,
                                     1.0};  // times the usual step, tried one after the other as of sheets

/// The hinge that is turned, and the direction that the first motion gives it.
int driven_hinge(const AssemblyFile& file, const model::FirstMotion& first) {
  if (file.driven) return *file.driven;
  if (first.fastest < 0)
    throw InvalidInput(
        "nothing moves: no hinge turns in a first motion; `drive: {hinge: NAME, ...}` says which to turn");
  return first.fastest;
}

int sense_of(const AssemblyRun& run) {
  return run.linkage.bodies[run.linkage.hinges[run.driven].lower].sense;
}

double turn_of(const AssemblyRun& run) { return model::turn_at_theta(sense_of(run), run.theta); }

void add_state(AssemblyRun& run, const std::string& name, Model model, double theta,
               const model::State& state) {
  run.states.push_back({name, to_string(model), theta, state, hinge_gaps(run.linkage, state)});
}

void close(AssemblyRun& run, const model::FirstMotion& first, const RunOptions& options) {
  Stopwatch watch;
  model::AssemblyMotionOptions way;
  way.stop = [&] { return options.stop.stop_requested(); };
  run.motion = follow_turn(run.linkage, first, run.driven, turn_of(run), way);
  run.closure_s = watch.lap();
}

double end_theta(const AssemblyRun& run) {
  return model::theta_at_turn(sense_of(run), run.motion.turns.back());
}

void add_motion(AssemblyRun& run) {
  for (std::size_t k = 0; k < run.motion.states.size(); ++k)
    add_state(run, "frame", Model::exact, model::theta_at_turn(sense_of(run), run.motion.turns[k]),
              run.motion.states[k]);
}

void add_equilibrium(AssemblyRun& run, const RunOptions& options) {
  Stopwatch watch;
  model::EquilibriumPathOptions path;
  path.planar = false;
  path.stop = options.stop;
  path.contact = false;  // its walls are those of sheets
  const model::LinkageDrive drive = model::turned_hinge(run.driven, sense_of(run), turn_of(run));
  run.equilibrium =
      trace_equilibrium({run.linkage, drive, {}}, elasticity_of(run.file.assembly), path,
                        [&](const model::EquilibriumStep& step, const model::State&) {
                          options.progress("equilibrium path", run.theta == 0 ? 1 : step.theta / run.theta);
                        });
  run.equilibrium_s = watch.lap();
  add_state(run, "target", Model::equilibrium, run.equilibrium->theta, run.equilibrium->state);
}

sim::PhysicsOptions physics_of(const AssemblyRun& run, double factor) {
  sim::PhysicsOptions options;
  options.step_s *= factor;
  options.overlap_limit = std::max(options.overlap_limit, most_overlap_mm / run.file.assembly.edge_mm);
  options.joint_stiffness = run.motion.reached ? stiff : options.joint_stiffness;
  double reach = run.file.assembly.edge_mm;
  for (const model::AssemblyHinge& h : run.file.assembly.hinges) reach = std::min(reach, h.reach_mm);
  options.reach = reach / run.file.assembly.edge_mm;
  return options;
}

/// Of a body: rods turn in them, and do not collide with what is round them.
std::vector<sim::FilledBore> bores_of(const model::Assembly& assembly, int body) {
  std::vector<sim::FilledBore> out;
  for (const model::AssemblyHinge& h : assembly.hinges)
    if (h.rod_mm > 0 && (h.lower == body || h.upper == body))
      out.push_back({h.point, h.axis, bore_share * (h.rod_mm / 2 + h.clearance_mm), pin_share * h.reach_mm});
  return out;
}

bool have_one_shape(const model::AssemblyBody& a, const model::AssemblyBody& b) {
  if (a.solid.triangles != b.solid.triangles) return false;
  return std::equal(a.solid.points.begin(), a.solid.points.end(), b.solid.points.begin(),
                    b.solid.points.end(), [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
                      return ((p - a.position) - (q - b.position)).cwiseAbs().maxCoeff() < one_shape_mm;
                    });
}

/// For each body the first one of its shape.
std::vector<int> first_of_shape(const model::Assembly& assembly) {
  std::vector<int> out, firsts;
  for (int b = 0; b < static_cast<int>(assembly.bodies.size()); ++b) {
    const auto known = std::find_if(firsts.begin(), firsts.end(), [&](int f) {
      return have_one_shape(assembly.bodies[f], assembly.bodies[b]);
    });
    out.push_back(known == firsts.end() ? b : *known);
    if (known == firsts.end()) firsts.push_back(b);
  }
  return out;
}

/// Convex pieces of all bodies, about their rest positions.
sim::ContactParts pieces_of(const model::Assembly& assembly, int threads) {
  sim::ContactParts parts;
  const int count = static_cast<int>(assembly.bodies.size());
  parts.of_body.resize(assembly.bodies.size());
  const std::vector<int> first = first_of_shape(assembly);
  optim::run_in_parallel(count, threads, [&](int b) {
    if (first[b] != b) return;
    for (sim::CutPiece& piece :
         sim::convex_cuts(assembly.bodies[b].solid, {.filled = bores_of(assembly, b)})) {
      for (Eigen::Vector3d& corner : piece.corners) corner -= assembly.bodies[b].position;
      parts.of_body[b].push_back(std::move(piece.corners));
    }
  });
  for (std::size_t b = 0; b < first.size(); ++b) parts.of_body[b] = parts.of_body[first[b]];
  return parts;
}

/// Folds it by the engine, in coarse steps where these already settle in the closed state.
void verify_assembly(AssemblyRun& run, const RunOptions& options) {
  const model::LinkageDrive drive = model::turned_hinge(run.driven, sense_of(run), turn_of(run));
  Stopwatch watch;
  const sim::ContactParts parts = pieces_of(run.file.assembly, options.threads);
  run.pieces_s = watch.lap();
  for (const auto& pieces : parts.of_body) run.pieces += pieces.size();
  Verification v;
  for (const double factor : step_factors) {
    v = {};
    v.options = physics_of(run, factor);
    sim::PhysicsObserver observer;
    observer.stop = options.stop;
    observer.progress = [&](double done) { options.progress("physics run", done); };
    v.physics = run_with_parts(run.linkage, drive, v.options, parts, observer);
    v.compared = run.motion.reached;
    const bool settled = v.physics.status == sim::PhysicsResult::Status::settled;
    v.distance = settled && v.compared
                     ? aligned_distance(run.linkage, v.physics.state, run.motion.states.back())
                     : model::StateDistance{not_a_number, not_a_number};
    v.agrees = settled && (!v.compared || v.distance.rms <= Run{}.verify_tolerance);
    if (v.agrees || options.stop.stop_requested()) break;
  }
  add_state(run, "target", Model::bullet, run.theta, v.physics.state);
  run.verification = std::move(v);
}

}  // namespace

bool AssemblyRun::reached() const {
  return model == Model::equilibrium ? equilibrium->stop == model::EquilibriumPath::Stop::reached
                                     : motion.reached;
}

model::Elasticity elasticity_of(const model::Assembly& assembly) {
  model::Elasticity whole;
  for (const model::AssemblyHinge& h : assembly.hinges) {
    model::HingeStiffness k = h.k;
    whole.each.push_back(elasticity_of(k, h.reach_mm));
  }
  whole.k_point = whole.each.front().k_point;
  for (const model::Elasticity& e : whole.each) whole.k_point = std::max(whole.k_point, e.k_point);
  whole.k_contact = 10 * whole.k_point;
  return whole;
}

sim::ContactParts contact_parts_of(const model::Assembly& assembly, int threads) {
  return pieces_of(assembly, threads);
}

AssemblyRun run_assembly(AssemblyFile file, Model model, std::optional<double> theta,
                         const RunOptions& options) {
  AssemblyRun run;
  run.file = std::move(file);
  run.model = model;
  run.linkage = linkage_of(run.file.assembly);
  const model::FirstMotion first = first_motion(run.linkage);
  run.driven = driven_hinge(run.file, first);
  run.theta = theta.value_or(model::theta_at_turn(sense_of(run), run.file.angle));
  close(run, first, options);
  if (model == Model::equilibrium)
    add_equilibrium(run, options);
  else if (run.motion.reached || model == Model::exact)
    add_state(run, "target", Model::exact, end_theta(run), run.motion.states.back());
  if (model == Model::bullet) verify_assembly(run, options);
  add_motion(run);
  return run;
}

}  // namespace kinetix::app
