#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace kinetix::optim {

/// Unknown value: of failed samples, and of statistics with too few samples. No unit.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Options of the bootstrap. It draws as many rows as there are, with replacement, and computes the figure
/// again. The interval is between quantiles of the resampled figures (percentile method; Efron, Tibshirani,
/// "An introduction to the bootstrap", 1993, ch. 13).
struct ConfidenceOptions {
  double level = 0.95;     ///< probability of the interval, 0 < level < 1
  int resamples = 400;     ///< 2 to 100 000
  std::uint64_t seed = 0;  ///< same seed, same intervals

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// A figure and its interval, all in the figure's unit. NaN if there were too few usable rows.
struct Estimate {
  double value, lower, upper;
};

/// Returns the value below which a share of the values is, interpolated linearly, in their unit.
/// @param sorted at least one, ascending, finite
/// @param share 0 to 1
double sample_quantile(const std::vector<double>& sorted, double share);

/// Returns a figure with its interval from its values on the resamples, in its unit. Values that are not
/// finite are ignored. @param level of ConfidenceOptions
Estimate percentile_estimate(double value, std::vector<double> resampled, double level);

/// Returns the row drawn at place `draw` of resample `resample`. @param rows 1 or more
std::uint64_t resampled_row(std::uint64_t seed, int resample, std::uint64_t draw, std::uint64_t rows);

}  // namespace kinetix::optim

