#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/opening/blurred_light.hpp"
#include "model/opening/soft_aperture.hpp"

namespace kinetix::optim {

/// Quantity by which a display is read: one number per cell (formats.md).
enum class Channel {
  light,     ///< through the panel, blurred over half a cell edge (model::BlurredLight), 0 to 1
  aperture,  ///< largest inscribed circle of the opening, diameter in cell edges
  area,      ///< area of the opening, cell edges squared
  rotation,  ///< mean turn of the cell's bodies, each in its sense in a basic sheet, rad
};

std::string to_string(Channel channel);

/// Returns the readings of all cells by definition, in the order of panel.cells and in the unit of Channel.
std::vector<double> channel_values(Channel channel, const model::Linkage& panel, const model::State& state);

/// Smooth substitute with derivatives. Only the aperture differs from channel_values(): it is
/// soft_aperture().
class SmoothChannel {
 public:
  /// Keeps the references.
  SmoothChannel(Channel channel, const model::Linkage& panel, const model::State& state);

  const std::vector<double>& values() const { return values_; }
  /// Adds the derivatives of a function of the values.
  /// @param by_value derivative of the function by each value
  void add_gradient(const Eigen::VectorXd& by_value, model::PanelGradient& gradient) const;

 private:
  const model::Linkage& panel_;
  std::optional<model::BlurredLight> light_;
  std::vector<model::CellReading> readings_;  ///< of channels that depend on each cell alone
  std::vector<double> values_;
};

}  // namespace kinetix::optim
