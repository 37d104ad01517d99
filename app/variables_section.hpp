#pragma once

#include "model/structure.hpp"
#include "optim/variables.hpp"
#include "targets/document.hpp"

namespace kinetix {

/// `theta: {range_deg: [2, 44]}` of a file's variables.
/// @param variables the section, or what stands for it in an error where there is none
/// @param usual where the file says nothing
/// @return rad, within (0, 45) deg
/// @throws InvalidInput for a range that starts where walls already close the cells
AngleRange read_theta(const Node& variables, const CellSize& size, const AngleRange& usual);

/// Variables of a net, whose creases alternate their tilts.
struct NetVariables {
  double tilt = 0;   ///< largest, rad, of either sign
  AngleRange theta;  ///< rad
};

/// `variables: {beta: {range_deg: [-60, 60]}, theta: {range_deg: [2, 44]}}` of a file.
/// @throws InvalidInput for tilts of one sign alone, and as read_theta
NetVariables read_net_variables(const Node& root, const CellSize& size, const NetVariables& usual);

}  // namespace kinetix