/// Statistics of a table of samples. `samples` has a row per sample and a column per factor, in the factors'
/// units and all finite. `responses` has one number per row; NaN (or another value that is not finite) marks
/// a failed or missing response. Each figure that depends on such a row leaves it out and counts it. All
/// functions are pure: the same arguments give the same bits.
namespace kinetix::optim {

using SampleMatrix = Eigen::Ref<const Eigen::MatrixXd>;

/// @name Main effects: any table of samples
/// @{

/// Rows in which one factor has about one value.
struct EffectLevel {
  double lower, upper;  ///< least and greatest value of the factor in these rows, usable or not, in its unit
  double mean;          ///< of the response, in its unit; NaN without usable rows
  /// Standard error of the mean: sd / sqrt(used), in its unit; NaN below two usable rows and for related
  /// rows.
  double standard_error;
  std::int64_t used, failed;  ///< rows
};

struct MainEffect {
  std::vector<EffectLevel> levels;  ///< by increasing value of the factor
  bool binned = false;              ///< levels are bins of about as many rows each, not single values
  /// Share of the response's variance explained by the level. It estimates Sobol's first-order index from any
  /// table of independent rows. It is the correlation ratio without its bias, (S_b - (k - 1) s^2) / S_t, and
  /// may be a little below 0. S_b and S_t are the sums of squares between levels and in all, s^2 the variance
  /// within, k the levels (Kelley, Proc. Natl. Acad. Sci. 21, 554, 1935). For a grid it is S_b / S_t, the
  /// index itself, since means of its levels are free of the other factors. It uses all levels, even if these
  /// are binned. NaN for a constant response, with no more usable rows than levels, and for related rows.
  double variance_share = 0;
  /// Interval that contains the share in about 95 of 100 tables, within [0, 1]. It comes from the shares of
  /// the tables that lack one row (jackknife). NaN for a grid, which is not random, and if variance_share is
  /// NaN.
  double share_lower = 0, share_upper = 0;
};

/// Dependence between the rows of a table.
enum class TableRows {
  independent,  ///< lhs, sobol, monte_carlo
  grid,         ///< factorial: every combination of the levels once
  related       ///< saltelli, morris: many rows differ in one factor only, so their count overstates them
};

struct MainEffectOptions {
  int max_values = 12;  ///< 1 or more: a factor of more values than this is binned
  int bins = 10;        ///< 1 or more; with equal numbers of rows as far as equal values in one bin allow
  TableRows rows = TableRows::independent;

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// Computes the mean response level by level of each factor, while all other factors vary.
/// @throws InvalidInput for sizes that do not fit, a factor value that is not finite, invalid options
std::vector<MainEffect> main_effects(const SampleMatrix& samples, std::span<const double> responses,
                                     const MainEffectOptions& options = {});

/// Computes the effects of a table of SamplingMethod::one_factor (row 0 the base). The levels of a factor
/// are the base and the rows in which only this factor differs from it, one level per value. variance_share
/// is NaN, since such a table has none.
/// @throws InvalidInput as main_effects, without rows, and for a row that differs in more than one factor
std::vector<MainEffect> one_factor_effects(const SampleMatrix& samples, std::span<const double> responses);

/// @}
/// @name Correlation and linear regression: any table of independent samples
/// @{

/// Linear effect of a factor. All fields are NaN for a constant response and for a factor that is constant
/// over the usable rows. The plane is then that of the other factors.
struct LinearEffect {
  double correlation;       ///< Pearson's, -1 to 1
  double rank_correlation;  ///< Spearman's, equal values sharing their mean rank; -1 to 1
  double slope;             ///< of the least-squares plane, response per unit of the factor, all others held
  double slope_error;       ///< its standard error, response per unit of the factor
  double standardised;      ///< slope * sd of the factor / sd of the response, dimensionless
};

struct LinearModel {
  std::vector<LinearEffect> factors;
  /// Share of the variance explained by the plane, 0 to 1. r_squared and all fields of the plane are NaN if
  /// the usable rows are not more than varying factors + 1, or the factors depend on each other linearly.
  double r_squared;
  std::int64_t used, failed;  ///< rows
};

/// Fits the least-squares plane. @throws InvalidInput as main_effects
LinearModel linear_effects(const SampleMatrix& samples, std::span<const double> responses);

/// Returns the share of the response's variance explained linearly by a family of factors together. There may
/// be more factors than rows, but they must be independent. The share is the sum of the squared correlations,
/// each minus 1 / (n - 1), its expected value by chance. Its bias is at most 3 / n, and it may be a little
/// below 0. The interval contains the share in at least 95 of 100 tables and is cut to [0, 1]. NaN below
/// three usable rows, and if no factor varies.
/// @param correlations of the factors with the response; values that are not finite are ignored
/// @param used rows
Estimate linear_share(std::span<const double> correlations, std::int64_t used);

/// @}
/// @name Sobol's indices: tables of SamplingMethod::saltelli
/// @{

/// Shares of the response's variance.
struct SobolIndex {
  /// Index of the factor alone: mean of f(B) (f(A with factor of B) - f(A)) over the variance (Saltelli et
  /// al., Comput. Phys. Commun. 181, 259, 2010, table 2 (b)). The mean of f is subtracted first, which
  /// changes no expectation.
  Estimate first;
  /// Index of the factor with all its interactions: mean of (f(A) - f(A with factor of B))^2 / 2 over the
  /// variance (Jansen, Comput. Phys. Commun. 117, 35, 1999; table 2 (f) there).
  Estimate total;
  std::int64_t used_first, used_total;  ///< bases with all rows usable that the index needs
};

/// Indices of all factors. All are NaN for a constant response; a single one is NaN with fewer than two
/// usable bases. Estimates may be a little below 0 or above 1. The bootstrap draws bases as if independent.
/// Points of Sobol's sequence are better than that, so intervals are rather too wide.
struct SobolIndices {
  std::vector<SobolIndex> factors;
  /// Mean of the response over the usable rows A and B, in its unit. Its variance is over the bases with both
  /// rows usable, in the unit squared.
  double mean, variance;
  std::int64_t bases, failed;  ///< bases; rows that failed
};

/// Computes the indices.
/// @param responses of a table of SamplingMethod::saltelli in its order, a multiple of factors + 2
/// @throws InvalidInput for another number of responses, no factors, invalid options
SobolIndices sobol_indices(std::span<const double> responses, int factors,
                           const ConfidenceOptions& options = {});

/// @}
/// @name Elementary effects: tables of SamplingMethod::morris
/// @{

/// Statistics of one factor's elementary effects. An effect is the change of the response over the change of
/// the factor, times the factor's span (greatest minus least value in the table). Effects are therefore in
/// the response's unit and comparable between factors. Exact for a linear response: mu = slope * span, sigma
/// = 0.
struct MorrisEffect {
  Estimate mu;       ///< mean: direction and size (Morris, Technometrics 33, 161, 1991)
  Estimate mu_star;  ///< mean of the absolute effects: size (Campolongo, Cariboni, Saltelli, Environ. Model.
                     ///< Softw. 22, 1509, 2007)
  Estimate sigma;    ///< standard deviation: curvature and interaction; NaN below two effects
  std::int64_t used, dropped;  ///< effects; dropped: with a failed row at either end
};

/// Computes the elementary effects.
/// @param samples table of SamplingMethod::morris in its order, a multiple of factors + 1 rows.
/// @throws InvalidInput as main_effects, and for any other table: a step that does not change exactly one
/// factor, or a factor that a trajectory moves twice
std::vector<MorrisEffect> morris_effects(const SampleMatrix& samples, std::span<const double> responses,
                                         const ConfidenceOptions& options = {});

/// @}

/// @throws InvalidInput if responses and rows differ in number, without factors, and for a value that is not
/// finite
void check_table(const SampleMatrix& samples, std::span<const double> responses);

/// Returns the rows whose response is finite, in order.
std::vector<Eigen::Index> usable_rows(std::span<const double> responses);

}  // namespace kinetix::optim
