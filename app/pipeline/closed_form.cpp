#include "app/pipeline/closed_form.hpp"

#include "app/pipeline/drive_loads.hpp"
#include "model/base/algorithms.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/contact/certified_range.hpp"

namespace kinetix::app {
namespace {

constexpr int timed_calls = 200;  // enough to resolve the mean, microseconds for small sheets

/// Returns the size of the folded design by the closed form, mm.
std::optional<Eigen::Vector3d> folded_size(const model::ExactMotion& motion, const Design& design) {
  const Eigen::Vector3d size = size_of(design.structure, motion.at(exact_theta_of(design, motion)));
  return size.allFinite() ? std::optional(size) : std::nullopt;
}

}  // namespace

NamedState exact_state(const SearchResult& found, const std::string& name, double theta) {
  model::State own = found.motion ? found.motion(theta) : found.plan.exact.at(theta);
  const model::HingeGaps gaps = hinge_gaps(found.design.structure, own);
  if (found.to_shown) own = moved(std::move(own), *found.to_shown);
  return {name, to_string(Model::exact), theta, std::move(own), gaps};
}

std::vector<NamedState> exact_frames(const SearchResult& found) {
  std::vector<NamedState> out;
  for (int k = 0; k < motion_states; ++k)
    out.push_back(exact_state(found, "frame", found.theta * k / (motion_states - 1)));
  return out;
}

Fidelity exact_fidelity(const model::ExactMotion& exact, const model::Linkage& structure, double theta) {
  model::State state;
  Stopwatch watch;
  for (int k = 0; k < timed_calls; ++k) state = exact.at(theta);
  const double seconds = watch.lap() / timed_calls;
  return {to_string(Model::exact), seconds, hinge_gaps(structure, state).max, "its own hinge closure"};
}

std::optional<Model> plan_model(const Design& design, Model asked) {
  if (design.structure.assembly()) return asked;
  const bool elastic = design.hinge.model == HingeSection::Model::elastic;
  const bool in_equilibrium = asked == Model::equilibrium || (asked == Model::bullet && elastic);
  return in_equilibrium ? std::optional(Model::equilibrium) : std::nullopt;
}

Forecast forecast_design(const Design& design) {
  Forecast out{design.structure};
  model::append(design.notes, out.notes);
  if (const auto motion = exact_motion(design.structure)) out.folded_mm = folded_size(motion, design);
  if (design.drive && needs_elastic_hinges(*design.drive) &&
      design.hinge.model == HingeSection::Model::rotary)
    out.notes.push_back(
        "`verify` needs elastic hinges for this drive. Give `hinge: {model: elastic}`, or use --model "
        "equilibrium, which computes revolute joints as elastic");
  return out;
}

namespace {

constexpr double deviations = 3;  // standard deviations of a normal distribution: 997 of 1000 are within

ProvenRanges along(const model::Lattice& sheet, const model::ExactMotion& exact, const model::PrintError& sd,
                   int threads, const std::stop_token& stop) {
  const model::Linkage linkage = sheet;
  const auto laws = exact ? turn_laws(sheet) : std::vector<model::TurnLaw>{};
  const double growth_mm[] = {0, print_growth_mm(linkage, sd)};
  model::ContactRange ranges[2];
  model::run_in_parallel(2, threads, [&](int k) {
    ranges[k] = certified_range(linkage, exact, laws, {.growth_mm = growth_mm[k], .stop = stop});
  });
  return {std::move(ranges[0]), std::move(ranges[1])};
}

}  // namespace

double print_growth_mm(const model::Linkage& sheet, const model::PrintError& sd) {
  double farthest = 0;
  for (const model::HalfWall& wall : half_walls(sheet)) {
    Eigen::Vector3d reach = (wall.box.axes.transpose() * wall.box.center).cwiseAbs() + wall.box.half;
    reach.x() += std::abs(wall.box.slant) * wall.box.half.y();
    farthest = std::max(farthest, reach.norm());
  }
  const double tilt = std::min(deviations * sd.tilt_deg * radians_per_degree, pi / 2);
  return deviations * sd.t_mm + std::sin(tilt) * farthest;
}

ProvenRanges certify(const model::Lattice& sheet, const Plan& plan, const model::PrintError& sd, int threads,
                     const std::stop_token& stop) {
  return along(sheet, plan.exact, sd, threads, stop);
}

ProvenRanges certify(const model::Lattice& sheet, const model::PrintError& sd) {
  return along(sheet, exact_motion(sheet), sd, 0, {});
}

}  // namespace kinetix::app
