#pragma once

#include "model/lattice/square/structure.hpp"
#include "optim/solvers/variables.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Keys of a `variables:` section; angles in radians.
targets::Key tilt_range_key(const optim::AngleRange& usual);
/// @param usual rad
targets::Key theta_key(const optim::AngleRange& usual);
/// The whole section of a net. @param tilt largest, rad, of either sign
targets::KeyTable net_variables_keys(double tilt, const optim::AngleRange& theta);

/// `theta: {range_deg: [2, 44]}` of a file's variables.
/// @param root the whole document
/// @param usual where the file says nothing
/// @return rad, within (0, 45) deg
/// @throws InvalidInput for a range that starts where walls already close the cells
optim::AngleRange read_theta(const targets::Section& root, const model::CellSize& size,
                             const optim::AngleRange& usual);

/// Variables of a net, whose creases alternate their tilts.
struct NetVariables {
  double tilt = 0;          ///< largest, rad, of either sign
  optim::AngleRange theta;  ///< rad
};

/// `variables: {beta: {range_deg: [-60, 60]}, theta: {range_deg: [2, 44]}}` of a file.
/// @throws InvalidInput for tilts of one sign alone, and as read_theta
NetVariables read_net_variables(const targets::Section& root, const model::CellSize& size,
                                const NetVariables& usual);

}  // namespace kinetix::app
