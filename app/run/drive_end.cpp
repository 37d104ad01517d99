#include "app/run/drive_end.hpp"

#include <fmt/format.h>

#include "model/base/angle.hpp"

namespace kinetix::app {

std::string describe_other_side(const Equilibrium& equilibrium, double theta) {
  return fmt::format("folded to theta {:.2f} deg, where {:.2f} was asked for", to_degrees(theta),
                     to_degrees(equilibrium.drive.theta()));
}

std::string in_words(model::EquilibriumPath::Stop stop) {
  return stop == model::EquilibriumPath::Stop::overstretched ? "hinge overstretched" : to_string(stop);
}

std::string missed_words(const Equilibrium& equilibrium, double theta) {
  if (equilibrium.reached()) return "other side: " + describe_other_side(equilibrium, theta);
  return in_words(equilibrium.path.stop) + ": " + equilibrium.path.why;
}

std::string drive_stop_reason(const model::EquilibriumPath& path) {
  return "the drive stops on its way, " + in_words(path.stop) + ": " + path.why;
}

}  // namespace kinetix::app
