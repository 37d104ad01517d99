// Custom goal: a sheet of 20 columns that bends into half a pipe while its height decreases by 10 %.
#include <kinetix/kinetix.hpp>

#include <cmath>
#include <cstdio>

// x = (tilt of the walls, fold angle), rad. Residuals: column turn and sheet height, minus the goal.
struct HalfPipe : kinetix::LeastSquaresProblem {
  const Eigen::VectorXd low = Eigen::Vector2d(0.01, 0.05), high = Eigen::Vector2d(1, 0.7);

  int variables() const override { return 2; }
  int residuals() const override { return 2; }
  const Eigen::VectorXd& lower() const override { return low; }
  const Eigen::VectorXd& upper() const override { return high; }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override {
    const double tan_half = std::tan(x[0]) * std::sin(x[1]);  // tangent of half the turn of a column
    r = Eigen::Vector2d(2 * std::atan(tan_half) - kinetix::pi / 20, std::cos(x[1]) - 0.9);
    const double rate = 2 / (1 + tan_half * tan_half);
    const double by_tilt = rate * std::sin(x[1]) / std::pow(std::cos(x[0]), 2);
    const double by_fold = rate * std::tan(x[0]) * std::cos(x[1]);
    if (J) *J = Eigen::Matrix2d{{by_tilt, by_fold}, {0, -std::sin(x[1])}};
    return true;
  }
};

int main() {
  const kinetix::SolveResult found = kinetix::solve(HalfPipe(), Eigen::Vector2d(0.1, 0.3), {});
  std::printf("tilt %.4f deg, fold angle %.4f deg: %s\n", kinetix::to_degrees(found.x[0]),
              kinetix::to_degrees(found.x[1]), to_string(found.status).c_str());

  // Folds the whole sheet. Its tilts alternate, so all columns turn in one direction.
  kinetix::ExactDesign<double> sheet = kinetix::ExactDesign<double>::basic(20, 1);
  for (int c = 0; c < 20; ++c) sheet.beta[c] = c % 2 ? -found.x[0] : found.x[0];
  sheet.theta = found.x[1];
  std::vector<kinetix::Pose> poses;
  fold(sheet, 10, poses);                            // cells of 10 mm
  const Eigen::Vector3d up = poses.back().R.col(2);  // of the last body; that of the first is z
  std::printf("folded: turns by %.3f deg, height %.4f of 10 mm\n",
              kinetix::to_degrees(std::abs(std::atan2(up.x(), up.z()))), (poses[1].p - poses[0].p).norm());
}
