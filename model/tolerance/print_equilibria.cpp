#include "model/tolerance/print_equilibria.hpp"

#include <deque>

#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/elastic/newton.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix4Xd;

NewtonOptions print_newton() {
  NewtonOptions options;
  options.step_tolerance = at_rest;
  return options;
}

}  // namespace

struct PrintEquilibria::Workers {
  class Rest;

  PrintScene scene;
  State design;
  std::function<bool()> stop;
  Eigen::Index hinges = 0;
  std::deque<Rest> rests = {};  // one for each thread
};

/// Solver of one thread: finds the equilibria of prints one after the other.
class PrintEquilibria::Workers::Rest {
 public:
  /// @param scene, design kept by reference; the design is in equilibrium with the drive's multiplier
  Rest(const PrintScene& scene, const State& design, double multiplier)
      : scene_(scene), design_(design), system_(scene.system({})) {
    system_.set_multiplier(multiplier);
  }

  std::optional<State> of(const Matrix4Xd& errors) {
    restore();
    try {
      return settled(scene_.system(errors));
    } catch (const InvalidInput&) {
      return std::nullopt;
    }
  }

 private:
  std::optional<State> settled(ElasticSystem print) {
    print.set_multiplier(system_.multiplier());
    State state = design_;
    const double theta = scene_.drive.theta();
    print.place(theta, state);
    const NewtonResult found =
        minimise(print, theta, print_newton(), state, *tangent_, tangent_->is_factorised());
    is_of_design_ = false;
    if (!found.converged || !found.stable) return std::nullopt;
    return state;
  }

  void restore() {
    if (is_of_design_) return;
    // The pattern of the tangent contains the contacts of the previous print. The next print must not depend
    // on it.
    if (!tangent_ || scene_.contact) tangent_.emplace(system_.dofs());
    system_.linearise(design_, scene_.drive.theta(), *tangent_);
    tangent_->factorise(0);
    is_of_design_ = true;
  }

  const PrintScene& scene_;
  const State& design_;
  ElasticSystem system_;
  /// Tangent of any print: all have the same held coordinates and hinges.
  std::optional<TangentStiffness> tangent_;
  bool is_of_design_ = false;
};

PrintEquilibria::PrintEquilibria(PrintScene scene, const State& state, int most,
                                 const ToleranceOptions& options)
    : workers_(new Workers{std::move(scene), state, options.stop}) {
  Workers& own = *workers_;
  ElasticSystem system = own.scene.system({});
  TangentStiffness tangent(system.dofs());
  const double theta = own.scene.drive.theta();
  system.place(theta, own.design);
  minimise(system, theta, {}, own.design, tangent);
  own.hinges = static_cast<Eigen::Index>(system.structure().hinges.size());
  for (int w = 0; w < std::min(threads_of(options.threads), most); ++w)
    own.rests.emplace_back(own.scene, own.design, system.multiplier());
}

PrintEquilibria::~PrintEquilibria() = default;

Eigen::Index PrintEquilibria::hinges() const { return workers_->hinges; }

const State& PrintEquilibria::design() const { return workers_->design; }

std::vector<PrintEquilibria::Print> PrintEquilibria::of(const std::vector<Matrix4Xd>& errors) {
  std::vector<Print> out(errors.size());
  auto& rests = workers_->rests;
  const auto stops = [&] { return workers_->stop && workers_->stop(); };
  const auto workers = static_cast<int>(rests.size());
  run_in_parallel(workers, workers, [&](int w) {
    for (std::size_t k = w; k < errors.size() && !stops(); k += rests.size())
      out[k] = {true, rests[w].of(errors[k])};
  });
  return out;
}

SettledDesign::SettledDesign(Linkage linkage, HeldState held, bool planar)
    : held_(std::move(held)),
      system_(std::move(linkage), held_.elasticity, held_.drive, planar, false),
      tangent_(system_.dofs()) {
  system_.place(theta(), held_.state);
  if (settle(system_, theta(), held_.state, tangent_))
    by_hinges_.emplace(system_, held_.state, theta(), tangent_);
}

}  // namespace kinetix::model
