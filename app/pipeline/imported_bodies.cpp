#include "app/pipeline/imported_bodies.hpp"

#include <fmt/format.h>

#include "app/pipeline/closed_form.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/physics.hpp"
#include "model/assembly/assembly_motion.hpp"
#include "model/base/algorithms.hpp"
#include "model/base/parallel_runs.hpp"

namespace kinetix::app {
namespace {

constexpr double bore_share = 1.05;  // times a bore's radius: its polygon's corners lie outside it
constexpr double pin_share =
    2;  // times a pin's reach h / sqrt(12), h the length that bears: a little over h / 2
constexpr double one_shape_mm =
    1e-4;  // mm: rounding of floats far from the origin leaves equal shapes this near

/// Returns the bores of a body. Rods turn in them and do not collide with the material around them.
std::vector<sim::FilledBore> bores_of(const model::Assembly& assembly, int body) {
  std::vector<sim::FilledBore> out;
  for (const model::AssemblyHinge& h : assembly.hinges)
    if (h.rod_mm > 0 && (h.lower == body || h.upper == body))
      out.push_back({h.point, h.axis, bore_share * (h.rod_mm / 2 + h.clearance_mm), pin_share * h.reach_mm});
  return out;
}

std::vector<std::vector<sim::FilledBore>> all_bores(const model::Assembly& assembly) {
  std::vector<std::vector<sim::FilledBore>> out;
  for (int b = 0; b < static_cast<int>(assembly.bodies.size()); ++b) out.push_back(bores_of(assembly, b));
  return out;
}

bool are_same(const sim::FilledBore& a, const sim::FilledBore& b) {
  return a.point == b.point && a.axis == b.axis && a.radius_mm == b.radius_mm && a.half_mm == b.half_mm;
}

bool have_same_shape(const model::AssemblyBody& a, const model::AssemblyBody& b) {
  if (a.solid.triangles != b.solid.triangles) return false;
  return std::equal(a.solid.points.begin(), a.solid.points.end(), b.solid.points.begin(),
                    b.solid.points.end(), [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
                      return ((p - a.position) - (q - b.position)).cwiseAbs().maxCoeff() < one_shape_mm;
                    });
}

/// Returns, for each body, the first body of the same shape.
std::vector<int> first_of_shape(const model::Assembly& assembly) {
  std::vector<int> out, firsts;
  for (int b = 0; b < static_cast<int>(assembly.bodies.size()); ++b) {
    const auto known = std::find_if(firsts.begin(), firsts.end(), [&](int f) {
      return have_same_shape(assembly.bodies[f], assembly.bodies[b]);
    });
    out.push_back(known == firsts.end() ? b : *known);
    if (known == firsts.end()) firsts.push_back(b);
  }
  return out;
}

sim::CutPiece shifted(sim::CutPiece piece, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& corner : piece.corners) corner += by;
  piece.faces.col(3) += piece.faces.leftCols<3>() * by;
  return piece;
}

}  // namespace

std::size_t BodyPieces::count() const {
  std::size_t sum = 0;
  for (const auto& pieces : of_body) sum += pieces.size();
  return sum;
}

bool BodyPieces::fit(const model::Assembly& assembly) const {
  const auto others = all_bores(assembly);
  return std::equal(bores.begin(), bores.end(), others.begin(), others.end(),
                    [](const auto& a, const auto& b) {
                      return std::equal(a.begin(), a.end(), b.begin(), b.end(), are_same);
                    });
}

BodyPieces pieces_of(const model::Assembly& assembly, int threads) {
  Stopwatch watch;
  BodyPieces out{.of_body = {}, .bores = all_bores(assembly)};
  const int count = static_cast<int>(assembly.bodies.size());
  out.of_body.resize(assembly.bodies.size());
  const std::vector<int> first = first_of_shape(assembly);
  model::run_in_parallel(count, threads, [&](int b) {
    if (first[b] == b) out.of_body[b] = sim::convex_cuts(assembly.bodies[b].solid, {.filled = out.bores[b]});
  });
  for (int b = 0; b < count; ++b)
    if (first[b] != b)
      for (const sim::CutPiece& piece : out.of_body[first[b]])
        out.of_body[b].push_back(
            shifted(piece, assembly.bodies[b].position - assembly.bodies[first[b]].position));
  out.seconds = watch.lap();
  return out;
}

sim::ContactParts contact_parts(const BodyPieces& pieces, const model::Assembly& assembly) {
  sim::ContactParts parts;
  for (std::size_t b = 0; b < pieces.of_body.size(); ++b) {
    auto& of_this = parts.of_body.emplace_back();
    for (const sim::CutPiece& piece : pieces.of_body[b])
      of_this.push_back(shifted(piece, -assembly.bodies[b].position).corners);
  }
  return parts;
}

