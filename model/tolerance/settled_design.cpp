#include "model/tolerance/settled_design.hpp"

#include <utility>

#include "model/elastic/newton.hpp"

namespace kinetix::model {

SettledDesign::SettledDesign(Linkage linkage, HeldState held, bool planar)
    : held_(std::move(held)),
      system_(std::move(linkage), held_.elasticity, held_.drive, planar, false),
      tangent_(system_.dofs()) {
  system_.place(theta(), held_.state);
  if (settle(system_, theta(), held_.state, tangent_))
    by_hinges_.emplace(system_, held_.state, theta(), tangent_);
}

}  // namespace kinetix::model
