#include "app/studio/play/equilibria.hpp"

#include <fmt/format.h>

#include "app/pipeline/physics.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/path/near_equilibrium.hpp"

namespace kinetix::app::studio {
namespace {

constexpr double followed_step = 0.05;  // rad of theta between consecutive equilibria
constexpr double snapped = 0.3;         // rad that a hinge turns in such a step: more is another branch
constexpr double same_theta = 1e-7;     // rad: accuracy of a drive's theta from the compression of its plates

model::Elasticity elastic_hinges(Design design) {
  design.hinge.model = HingeSection::Model::elastic;
  return elasticity_of(design);
}

double next_theta(double theta, double goal) {
  const double left = goal - theta;
  return std::abs(left) <= followed_step ? goal : theta + std::copysign(followed_step, left);
}

}  // namespace

Equilibria::Equilibria(Design design, Moving moving)
    : design_(std::move(design)), moving_(std::move(moving)), elasticity_(elastic_hinges(design_)) {}

model::LinkageDrive Equilibria::drive(double theta) const {
  return moving_.bodies ? moving_.turned(theta) : drive_to(design_, theta);
}

model::EquilibriumPathOptions Equilibria::options(const std::stop_token& stop) const {
  model::EquilibriumPathOptions out;
  out.planar = !moving_.bodies && all_vertical(moving_.linkage);
  out.bodies = moving_.pressing;
  out.side = design_.side;
  out.stop = stop;
  return out;
}

double Equilibria::force_N(double theta, double load) const {
  const model::LinkageDrive drive = this->drive(theta);
  if (!drive.is_external()) return 0;
  return drive.has_force() ? load : load / moving_.linkage.size.edge_mm;
}

/// Follows the equilibria from `at` to theta in small steps. @return whether it reached theta
bool Equilibria::follow(model::DrivenState& at, double theta, const std::stop_token& stop) const {
  while (std::abs(theta - at.step.theta) > same_theta) {
    if (stop.stop_requested()) return false;
    const double next = next_theta(at.step.theta, theta);
    const model::LinkageDrive drive = this->drive(next);
    if (drive.press) return false;
    model::State start = at.state;
    model::ElasticSystem(moving_.linkage, elasticity_, drive, *options(stop).planar, true).place(next, start);
    const model::EquilibriumPath found = follow_change(
        start,
        [&](double) {
          return model::DrivenLinkage{moving_.linkage, drive, {}};
        },
        elasticity_, options(stop));
    if (found.stop != model::EquilibriumPath::Stop::reached) return false;
    if (!(std::abs(found.theta - next) <= same_theta)) return false;
    if (!(turn_distance(moving_.linkage, at.state, found.state) <= snapped)) return false;
    at = {found.steps.back(), found.state};
  }
  return true;
}

std::shared_ptr<KnownEquilibria> Equilibria::from_flat(double theta, const std::stop_token& stop,
                                                       const Seen& seen, std::string& why) const {
  const model::LinkageDrive drive = this->drive(theta);
  auto known = std::make_shared<KnownEquilibria>(KnownEquilibria{{}, model::EnergyTurns(drive)});
  const auto see = [&](const model::EquilibriumStep& step, const model::State& state) {
    known->turns.see(step, state);
    known->states.push_back({step, state});
    seen(known->states.back());
  };
  const auto path =
      trace_equilibrium({moving_.linkage, drive, moving_.bodies ? model::ExactMotion{} : moving_.exact},
                        elasticity_, options(stop), see);
  if (path.stop != model::EquilibriumPath::Stop::reached)
    why = fmt::format("the equilibrium ends at a fold angle of {:.1f} deg: {}", to_degrees(path.theta),
                      path.why);
  return known;
}

std::shared_ptr<const KnownEquilibria> Equilibria::trace_to(
    double theta, const std::shared_ptr<const KnownEquilibria>& known, const std::stop_token& stop,
    const Seen& seen, std::string& why) const {
  const bool helps = known && !known->states.empty() && known->states.back().step.theta * theta >= 0;
  if (!helps) return from_flat(theta, stop, seen, why);
  const auto far = [&](const model::DrivenState& one) { return std::abs(one.step.theta - theta); };
  model::DrivenState at = *std::min_element(known->states.begin(), known->states.end(),
                                            [&](const auto& a, const auto& b) { return far(a) < far(b); });
  seen(at);
  if (std::abs(theta) <= std::abs(known->states.back().step.theta)) {
    if (follow(at, theta, stop))
      seen(at);
    else if (!stop.stop_requested())
      from_flat(theta, stop, seen, why);
    return known;
  }
  auto longer = std::make_shared<KnownEquilibria>(*known);
  while (std::abs(theta - at.step.theta) > same_theta) {
    if (!follow(at, next_theta(at.step.theta, theta), stop))
      return stop.stop_requested() ? known : from_flat(theta, stop, seen, why);
    longer->turns.see(at.step, at.state);
    longer->states.push_back(at);
    seen(at);
  }
  return longer;
}

std::vector<model::StableState> Equilibria::stable(const KnownEquilibria& known,
                                                   const std::stop_token& stop) const {
  return stable_states(moving_.linkage, elasticity_, {known.turns}, {.path = options(stop)}).states;
}

}  // namespace kinetix::app::studio