model::ConvexBodies convex_bodies(const BodyPieces& pieces, const model::Assembly& assembly,
                                  const model::Linkage& linkage) {
  model::ConvexBodies out;
  std::vector<int> first;
  for (std::size_t b = 0; b < pieces.of_body.size(); ++b) {
    first.push_back(static_cast<int>(out.pieces.size()));
    for (const sim::CutPiece& piece : pieces.of_body[b]) {
      sim::CutPiece own = shifted(piece, -assembly.bodies[b].position);
      out.pieces.push_back({static_cast<int>(b), std::move(own.corners), std::move(own.faces)});
    }
  }
  for (const sim::TouchingPieces& pair : sim::touching_pieces(linkage, contact_parts(pieces, assembly)))
    out.passing.emplace_back(first[pair.body] + pair.piece, first[pair.other] + pair.piece_of_other);
  return out;
}

namespace {

// Fraction of the distance to the poses: bodies that move by less count as fixed. Rounding of files lets bodies move
// by up to 3 % of the distance, mechanisms move by all of it.
constexpr double min_moved_share = 0.05;

/// States along the motion with their theta, and a summary of the motion.
struct FollowedPath {
  ClosedPath closed_path;
  std::vector<model::State> states = {};
  std::vector<double> thetas = {};  ///< rad
  double gap = 0;                   ///< largest mismatch of hinge points during the motion, cell edges
};

std::string describe_turn(const model::AssemblyMotion& m, const std::vector<model::AssemblyHinge>& hinges,
                          int driven) {
  const double last = to_degrees(m.turns.back()) + 0.0;  // no -0
  if (m.reached)
    return fmt::format(
        "`{}` turned by {:.2f} deg; hinges stay closed within {:.1e} cell edges and {:.1e} rad",
        hinges[driven].name, last, m.gap, m.axis_gap);
  if (m.broken < 0) return fmt::format("stopped with `{}` turned by {:.2f} deg", hinges[driven].name, last);
  return fmt::format(
      "`{}` turns by {:.2f} deg and no further: at {:.2f} deg `{}` separates by more than it may",
      hinges[driven].name, last, to_degrees(m.broken_turn), hinges[m.broken].name);
}

FollowedPath trace_turned_path(const Design& design, const model::Linkage& linkage,
                               const model::LinkageDrive& drive, const RunOptions& options) {
  model::AssemblyMotionOptions how;
  how.stop = [&] { return options.stop.stop_requested(); };
  model::AssemblyMotion m = follow_turn(linkage, first_motion(linkage), drive.hinge, drive.angle, how);
  FollowedPath out{
      .closed_path = {.reached = m.reached,
                      .last = m.states.back(),
                      .description = describe_turn(m, design.structure.assembly()->hinges, drive.hinge)},
      .states = std::move(m.states),
      .gap = m.gap};
  for (const double turn : m.turns) out.thetas.push_back(model::theta_at_turn(drive.sense, turn));
  if (!m.reached) out.closed_path.missed = {out.closed_path.description};
  return out;
}

std::string describe_pull(const model::Deployment& d, double seconds, bool is_stopped) {
  if (!d.reached && is_stopped)
    return fmt::format("stopped after {:.0f} % of the motion", 100 * d.shares.back());
  if (!d.reached)
    return fmt::format(
        "bodies follow the drive for {:.0f} % of the motion. Further on, joints would separate",
        100 * d.shares.back());
  return fmt::format(
      "bodies end {:.2g} cell edges (rms) from the requested poses, {:.2g} at most; joints separate by at "
      "most {:.1e} cell edges; {} states in {:.2f} s",
      d.off_rms, d.off_max, d.gap, d.states.size(), seconds);
}

/// Returns the largest distance of a body from its rest pose, cell edges, measured like Deployment::off_max.
double moved_by(const std::vector<model::State>& states, double edge_mm) {
  const model::State &rest = states.front(), &last = states.back();
  double most = 0;
  for (std::size_t b = 0; b < last.size(); ++b)
    most = std::max(most, (last[b].p - rest[b].p).norm() / edge_mm + 0.5 * (last[b].R - rest[b].R).norm());
  return most;
}

/// Lists the reasons why the bodies do not end where they are pulled to.
std::vector<std::string> pull_reasons(const model::BodyPull& pull, const model::Deployment& d, double moved) {
  const bool stays = moved <= min_moved_share * d.off_rms;
  if (!pull.poses) {
    if (!stays) return {};
    return {"no body moves: the hinges hold the bodies where they are"};
  }
  if (d.off_rms <= pull.tolerance) return {};
  if (stays)
    return {
        fmt::format("rest and target are two separate states, not a mechanism between them: bodies move "
                    "by {:.2g} cell edges at most, and end {:.3g} (rms) from the target; {:g} are allowed",
                    moved, d.off_rms, pull.tolerance)};
  return {fmt::format("bodies end {:.3g} cell edges (rms) from the requested poses; {:g} are allowed",
                      d.off_rms, pull.tolerance)};
}

FollowedPath trace_pulled_path(const Design& design, const model::Linkage& linkage,
                               const RunOptions& options) {
  Stopwatch watch;
  model::DeploymentOptions how;
  how.stop = [&] { return options.stop.stop_requested(); };
  model::Deployment d = deploy(linkage, *pull_of(design), how);
  FollowedPath out{
      .closed_path = {.reached = d.reached,
                      .last = d.states.back(),
                      .off = model::StateDistance{d.off_rms, d.off_max},
                      .description = describe_pull(d, watch.lap(), options.stop.stop_requested())},
      .gap = d.gap};
  out.closed_path.missed =
      d.reached ? pull_reasons(*body_pull_of(design), d, moved_by(d.states, linkage.size.edge_mm))
                : std::vector<std::string>{out.closed_path.description};
  for (const model::State& state : d.states) out.thetas.push_back(mean_half_turn(linkage, state));
  out.states = std::move(d.states);
  return out;
}

std::shared_ptr<const model::ConvexBodies> pressing_bodies(const Run& run, const RunOptions& options) {
  const auto alone = options.engine ? std::unique_lock(*options.engine) : std::unique_lock<std::mutex>();
  return std::make_shared<const model::ConvexBodies>(
      convex_bodies(*run.pieces, *run.design.structure.assembly(), run.design.structure));
}

/// Adds the equilibrium of the elastic hinges, and next to it the closed state of the same drive.
Run with_elastic_state(Run run, const model::LinkageDrive& drive, const RunOptions& options) {
  run = with_pieces(std::move(run), options);
  ElasticState state = follow_drive(run, drive, elasticity_of(run.design), motion_states, options,
                                    pressing_bodies(run, options));
  if (run.closed_path->reached && state.equilibrium.reached()) {
    const model::Linkage linkage = run.design.structure;
    state.equilibrium.from_exact =
        aligned_distance(linkage, state.equilibrium.path.state, run.closed_path->last);
    state.states.insert(state.states.begin() + 1,
                        {"target", to_string(Model::exact), drive.theta(), run.closed_path->last,
                         hinge_gaps(linkage, run.closed_path->last)});
  }
  return with_states(std::move(run), std::move(state));
}

}  // namespace

