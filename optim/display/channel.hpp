#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/opening/blurred_light.hpp"
#include "model/opening/soft_aperture.hpp"

namespace kinetix::optim {

/// What a display is read by: one number a cell (formats.md).
enum class Channel {
  light,     ///< through the panel, blurred over half a cell edge (model::BlurredLight), 0 to 1
  aperture,  ///< largest inscribed circle of the opening, diameter in cell edges
  area,      ///< of the opening, cell edges squared
  rotation,  ///< mean turn of the cell's bodies, each in the sense it turns in a basic sheet, rad
};

std::string to_string(Channel channel);

/// Of all cells by its definition, in the order of panel.cells, in the unit that Channel says.
std::vector<double> channel_values(Channel channel, const model::Linkage& panel, const model::State& state);

/// A smooth stand-in with derivatives: the same numbers but for the aperture, soft_aperture().
class SmoothChannel {
 public:
  /// The references are kept.
  SmoothChannel(Channel channel, const model::Linkage& panel, const model::State& state);

  const std::vector<double>& values() const { return values_; }
  /// Adds the derivatives of a function of the values. @param by_value its derivative by each of them
  void add_gradient(const Eigen::VectorXd& by_value, model::PanelGradient& gradient) const;

 private:
  const model::Linkage& panel_;
  std::optional<model::BlurredLight> light_;
  std::vector<model::CellReading> readings_;  ///< of channels that come from each cell alone
  std::vector<double> values_;
};

}  // namespace kinetix::optim
