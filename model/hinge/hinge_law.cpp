#include "model/hinge/hinge_law.hpp"

namespace kinetix::model {

const std::shared_ptr<const HingeLaw>& linear_hinge() {
  static const std::shared_ptr<const HingeLaw> law = std::make_shared<LinearHinge>();
  return law;
}

}  // namespace kinetix::model
