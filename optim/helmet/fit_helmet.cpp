#include "optim/helmet/fit_helmet.hpp"

namespace kinetix::optim {

RibsDesign fit_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown, const HelmetSpec& spec,
                      const SolverOptions& options) {
  return fit_layout(plan_helmet(head, crown, spec), head, crown, spec, options);
}

}  // namespace kinetix::optim
