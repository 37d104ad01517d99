#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "app/files/design_file.hpp"
#include "app/files/hinge_parts.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::app {

/// What an equilibrium path asks of who drives the sheet, and of its hinges.
struct HingeLoads {
  bool reached = false;  ///< whether the path came to its goal
  double force_N = 0;  ///< largest on the way; of a driven hinge with the lever of a cell edge; 0 of springs
  bool by_lever = false;  ///< it is of a driven hinge
  double strain = 0;      ///< largest of a hinge that is made as a block or film, at the goal; ratio
};

/// Of the force, in words: empty where it is one, as of plates.
inline std::string lever_words(const HingeLoads& loads) {
  return loads.by_lever ? " at the lever of a cell edge" : "";
}

/// What a path asks of who drives the sheet, and of its hinges. @param own of hinges that are not as the rest
HingeLoads hinge_loads(const model::EquilibriumPath& path, const model::LinkageDrive& drive,
                       const model::Linkage& linkage, const HingeSection& hinge,
                       const std::map<int, HingeSection>& own = {});

/// The largest of all loads over its limit; infinite where there is no equilibrium. Ratio
double share_of(const HingeLimits& limits, const HingeLoads& loads);

/// A range in which limits are kept at one end and not at the other.
struct LimitRange {
  double kept = 0;      ///< end at which they are kept, ratio or the unit of the value
  double too_much = 1;  ///< end at which they are not, ratio or the unit of the value
};

/// How a search for the largest load that keeps limits goes on. Values are in the unit of the range.
struct Halvings {
  int most = 0;
  double enough = 0;                 ///< width of the range that is left, unit of the range
  std::optional<double> first = {};  ///< where it begins, unit of the range; nothing: in the middle
  double least = 0;                  ///< values below are not tried, unit of the range
};

/// Halves the range until it is narrow enough. @param keeps the limits at a value; nothing: stop. It is given the share that is done
LimitRange halve(LimitRange range, const Halvings& halvings,
                 const std::function<std::optional<bool>(double at, double share)>& keeps);

/// What of the limits is not kept, in words. @param instead what the search could do to keep it, "less compression"
std::vector<std::string> violations(const HingeLimits& limits, const HingeLoads& loads,
                                    const std::string& instead);

/// The drive of a design: as its file says, or to its theta. None of bodies that are pulled.
model::LinkageDrive drive_of(const Design& design);

/// Theta to which that takes a design along its closed form, rad: without a drive the design's own, to the last
/// bit; of springs by their stiffness and that of the hinges.
/// @pre exact
double exact_theta_of(const Design& design, const model::ExactMotion& exact);

}  // namespace kinetix::app
