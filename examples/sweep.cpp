// Compares the scatter of an arch's rise caused by its tilts with that caused by its fold angle.
#include <kinetix/kinetix.hpp>

#include <cstdio>
#include <vector>

// Returns the rise of an arch of 20 columns of 10 mm, mm. The tilts differ only in sign: all columns turn in
// one direction.
double rise_mm(double tilt_deg, double theta_deg) {
  kinetix::ExactDesign<double> arch = kinetix::ExactDesign<double>::basic(20, 1);
  for (int c = 0; c < 20; ++c) arch.beta[c] = (c % 2 ? -tilt_deg : tilt_deg) * kinetix::radians_per_degree;
  arch.theta = theta_deg * kinetix::radians_per_degree;
  std::vector<kinetix::Pose> poses;
  fold(arch, 10, poses);  // bodies (0,0), (0,1), (1,0), (1,1), ...
  return (poses[20].p - (poses[0].p + poses[40].p) / 2).norm();
}

int main() {
  // Manufacturing tolerances, one standard deviation: 10 +- 0.2 deg of tilt, folded to 30 +- 1 deg.
  const std::vector<kinetix::Factor> factors = {{"tilt", kinetix::NormalSpread{.mean = 10, .sd = 0.2}},
                                                {"fold angle", kinetix::NormalSpread{.mean = 30, .sd = 1}}};
  const kinetix::SamplePlan plan(factors, {.method = kinetix::SamplingMethod::saltelli, .samples = 1024});

  std::vector<double> rises;
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    const std::vector<double> sample = plan.sample(i);
    rises.push_back(rise_mm(sample[0], sample[1]));
  }

  const auto shares = kinetix::sobol_indices(rises, 2);
  std::printf("rise %.3f mm, variance %.4f mm^2, of %zu samples\n", shares.mean, shares.variance,
              rises.size());
  for (int f = 0; f < 2; ++f)
    std::printf("%s: %.3f of the variance by itself, %.3f in all\n", factors[f].name.c_str(),
                shares.factors[f].first.value, shares.factors[f].total.value);
}
