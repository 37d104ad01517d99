#include "optim/solvers/solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "model/base/invalid_input.hpp"
#include "optim/solvers/multi_start.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::optim {
namespace {

/// Rosenbrock's valley as residuals (10 (y - x^2), 1 - x), in a box.
class Valley : public LeastSquaresProblem {
 public:
  explicit Valley(double upper_x = 2, double reach = 2) : lower_(2), upper_(2) {
    lower_ << -reach, -reach;
    upper_ << upper_x, reach;
  }
  int variables() const override { return 2; }
  int residuals() const override { return 2; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override {
    r.resize(2);
    r << 10 * (x[1] - x[0] * x[0]), 1 - x[0];
    if (J) *J = (Eigen::Matrix2d() << -20 * x[0], 10, -1, 0).finished();
    return true;
  }

 private:
  Eigen::VectorXd lower_, upper_;
};

/// Cannot be evaluated right of x = 0.5.
class Cliff : public Valley {
 public:
  explicit Cliff(double edge) : edge_(edge) {}
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override {
    return x[0] < edge_ && Valley::evaluate(x, r, J);
  }

 private:
  double edge_;
};

/// Claims values that are not numbers.
class Nowhere : public Valley {
 public:
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override {
    Valley::evaluate(x, r, J);
    r *= std::numeric_limits<double>::quiet_NaN();
    return true;
  }
};

class Thrower : public Valley {
 public:
  bool evaluate(const Eigen::VectorXd&, Eigen::VectorXd&, Eigen::MatrixXd*) const override {
    throw std::runtime_error("no value here");
  }
};

class Glutton : public Valley {
 public:
  bool evaluate(const Eigen::VectorXd&, Eigen::VectorXd&, Eigen::MatrixXd*) const override {
    throw std::bad_alloc();
  }
};

SolverOptions options(SolverName name, int evaluations = 20000) {
  SolverOptions out;
  out.name = name;
  out.max_evaluations = evaluations;
  out.tolerance = 1e-12;
  return out;
}

bool inside(const LeastSquaresProblem& problem, const Eigen::VectorXd& x) {
  return (x.array() >= problem.lower().array()).all() && (x.array() <= problem.upper().array()).all();
}

class EverySolver : public ::testing::TestWithParam<SolverName> {};

TEST_P(EverySolver, FindsTheEndOfTheValley) {
  const Valley valley;
  const SolveResult result = solve(valley, Eigen::Vector2d(-1.2, 1), options(GetParam()));
  EXPECT_LE(result.residual_norm, 1e-3) << result.why;
  EXPECT_FALSE(result.why.empty());
  EXPECT_FALSE(result.history.empty());
}

TEST_P(EverySolver, StaysInsideTheBoxWhenTheMinimumLiesOutside) {
  const Valley valley(0.5);
  const SolveResult result = solve(valley, Eigen::Vector2d(-1.2, 1), options(GetParam()));
  EXPECT_TRUE(inside(valley, result.x)) << result.x.transpose();
  EXPECT_NEAR(result.x[0], 0.5, 1e-3);
  Eigen::VectorXd r;
  valley.evaluate(result.x, r, nullptr);
  EXPECT_EQ(r.norm(), result.residual_norm);
}

TEST_P(EverySolver, KeepsTheEvaluationLimit) {
  const SolveResult result = solve(Valley(), Eigen::Vector2d(-1.2, 1), options(GetParam(), 7));
  EXPECT_LE(result.evaluations, 9) << to_string(GetParam());
  EXPECT_EQ(result.status, SolveStatus::evaluation_limit);
}

TEST_P(EverySolver, SaysSoWhenNothingCanBeEvaluated) {
  const Eigen::Vector2d start(-1.2, 1);
  const SolveResult result = solve(Cliff(-5), start, options(GetParam()));
  EXPECT_EQ(result.status, SolveStatus::cannot_evaluate);
  EXPECT_TRUE(std::isinf(result.residual_norm));
  EXPECT_EQ(result.x, Eigen::VectorXd(start));
}

TEST_P(EverySolver, TakesNoNaNForAResult) {
  const SolveResult result = solve(Nowhere(), Eigen::Vector2d(-1.2, 1), options(GetParam()));
  EXPECT_EQ(result.status, SolveStatus::cannot_evaluate) << result.why;
  EXPECT_NE(result.why.find("cannot be evaluated"), std::string::npos) << result.why;
  EXPECT_TRUE(std::isinf(result.residual_norm));
  EXPECT_TRUE(result.history.empty());
}

TEST_P(EverySolver, ReportsWhatTheProblemThrows) {
  const SolveResult result = solve(Thrower(), Eigen::Vector2d(-1.2, 1), options(GetParam()));
  EXPECT_EQ(result.status, SolveStatus::failed);
  EXPECT_EQ(result.why, "no value here");
}

TEST_P(EverySolver, EndsWhereAProblemGetsNoMemory) {
  EXPECT_THROW(solve(Glutton(), Eigen::Vector2d(-1.2, 1), options(GetParam())), std::bad_alloc);
}

TEST_P(EverySolver, WorksInANarrowBox) {
  const Valley valley(0.03, 0.03);
  const SolveResult result = solve(valley, Eigen::Vector2d(0, 0), options(GetParam()));
  EXPECT_TRUE(inside(valley, result.x)) << result.x.transpose();
  EXPECT_NEAR(result.residual_norm, 0.97, 1e-3) << result.why;
}

TEST_P(EverySolver, KeepsABookOfBestPointsThatOnlyImproves) {
  const SolveResult result = solve(Valley(), Eigen::Vector2d(-1.2, 1), options(GetParam(), 300));
  for (std::size_t k = 1; k < result.history.size(); ++k) {
    EXPECT_GT(result.history[k].first, result.history[k - 1].first);
    EXPECT_LT(result.history[k].second, result.history[k - 1].second);
  }
  EXPECT_LE(result.history.back().first, result.evaluations);
  EXPECT_EQ(result.history.back().second, result.residual_norm);
}

TEST_P(EverySolver, KeepsItsBestPointWhenItRunsOffACliff) {
  const SolveResult result = solve(Cliff(0.5), Eigen::Vector2d(-1.2, 1), options(GetParam()));
  EXPECT_LT(result.x[0], 0.5);
  EXPECT_LE(result.residual_norm, Eigen::Vector2d(4.4, 2.2).norm() + 1e-12);
}

TEST_P(EverySolver, StopsAtTheTargetAskedFor) {
  SolverOptions with_target = options(GetParam());
  with_target.target = 0.5;
  const SolveResult result = solve(Valley(), Eigen::Vector2d(-1.2, 1), with_target);
  EXPECT_LE(result.residual_norm, 0.5);
  EXPECT_EQ(result.status, SolveStatus::target_reached);
}

INSTANTIATE_TEST_SUITE_P(All, EverySolver, ::testing::ValuesIn(all_solvers()),
                         [](const auto& tested) { return to_string(tested.param); });

TEST(Solver, ToyProblemHasTheDerivativesItSays) {
  const Valley valley;
  const Eigen::Vector2d x(0.3, -0.7);
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  valley.evaluate(x, r, &J);
  const auto f = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd value;
    valley.evaluate(at, value, nullptr);
    return value;
  };
  testing::expect_jacobian(f, x, J);
}

TEST(Solver, RejectsOptionsThatMakeNoSense) {
  const Valley valley;
  const Eigen::Vector2d start(0, 0);
  for (const auto& change : std::vector<std::function<void(SolverOptions&)>>{
           [](SolverOptions& o) { o.max_evaluations = 0; },
           [](SolverOptions& o) { o.tolerance = std::numeric_limits<double>::quiet_NaN(); },
           [](SolverOptions& o) { o.trust_radius = 0; },
           [](SolverOptions& o) { o.trust_radius = std::numeric_limits<double>::quiet_NaN(); },
           [](SolverOptions& o) { o.target = -1; },
           [](SolverOptions& o) { o.target = std::numeric_limits<double>::infinity(); }}) {
    SolverOptions wrong;
    change(wrong);
    EXPECT_THROW(solve(valley, start, wrong), InvalidInput);
  }
}

TEST(Solver, EveryStopReasonHasItsOwnWords) {
  std::set<std::string> words;
  for (const SolveStatus status :
       {SolveStatus::converged, SolveStatus::target_reached, SolveStatus::evaluation_limit,
        SolveStatus::stalled, SolveStatus::cannot_evaluate, SolveStatus::failed})
    words.insert(to_string(status));
  EXPECT_EQ(words, (std::set<std::string>{"converged", "target reached", "evaluation limit", "stalled",
                                          "cannot evaluate", "failed"}));
  std::set<std::string> methods;
  for (const SolverName name : all_solvers()) methods.insert(description(name));
  EXPECT_EQ(methods.size(), all_solvers().size());
}

TEST(MultiStart, AnswersTheSameForAnyNumberOfThreads) {
  const Valley valley;
  const StartMaker starts = [](int k, std::uint64_t seed) {
    return Eigen::Vector2d(-1.9 + 0.3 * k, 0.1 * static_cast<double>(seed) - 0.2 * k);
  };
  MultiStartOptions one;
  one.starts = 12;
  one.threads = 1;
  one.seed = 3;
  const MultiStartResult reference = multi_start(valley, starts, one);
  for (const int threads : {2, 3, 7}) {
    MultiStartOptions many = one;
    many.threads = threads;
    const MultiStartResult result = multi_start(valley, starts, many);
    EXPECT_EQ(result.best, reference.best);
    for (int k = 0; k < one.starts; ++k) {
      EXPECT_EQ(result.runs[k].x, reference.runs[k].x);
      EXPECT_EQ(result.runs[k].evaluations, reference.runs[k].evaluations);
    }
  }
}

TEST(MultiStart, TellsOfEveryStartAndTheLeastSoFar) {
  const StartMaker starts = [](int k, std::uint64_t) { return Eigen::Vector2d(-1.9 + 0.3 * k, 0.2 * k); };
  for (const int threads : {1, 3}) {
    std::vector<int> counts;
    std::vector<double> least;
    MultiStartOptions options;
    options.starts = 6;
    options.threads = threads;
    options.ended = [&](int ended, double best) {
      counts.push_back(ended);
      least.push_back(best);
    };
    const MultiStartResult result = multi_start(Valley(), starts, options);
    EXPECT_EQ(counts, (std::vector{1, 2, 3, 4, 5, 6}));
    EXPECT_TRUE(std::is_sorted(least.rbegin(), least.rend()));
    EXPECT_EQ(least.back(), result.best_run().residual_norm);
  }
}

TEST(MultiStart, TheRandomMethodToo) {
  const StartMaker start = [](int, std::uint64_t) { return Eigen::Vector2d(-1.2, 1); };
  MultiStartOptions options;
  options.starts = 4;
  options.solver.name = SolverName::crs;
  options.threads = 1;
  const MultiStartResult one = multi_start(Valley(), start, options);
  options.threads = 4;
  const MultiStartResult four = multi_start(Valley(), start, options);
  for (int k = 0; k < options.starts; ++k) EXPECT_EQ(one.runs[k].x, four.runs[k].x);
  EXPECT_NE(one.runs[0].x, one.runs[1].x);
}

TEST(MultiStart, AnExceptionInOneStartIsThatStartsFailure) {
  const StartMaker starts = [](int k, std::uint64_t) -> Eigen::VectorXd {
    if (k == 0) throw std::runtime_error("no start here");
    return Eigen::Vector2d(-1.2, 1);
  };
  MultiStartOptions two;
  two.starts = 2;
  const MultiStartResult result = multi_start(Valley(), starts, two);
  EXPECT_EQ(result.best, 1);
  EXPECT_EQ(result.runs[0].status, SolveStatus::failed);
  EXPECT_EQ(result.runs[0].why, "no start here");
}

TEST(MultiStart, AStartWithoutMemoryEndsTheSearch) {
  const StartMaker starts = [](int k, std::uint64_t) -> Eigen::VectorXd {
    if (k == 1) throw std::bad_alloc();
    return Eigen::Vector2d(-1.2, 1);
  };
  MultiStartOptions two;
  two.starts = 2;
  EXPECT_THROW(multi_start(Valley(), starts, two), std::bad_alloc);
}

TEST(MultiStart, TakesMoreThreadsThanStartsAndRefusesWhatIsNoNumberOfThreads) {
  MultiStartOptions options;
  options.starts = 2;
  options.threads = 1024;
  const StartMaker start = [](int, std::uint64_t) { return Eigen::Vector2d(-1.2, 1); };
  EXPECT_LE(multi_start(Valley(), start, options).best_run().residual_norm, 1e-3);
  for (const int threads : {-1, 1025, 10'000'000}) {
    options.threads = threads;
    EXPECT_THROW(multi_start(Valley(), start, options), InvalidInput) << threads;
  }
}

}  // namespace
}  // namespace kinetix::optim