void require_one_axis(const model::Assembly& bodies, bool are_pulled) {
  if (are_pulled)
    throw InvalidInput("the model equilibrium turns one hinge: give `drive: {hinge: NAME, angle_deg: ...}`",
                       {"", 0, 0, "drive"});
  for (const model::AssemblyHinge& hinge : bodies.hinges)
    if (hinge.ball)
      throw InvalidInput(
          "the model `equilibrium` needs hinges with an axis, and `" + hinge.name + "` is a spherical joint",
          {"", 0, 0, "structure.hinges"});
}

std::optional<model::Pull> pull_of(const Design& design) {
  const model::BodyPull* pull = body_pull_of(design);
  if (!pull) return std::nullopt;
  if (pull->poses) return aligned_pull(design.structure, {*pull->poses});
  const std::vector<model::AssemblyBody>& bodies = design.structure.assembly()->bodies;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const model::AssemblyBody& b : bodies) middle += b.position / static_cast<double>(bodies.size());
  model::Pull out{{}, false};
  for (const model::AssemblyBody& b : bodies)
    out.to.push_back({Eigen::Matrix3d::Identity(), middle + *pull->expand * (b.position - middle)});
  return aligned_pull(design.structure, std::move(out));
}

Run with_closed_path(Run run, const RunOptions& options) {
  if (run.plan.model == Model::equilibrium)
    require_one_axis(*run.design.structure.assembly(), body_pull_of(run.design));
  const model::Linkage linkage = run.design.structure;
  const model::LinkageDrive drive = drive_of(run.design);
  const model::BodyPull* pull = body_pull_of(run.design);
  if (!pull) run.design.drive = model::HingeTurn{drive.hinge, drive.angle};
  Stopwatch watch;
  FollowedPath followed = pull ? trace_pulled_path(run.design, linkage, options)
                               : trace_turned_path(run.design, linkage, drive, options);
  run.fidelity.push_back({to_string(Model::exact), watch.lap(), followed.gap, "its own hinge closure"});
  run.theta = pull ? followed.thetas.back() : drive.theta();
  if (pull && pull->poses) run.tolerances = {{"pull", pull->tolerance}};
  run.plan.why.push_back(followed.closed_path.description);
  run.closed_path = std::move(followed.closed_path);
  if (run.plan.model == Model::equilibrium) return with_elastic_state(std::move(run), drive, options);
  const auto add = [&](const char* name, std::size_t k) {
    const model::State& state = followed.states[k];
    run.states.push_back(
        {name, to_string(Model::exact), followed.thetas[k], state, hinge_gaps(linkage, state)});
  };
  if (run.closed_path->reached || run.plan.model == Model::exact) add("target", followed.states.size() - 1);
  for (std::size_t k = 0; k < followed.states.size(); ++k) add("frame", k);
  return run;
}

Run with_pieces(Run run, const RunOptions& options) {
  const model::Assembly& bodies = *run.design.structure.assembly();
  run.pieces = options.pieces && options.pieces->fit(bodies)
                   ? options.pieces
                   : std::make_shared<const BodyPieces>(pieces_of(bodies, options.threads));
  return run;
}

}  // namespace kinetix::app
